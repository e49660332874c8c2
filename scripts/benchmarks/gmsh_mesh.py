"""A process of its own: gmsh Frontal-Delaunay inside polylines with a background size field.

    python gmsh_mesh.py job.npz mesh.npz

Apart, because gmsh may crash, or never end, on coasts. The job and the mesh are described in `rival.py`.
"""

from __future__ import annotations

import sys
from itertools import pairwise

import gmsh
import numpy as np

FRONTAL_DELAUNAY = 6
"""Number of the algorithm."""


def main(job_path: str, mesh_path: str) -> None:
    """Mesh the job's domain and store points, triangles and the places of nodes on curves."""
    job = dict(np.load(job_path))
    gmsh.initialize(["-noenv"], interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    for name, value in {
        "Algorithm": FRONTAL_DELAUNAY,
        "MeshSizeFromPoints": 0,
        "MeshSizeFromCurvature": 0,
        "MeshSizeExtendFromBoundary": 0,
    }.items():
        gmsh.option.setNumber(f"Mesh.{name}", value)
    background(job["map_points"], job["map_triangles"], job["size"])
    pieces = outline(job)
    gmsh.model.mesh.generate(2)
    np.savez(mesh_path, **result(pieces))
    gmsh.finalize()


def background(points: np.ndarray, triangles: np.ndarray, size: np.ndarray) -> None:
    """Set a size at each point of a triangulation as the background mesh."""
    view = gmsh.view.add("size")
    corners = np.column_stack([points, np.zeros(len(points))])[triangles]
    rows = np.column_stack([corners.swapaxes(1, 2).reshape(len(triangles), 9), size[triangles]])
    gmsh.view.addListData(view, "ST", len(triangles), rows.ravel())
    field = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)


def outline(job: dict[str, np.ndarray]) -> list[int]:
    """Make polylines of the job's pieces and surfaces of its loops; return the tags of the pieces."""
    points, nodes, first, loop = (job[name] for name in ("map_points", "nodes", "first", "loop"))
    geo = gmsh.model.geo
    for node in np.unique(nodes):
        geo.addPoint(*points[node], 0.0, tag=int(node) + 1)
    ranges = [nodes[start:stop] for start, stop in pairwise(first)]
    pieces = [geo.addPolyline([int(node) + 1 for node in own]) for own in ranges]
    loops = [geo.addCurveLoop([pieces[k] for k in np.flatnonzero(loop == c)]) for c in range(loop.max() + 1)]
    for own in np.unique(job["component"]):
        members = np.flatnonzero(job["component"] == own)
        members = members[np.argsort(~job["is_outer"][members], kind="stable")]
        geo.addPlaneSurface([loops[c] for c in members])
    geo.synchronize()
    return pieces


def result(pieces: list[int]) -> dict[str, np.ndarray]:
    """Return the mesh: points, triangles, and of nodes on pieces the node, the piece and the place on it."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    number = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    number[tags.astype(np.int64)] = np.arange(len(tags))
    triangles = gmsh.model.mesh.getElementsByType(2)[1].astype(np.int64).reshape(-1, 3)
    nodes, piece, place = [], [], []
    for k, tag in enumerate(pieces):
        own, _, parameter = gmsh.model.mesh.getNodes(1, tag, includeBoundary=True)
        nodes.append(number[own.astype(np.int64)])
        piece.append(np.full(len(own), k))
        place.append(parameter)
    return {
        "points": coordinates.reshape(-1, 3)[:, :2],
        "triangles": number[triangles],
        "nodes": np.concatenate(nodes),
        "piece": np.concatenate(piece),
        "place": np.concatenate(place),
    }


if __name__ == "__main__":
    main(*sys.argv[1:])
