"""Writer of the MSH 2.2 that HyTeG reads: no $PhysicalNames, exactly two tags, the first one a flag.

HyTeG takes the first tag of an element as its mesh boundary flag: here 1 on lines of the boundary, whatever
group they are in, and 0 on triangles. Lines inside the domain are left out.
"""

from __future__ import annotations

import os

from ..atomic import replacing
from ..errors import OutputError
from .boundary_edges import rim
from .file import MeshFile
from .text_write import counting, table_lines
from .whole import whole_mesh

LINE, TRIANGLE = 1, 2
"""Element types of Gmsh."""


def write_hyteg(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write points, boundary lines and triangles; whole or not at all, raises OutputError."""
    whole = whole_mesh(mesh_file)
    if len(whole.quads):
        raise OutputError(f"{os.fspath(path)}: the mesh has quads, HyTeG takes triangles; split them first")
    points, lines = whole.spatial_points, rim(whole.triangles, whole.quads, len(whole.points))
    n_lines, n_triangles = len(lines), len(whole.triangles)
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        stream.writelines(table_lines("%d %r %r %r\n", counting(len(points)), points))
        stream.write(f"$EndNodes\n$Elements\n{n_lines + n_triangles}\n")
        stream.writelines(table_lines(f"%d {LINE} 2 1 1 %d %d\n", counting(n_lines), lines + 1))
        stream.writelines(
            table_lines(
                f"%d {TRIANGLE} 2 0 0 %d %d %d\n", counting(n_triangles, n_lines + 1), whole.triangles + 1
            )
        )
        stream.write("$EndElements\n")
