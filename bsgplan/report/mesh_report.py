"""What is in a mesh: its counts, shapes, lengths and irregularity as plain data, and as rows for a table.

`measures` is the data; `rows` turns a document of data into (name, value, unit); `text` aligns rows.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Ints
from ..errors import InvalidMesh
from ..mesh import Mesh, quality
from ..mesh.irregularity import Irregularity, fitted_boundary_irregularity, genus, mesh_irregularity
from ..mesh.topology import Topology, topology

Row = tuple[str, str, str]
"""Name, value and unit of one measure, as text."""


def measures(mesh: Mesh, *, scale: Floats | None = None) -> dict[str, Any]:
    """Return the measures of a mesh as plain data: counts, ratios, degrees of angle, lengths, areas.

    scale is the plane's length per true length at each point, (n_points,), of a projected mesh; lengths
    and areas are then true ones, the bounds those of the plane.
    """
    topo = mesh.topology
    edge_scale = 1.0 if scale is None else scale[topo.edges].mean(axis=1)
    triangle_scale = 1.0 if scale is None else scale[mesh.triangles].mean(axis=1)
    edges = mesh.edge_lengths / edge_scale
    at_vertex = vertex_lengths(topo, edges)
    angles = quality.angles(mesh.corner_edge_lengths)
    is_boundary, is_irregular = topo.is_boundary, mesh.vertex_irregularity != 0
    return {
        "n_points": mesh.n_points,
        "n_triangles": mesh.n_triangles,
        "n_components": topo.n_components,
        "n_components_vertex": n_vertex_components(topo),
        "n_boundary_loops": topo.n_boundary_loops,
        "euler_characteristic": topo.euler_characteristic,
        "pinches": topo.n_pinches,
        "genus": int(genus(topo).sum()),
        "q_min": float(mesh.qualities.min()),
        "q_mean": float(mesh.qualities.mean()),
        "angle_min": float(np.degrees(angles.min())),
        "edge_ratio_max": float(quality.edge_ratio(mesh.corner_edge_lengths).max()),
        "edge_min": float(edges.min()),
        "edge_median": float(np.median(edges)),
        "edge_max": float(edges.max()),
        "size_ratio": float(at_vertex.max() / at_vertex.min()),
        "irregularity": _plain(mesh.irregularity),
        "irregular_interior": int(np.count_nonzero(is_irregular & ~is_boundary)),
        "n_interior": int(np.count_nonzero(~is_boundary)),
        "irregular_boundary": int(np.count_nonzero(is_irregular & is_boundary)),
        "n_boundary": int(np.count_nonzero(is_boundary)),
        "irregular_boundary_fitted": int(np.count_nonzero(fitted_boundary_irregularity(topo, angles))),
        "area": float((mesh.areas / triangle_scale**2).sum()),
        "bounds": list(mesh.bounds),
    }


def quad_measures(points: Floats, quads: Ints, *, scale: Floats | None = None) -> dict[str, Any] | None:
    """Return the measures of the quads of a mixed mesh, None where there are none.

    Irregularity is None where the quads alone are no manifold mesh.
    """
    if not len(quads):
        return None
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    lengths = np.linalg.norm(points[sides[:, 1]] - points[sides[:, 0]], axis=1)
    if scale is not None:
        lengths = lengths / scale[sides].mean(axis=1)
    try:
        topo = topology(quads, len(points))
        irregularity = _plain(mesh_irregularity(topo))
        n_loops, chi = topo.n_boundary_loops, topo.euler_characteristic
    except InvalidMesh:
        irregularity, n_loops, chi = None, None, None
    return {
        "n_quads": len(quads),
        "n_points": len(points),
        "n_boundary_loops": n_loops,
        "euler_characteristic": chi,
        "irregularity": irregularity,
        "edge_min": float(lengths.min()),
        "edge_max": float(lengths.max()),
    }


def vertex_lengths(topo: Topology, edge_lengths: Floats) -> Floats:
    """Return the mean length of the edges at each vertex, (n_points,), length."""
    total = np.bincount(topo.edges.ravel(), weights=np.repeat(edge_lengths, 2), minlength=topo.n_points)
    return total / topo.valence


def n_vertex_components(topo: Topology) -> int:
    """Return the number of components that hang together at least by a vertex."""
    links = (np.ones(len(topo.edges), dtype=np.int8), (topo.edges[:, 0], topo.edges[:, 1]))
    graph = coo_array(links, shape=(topo.n_points, topo.n_points))
    return int(connected_components(graph, directed=False)[0])


def rows(mesh: Mapping[str, Any]) -> list[Row]:
    """Return the rows of the table of one mesh's document (`bsgplan.info/1`, key mesh)."""
    unit = "m" if mesh["projection"] else "file unit"
    vertex_components = mesh["n_components_vertex"]
    hanging = (
        "" if vertex_components == mesh["n_components"] else f" ({vertex_components} joined at vertices)"
    )
    result: list[Row] = [
        ("file", mesh["path"], ""),
        ("format", mesh["format"], ""),
        ("title", mesh["title"], ""),
        ("points", f"{mesh['n_points']}", ""),
        ("triangles", f"{mesh['n_triangles']}", ""),
        ("components", f"{mesh['n_components']}{hanging}", ""),
        ("boundary loops", f"{mesh['n_boundary_loops']}", ""),
        ("Euler characteristic", f"{mesh['euler_characteristic']}", ""),
        ("pinches", f"{mesh['pinches']}", ""),
        ("genus", f"{mesh['genus']}", ""),
        ("mean ratio q", f"min {mesh['q_min']:.3g}, mean {mesh['q_mean']:.3g}", ""),
        ("smallest angle", f"{mesh['angle_min']:.3g}", "degrees"),
        ("longest / shortest edge", f"max {mesh['edge_ratio_max']:.3g}", "in one triangle"),
        ("edge length", _edges(mesh, "edge_min", "edge_median", "edge_max"), unit),
        ("size ratio", f"{mesh['size_ratio']:.3g}", "largest / smallest mean edge at a vertex"),
        ("irregularity", _irregularity(mesh["irregularity"]), "valence - optimal valence, summed"),
        ("irregular inside", _share(mesh["irregular_interior"], mesh["n_interior"]), "vertices"),
        ("irregular on the boundary", _share(mesh["irregular_boundary"], mesh["n_boundary"]), "vertices"),
        (
            "... fitted to its angles",
            _share(mesh["irregular_boundary_fitted"], mesh["n_boundary"]),
            "vertices",
        ),
        ("area", f"{mesh['area']:.4g}", "m^2" if mesh["projection"] else "file unit^2"),
        ("bounds", _bounds(mesh["bounds"]), "degrees" if mesh["projection"] else unit),
    ]
    if mesh["projection"]:
        centre = f"{mesh['projection']['longitude']:.4f} {mesh['projection']['latitude']:.4f}"
        result.append((mesh["projection"]["method"], f"centre {centre}", "degrees"))
    if mesh["quads"]:
        quads = mesh["quads"]
        iota = f", irregularity {_irregularity(quads['irregularity'])}" if quads["irregularity"] else ""
        result.append(("quads", f"{quads['n_quads']}{iota}", ""))
        result.append(("edge length of quads", f"{quads['edge_min']:.3g} .. {quads['edge_max']:.3g}", unit))
    others = [f"{count} {kind}" for kind, count in mesh["ignored"].items() if kind != "quad"]
    result += [("other cells, ignored", ", ".join(others), "")]
    result += [(f"{where[:-1]} arrays", ", ".join(names), "") for where, names in mesh["arrays"].items()]
    result += [("boundaries", line, "") for line in _boundaries(mesh["boundaries"])]
    result += [("note", note, "") for note in mesh["notes"]]
    return [row for row in result if row[1]]


def text(table: Iterable[Row]) -> str:
    r"""Return rows as aligned plain text.

    >>> text([("points", "4", ""), ("area", "1", "m^2")])
    'points  4\narea    1 m^2'
    """
    table = list(table)
    width = max(len(name) for name, _, _ in table)
    return "\n".join(f"{name:<{width}}  {value} {unit}".rstrip() for name, value, unit in table)


def _plain(irregularity: Irregularity) -> dict[str, int]:
    return {
        "positive": irregularity.positive,
        "negative": irregularity.negative,
        "total": irregularity.total,
    }


def _irregularity(values: Mapping[str, int]) -> str:
    return f"{values['positive']:+d} {values['negative']:+d} = {values['total']}"


def _edges(values: Mapping[str, float], *names: str) -> str:
    low, median, high = (f"{values[name]:.3g}" for name in names)
    return f"min {low}, median {median}, max {high}"


def _share(part: int, whole: int) -> str:
    return f"{part} of {whole}" + (f" ({100 * part / whole:.0f} %)" if whole else "")


def _bounds(bounds: list[float]) -> str:
    return " x ".join(f"{low:.6g} .. {high:.6g}" for low, high in zip(bounds[::2], bounds[1::2], strict=True))


def _boundaries(boundaries: list[dict[str, Any]]) -> list[str]:
    """Return one line for each kind of boundary; the named ones each by name or tag."""
    lines = []
    for kind in ("open", "land"):
        sizes = [b["n_nodes"] for b in boundaries if b["kind"] == kind]
        codes = sorted({b["code"] for b in boundaries if b["kind"] == kind and b["code"] is not None})
        if sizes:
            what = f", types {' '.join(map(str, codes))}" if codes else ""
            lines.append(f"{len(sizes)} {kind}, {sum(sizes)} nodes{what}")
    named = [f"{b['name'] or b['code']} ({b['n_nodes']})" for b in boundaries if b["kind"] == "named"]
    more = [f"and {len(named) - 8} more"] if len(named) > 8 else []
    return lines + (["points of " + ", ".join([*named[:8], *more])] if named else [])
