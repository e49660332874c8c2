"""What is in a mesh: its counts, shapes, lengths and irregularity as plain data, and as rows for a table.

`measures` is the data; `rows` turns a document of data into (name, value, unit), `mesh_table` into a table.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..arrays import Floats
from ..mesh import Mesh, quality
from ..mesh.components import connected_labels
from ..mesh.irregularity import fitted_boundary_irregularity, genus
from ..mesh.topology import Topology
from .quad_report import quad_rows
from .rows import Row, plain_irregularity, shown_irregularity, shown_share
from .table import Column, Table


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
        "irregularity": plain_irregularity(mesh.irregularity),
        "irregular_interior": int(np.count_nonzero(is_irregular & ~is_boundary)),
        "n_interior": int(np.count_nonzero(~is_boundary)),
        "irregular_boundary": int(np.count_nonzero(is_irregular & is_boundary)),
        "n_boundary": int(np.count_nonzero(is_boundary)),
        "irregular_boundary_fitted": int(np.count_nonzero(fitted_boundary_irregularity(topo, angles))),
        "area": float((mesh.areas / triangle_scale**2).sum()),
        "bounds": list(mesh.bounds),
    }


def measures_without_triangles() -> dict[str, Any]:
    """Return the keys of `measures` for a mesh of no triangle: counts are 0, what cannot be measured None."""
    keys = measures(Mesh(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2]])))
    counts = {"n_triangles": 0, "n_components": 0, "n_components_vertex": 0, "n_boundary_loops": 0}
    return {**dict.fromkeys(keys), **counts}


def vertex_lengths(topo: Topology, edge_lengths: Floats) -> Floats:
    """Return the mean length of the edges at each vertex, (n_points,), length."""
    total = np.bincount(topo.edges.ravel(), weights=np.repeat(edge_lengths, 2), minlength=topo.n_points)
    return total / topo.valence


def n_vertex_components(topo: Topology) -> int:
    """Return the number of components that hang together at least by a vertex."""
    return int(connected_labels(topo.edges, topo.n_points).max(initial=-1)) + 1


def rows(mesh: Mapping[str, Any]) -> list[Row]:
    """Return the rows of the table of one mesh's document (`bsgplan.info/1`, key mesh)."""
    unit = "m" if mesh["projection"] else "file unit"
    result: list[Row] = [
        ("file", mesh["path"], ""),
        ("format", mesh["format"], ""),
        ("title", mesh["title"], ""),
        ("points", f"{mesh['n_points']}", ""),
        ("triangles", f"{mesh['n_triangles']}", ""),
        *(_triangle_rows(mesh, unit) if mesh["n_triangles"] else []),
        ("bounds", _bounds(mesh["bounds"]), "degrees" if mesh["projection"] else unit),
    ]
    if mesh["projection"]:
        centre = f"{mesh['projection']['longitude']:.4f} {mesh['projection']['latitude']:.4f}"
        result.append((mesh["projection"]["method"], f"centre {centre}", "degrees"))
    if mesh["quads"]:
        result += quad_rows(mesh["quads"], unit)
    others = [f"{count} {kind}" for kind, count in mesh["ignored"].items() if kind != "quad"]
    result += [("other cells, ignored", ", ".join(others), "")]
    result += [(f"{where[:-1]} arrays", ", ".join(names), "") for where, names in mesh["arrays"].items()]
    result += [("boundaries", line, "") for line in _boundaries(mesh["boundaries"])]
    result += [("note", note, "") for note in mesh["notes"]]
    return [row for row in result if row[1]]


def _triangle_rows(mesh: Mapping[str, Any], unit: str) -> list[Row]:
    vertex_components = mesh["n_components_vertex"]
    hanging = (
        "" if vertex_components == mesh["n_components"] else f" ({vertex_components} joined at vertices)"
    )
    fitted = shown_share(mesh["irregular_boundary_fitted"], mesh["n_boundary"])
    return [
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
        ("irregularity", shown_irregularity(mesh["irregularity"]), "valence - optimal valence, summed"),
        ("irregular inside", shown_share(mesh["irregular_interior"], mesh["n_interior"]), "vertices"),
        (
            "irregular on the boundary",
            shown_share(mesh["irregular_boundary"], mesh["n_boundary"]),
            "vertices",
        ),
        ("... fitted to its angles", fitted, "vertices"),
        ("area", f"{mesh['area']:.4g}", "m^2" if mesh["projection"] else "file unit^2"),
    ]


def mesh_table(mesh: Mapping[str, Any]) -> Table:
    """Return the table of one mesh's document, each unit behind its value."""
    lines = tuple((name, f"{value} {unit}".rstrip()) for name, value, unit in rows(mesh))
    return Table("", (Column(""), Column("")), lines)


def _edges(values: Mapping[str, float], *names: str) -> str:
    low, median, high = (f"{values[name]:.3g}" for name in names)
    return f"min {low}, median {median}, max {high}"


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
