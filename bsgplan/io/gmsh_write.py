"""Writers of Gmsh meshes in text, MSH 2.2 and MSH 4.1, with physical groups by name.

    MSH 2.2                                         MSH 4.1
    $MeshFormat  2.2 0 8                            $MeshFormat  4.1 0 8
    $PhysicalNames                                  $PhysicalNames
    n, then  dimension tag "name"                   the same
    $Nodes                                          $Entities
    n, then  id x y z                               numbers of points, curves, surfaces, volumes, then
    $Elements                                       tag box n_groups group n_bounding  for each
    n, then  id type 2 group entity points          $Nodes and $Elements
    $NodeData, $ElementData                         n_blocks n first last, then for each block
    1 "name" 1 0 3 0 n_components n,                  dimension entity parametric n, then ids, then x y z
    then  id values                                   dimension entity type n, then  id points

A boundary is a physical curve of line elements, a region (an array of whole numbers as `gmsh:physical`) a
physical surface. Tags are positive, as MFEM wants them; other arrays become $NodeData and $ElementData,
where lines and quads have nan. In MSH 2.2 meshio cannot read $ElementData beside lines or quads: there the
cell arrays have no place.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..atomic import replacing
from .boundary import labels
from .file import MeshFile
from .text_write import counting, table_lines
from .whole import EVERY, WholeMesh, cell_regions, warn_of_losses, whole_mesh

LINE, TRIANGLE, QUAD = 1, 2, 3
"""Element types of Gmsh."""
COMPONENTS = (1, 3, 9)
"""Numbers of components that the data of Gmsh have; others are filled up with 0."""
REFERENCES = ("gmsh:geometrical",)
"""Cell arrays that a writer makes anew."""


@dataclass(frozen=True, eq=False)
class _Block:
    """Elements of one type in one physical group."""

    type: int
    tag: int
    corners: Ints
    """(n, k)."""
    order: Ints
    """Index of each triangle in the mesh, (n,); empty for other elements."""

    @property
    def dimension(self) -> int:
        return 1 if self.type == LINE else 2


def write_msh22(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write MSH 2.2 in text, the file appears whole or not at all; raises OutputError."""
    _write(mesh_file, path, _text22)


def write_msh41(mesh_file: MeshFile, path: str | os.PathLike[str]) -> None:
    """Write MSH 4.1 in text, the file appears whole or not at all; raises OutputError."""
    _write(mesh_file, path, _text41)


def _write(
    mesh_file: MeshFile,
    path: str | os.PathLike[str],
    text: Callable[[WholeMesh, list[_Block]], Iterator[str]],
) -> None:
    whole = whole_mesh(mesh_file)
    blocks = _blocks(mesh_file, whole)
    is_plain = text is _text41 or {block.type for block in blocks} == {TRIANGLE}
    placed = tuple(_cell_arrays(mesh_file)) if is_plain else ()
    regions = cell_regions(mesh_file).array
    warn_of_losses(
        path,
        mesh_file,
        point_data=EVERY,
        cell_data=placed if regions is None else (*placed, regions),
        boundaries=("open", "land", "named"),
    )
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        version = "2.2" if text is _text22 else "4.1"
        stream.write(f"$MeshFormat\n{version} 0 8\n$EndMeshFormat\n")
        stream.writelines(_names(mesh_file))
        stream.writelines(text(whole, blocks))
        stream.writelines(_point_data(whole))
        stream.writelines(_cell_data({name: mesh_file.cell_data[name] for name in placed}, blocks))


def _blocks(mesh_file: MeshFile, whole: WholeMesh) -> list[_Block]:
    """Return the elements as written: boundaries, triangles by region, quads."""
    regions = cell_regions(mesh_file)
    none = np.empty(0, dtype=np.int64)
    tags = labels(whole.boundaries)
    lines = [
        _Block(LINE, tag, boundary.segments, none)
        for boundary, (tag, _) in zip(whole.boundaries, tags, strict=True)
    ]
    ids = positive_ids(regions.ids)
    by_region = np.argsort(ids, kind="stable")
    found, starts = np.unique(ids[by_region], return_index=True)
    triangles = [
        _Block(TRIANGLE, tag, whole.triangles[order], order)
        for tag, order in zip(found.tolist(), np.split(by_region, starts[1:]), strict=True)
    ]
    quads = [_Block(QUAD, int(found[0]), whole.quads, none)]
    return [block for block in (*lines, *triangles, *quads) if len(block.corners)]


def positive_ids(ids: Ints) -> Ints:
    """Return the numbers of regions as tags above 0; where one is not, all are moved up.

    >>> positive_ids(np.array([0, 1, 1]))
    array([1, 2, 2])
    """
    return ids if ids.min() > 0 else ids - ids.min() + 1


def _names(mesh_file: MeshFile) -> Iterator[str]:
    regions = cell_regions(mesh_file)
    shift = int(positive_ids(regions.ids)[0] - regions.ids[0])
    rows = [f'1 {tag} "{name}"\n' for tag, name in labels(mesh_file.boundaries)]
    for number, name in regions.names.items():
        rows.append(f'2 {number + shift} "{" ".join(name.replace(chr(34), chr(39)).split())}"\n')
    if rows:
        yield f"$PhysicalNames\n{len(rows)}\n"
        yield from rows
        yield "$EndPhysicalNames\n"


def _text22(whole: WholeMesh, blocks: list[_Block]) -> Iterator[str]:
    points = whole.spatial_points
    yield f"$Nodes\n{len(points)}\n"
    yield from table_lines("%d %r %r %r\n", counting(len(points)), points)
    yield f"$EndNodes\n$Elements\n{sum(len(block.corners) for block in blocks)}\n"
    first = 1
    for block in blocks:
        corners = " %d" * block.corners.shape[1]
        template = f"%d {block.type} 2 {block.tag} {block.tag}{corners}\n"
        yield from table_lines(template, counting(len(block.corners), first), block.corners + 1)
        first += len(block.corners)
    yield "$EndElements\n"


def _text41(whole: WholeMesh, blocks: list[_Block]) -> Iterator[str]:
    points, n_points = whole.spatial_points, len(whole.points)
    entities = {(block.dimension, block.tag): block for block in blocks}
    n_curves = sum(dimension == 1 for dimension, _ in entities)
    yield f"$Entities\n0 {n_curves} {len(entities) - n_curves} 0\n"
    for (_, tag), block in sorted(entities.items(), key=lambda item: item[0]):
        corners = points[block.corners.ravel()]
        box = " ".join(map(repr, [*corners.min(axis=0).tolist(), *corners.max(axis=0).tolist()]))
        yield f"{tag} {box} 1 {tag} 0\n"
    surface = next(block.tag for block in blocks if block.type == TRIANGLE)
    yield f"$EndEntities\n$Nodes\n1 {n_points} 1 {n_points}\n2 {surface} 0 {n_points}\n"
    yield from table_lines("%d\n", counting(n_points))
    yield from table_lines("%r %r %r\n", points)
    n_elements = sum(len(block.corners) for block in blocks)
    yield f"$EndNodes\n$Elements\n{len(blocks)} {n_elements} 1 {n_elements}\n"
    first = 1
    for block in blocks:
        n, n_corners = block.corners.shape
        yield f"{block.dimension} {block.tag} {block.type} {n}\n"
        yield from table_lines("%d" + " %d" * n_corners + "\n", counting(n, first), block.corners + 1)
        first += n
    yield "$EndElements\n"


def _point_data(whole: WholeMesh) -> Iterator[str]:
    for name, values in whole.point_data.items():
        yield from _section("NodeData", name, _columns(values))


def _cell_arrays(mesh_file: MeshFile) -> Iterator[str]:
    """Give the names of the arrays that become $ElementData: all but the regions and what is made anew."""
    made = (cell_regions(mesh_file).array, *REFERENCES)
    return (name for name in mesh_file.cell_data if name not in made)


def _cell_data(arrays: dict[str, Floats], blocks: list[_Block]) -> Iterator[str]:
    for name, values in arrays.items():
        columns = _columns(values)
        rows = [
            columns[block.order]
            if block.type == TRIANGLE
            else np.full((len(block.corners), columns.shape[1]), np.nan)
            for block in blocks
        ]
        yield from _section("ElementData", name, np.concatenate(rows))


def _columns(values: Floats) -> Floats:
    flat = values.reshape(len(values), -1)
    n = next((n for n in COMPONENTS if n >= flat.shape[1]), flat.shape[1])
    return np.column_stack([flat, np.zeros((len(flat), n - flat.shape[1]))])


def _section(kind: str, name: str, values: Floats) -> Iterator[str]:
    n, n_components = values.shape
    name = " ".join(name.replace('"', "'").split())
    yield f'${kind}\n1\n"{name}"\n1\n0.0\n3\n0\n{n_components}\n{n}\n'
    yield from table_lines("%d" + " %r" * n_components + "\n", counting(n), values)
    yield f"$End{kind}\n"
