"""Strips of fronts as a start: ends found from the size, rings without irregular vertices, gaps closed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import jittered
from strategies import meshes as random_meshes

import bsgplan
from bsgplan.blocks.kinds import FROZEN
from bsgplan.blocks.lack import qualities
from bsgplan.blocks.outline import outline
from bsgplan.blocks.placed import PlacedMesh
from bsgplan.mesh import Mesh
from bsgplan.mesh.edges import loops_of
from bsgplan.mesh.quality import signed_areas
from bsgplan.regions.selection import parse_region, triangles_inside
from bsgplan.remesh.cut import cut
from bsgplan.remesh.fronts import fronts_of
from bsgplan.remesh.gaps import closed
from bsgplan.remesh.rim import rim_of
from bsgplan.remesh.strips import counts_of, stripped
from bsgplan.sizing import size_field

CASES = Path(__file__).resolve().parents[2] / "cases"


def rows(n_x: int, n_y: int, place: np.ndarray, *, is_closed: bool = False) -> np.ndarray:
    """Two triangles a cell of n_x columns of n_y points, every other diagonal turned: valences 4 and 8."""
    i, j = (v.ravel() for v in np.meshgrid(np.arange(n_x - 1), np.arange(n_y - (not is_closed))))
    a, b = i * n_y + j, (i + 1) * n_y + j
    c, d = i * n_y + (j + 1) % n_y, (i + 1) * n_y + (j + 1) % n_y
    turned = (i + j) % 2 == 0
    first = np.where(turned[:, None], np.column_stack([a, b, d]), np.column_stack([a, b, c]))
    second = np.where(turned[:, None], np.column_stack([a, d, c]), np.column_stack([b, d, c]))
    triangles = np.concatenate([first, second])
    is_clockwise = signed_areas(place, triangles) < 0
    triangles[is_clockwise] = triangles[is_clockwise][:, ::-1]
    return triangles


def graded(n_x: int, n_y: int) -> Mesh:
    """A sector whose columns of n_y points are farther apart the farther out, sizes like the radius."""
    radius = np.geomspace(1.0, 5.0, n_x)
    angle = np.linspace(-0.5, 0.5, n_y)
    points = (radius[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)).reshape(-1, 2)
    return Mesh(points, rows(n_x, n_y, points))


def annulus(n_x: int, n_y: int) -> Mesh:
    """n_x rings of n_y points, h like the radius."""
    radius = np.geomspace(1.0, np.exp(2 * np.pi / n_y * (n_x - 1)), n_x)
    angle = np.arange(n_y) * 2 * np.pi / n_y
    points = (radius[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)).reshape(-1, 2)
    return Mesh(points, rows(n_x, n_y, points, is_closed=True))


def part_of(mesh: Mesh, inside: np.ndarray | None = None) -> tuple[PlacedMesh, np.ndarray]:
    size = size_field(mesh)
    part = cut(mesh, np.ones(mesh.n_triangles, bool) if inside is None else inside)
    return part.start, size.log_h[part.point] - np.log(part.domain.scale)


def assert_fills(part: PlacedMesh, made: PlacedMesh) -> None:
    """The same rim in the same order, positive triangles over the same area, conforming."""
    assert (qualities(made) > 0).all()
    area = [signed_areas(mesh.points, mesh.triangles).sum() for mesh in (part, made)]
    assert area[0] == pytest.approx(area[1], rel=1e-12)
    assert np.array_equal(part.points[part.kinds == FROZEN], made.points[made.kinds == FROZEN])
    assert np.array_equal(part.goals[part.kinds == FROZEN], made.goals[made.kinds == FROZEN])
    rims = [{tuple(mesh.points[side].ravel()) for side in outline(mesh)} for mesh in (part, made)]
    assert rims[0] == rims[1]
    assert np.count_nonzero(made.codes != -1) == len(outline(made))


def test_the_ends_and_sides_of_a_sector_are_those_it_was_made_with() -> None:
    part, log_size = part_of(graded(9, 7))
    rim = rim_of(part, log_size)
    assert rim is not None
    assert [len(run) for run in (rim.fine, rim.coarse, rim.below, rim.above)] == [7, 7, 9, 9]
    assert rim.fine[0] == rim.below[0]
    assert rim.coarse[-1] == rim.above[-1]


def test_the_depth_of_a_sector_is_its_layers() -> None:
    """Where h = c r, depth = log(r) / (c sqrt(3) / 2), and every front has as many elements."""
    mesh = graded(17, 13)
    whole = cut(mesh, np.ones(mesh.n_triangles, bool))
    part = whole.start
    log_size = np.log(np.linalg.norm(mesh.points, axis=1)[whole.point] / 12 / whole.domain.scale)
    rim = rim_of(part, log_size)
    assert rim is not None
    fronts = fronts_of(part, log_size, rim)
    assert fronts.layers == pytest.approx(np.log(5.0) * 12 / np.sqrt(0.75), rel=0.02)
    counts = fronts.profile(fronts.imposed()).counts[1:-1]
    assert counts == pytest.approx(np.full(len(counts), 12.0), rel=0.02)


def test_rings_whose_size_grows_like_the_radius_have_no_irregular_vertex_inside() -> None:
    """The closed form of theory: f constant, iota 0 on every ring."""
    part, log_size = part_of(annulus(7, 18))
    rim = rim_of(part, log_size)
    assert rim is not None
    assert rim.is_closed
    fronts = fronts_of(part, log_size, rim)
    assert set(counts_of(fronts, fronts.imposed())) == {18}
    made = stripped(part, log_size)
    assert made is not None
    assert_fills(part, made)
    inner = ~made.topology.is_boundary
    assert (made.topology.valence[inner] == 6).all()


def test_strips_in_the_region_of_a_delaunay_mesh_have_a_third_of_its_irregular_vertices() -> None:
    mesh = bsgplan.read(CASES / "transition" / "mesh.msh").mesh
    part, log_size = part_of(mesh, triangles_inside(mesh, parse_region("0.3,0,0.96,1")))
    made = stripped(part, log_size)
    assert made is not None
    assert_fills(part, made)
    assert np.count_nonzero(made.is_irregular) < np.count_nonzero(part.is_irregular) / 2
    assert qualities(made).min() > 0.5
    assert len(made.triangles) == pytest.approx(len(part.triangles), rel=0.1)


def test_strips_keep_off_a_ragged_rim() -> None:
    """A box across the mesh, cut along its edges: the ends have more sides than fronts there want."""
    mesh = bsgplan.read(CASES / "transition" / "mesh.msh").mesh
    part, log_size = part_of(mesh, triangles_inside(mesh, parse_region("0.2,0.1,1,0.9")))
    rim = rim_of(part, log_size)
    assert rim is not None
    fronts = fronts_of(part, log_size, rim)
    assert fronts.imposed()[0] > 1.2 * fronts.unimposed()[0]
    made = stripped(part, log_size)
    assert made is not None
    assert_fills(part, made)


def test_a_square_of_one_size_has_no_ends() -> None:
    assert rim_of(*part_of(jittered(9, 9, 5))) is None


@given(mesh=random_meshes(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_whatever_the_size_strips_fit_the_rim_or_there_are_none(mesh: Mesh, seed: int) -> None:
    direction = np.random.default_rng(seed).normal(0.0, 0.4, 2)
    part = cut(mesh, np.ones(mesh.n_triangles, bool))
    log_size = (mesh.points @ direction)[part.point] - np.log(part.domain.scale)
    made = stripped(part.start, log_size)
    if made is not None:
        assert_fills(part.start, made)


def test_a_square_around_a_triangle_is_closed_by_seven_triangles() -> None:
    """V - E + F of seven vertices, four on the rim: 2 * 7 - 4 - 2 = 8 triangles, one of them given."""
    points = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]], dtype=float)
    rim = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    given_one = np.array([[4, 5, 6]])
    found = closed(points, given_one, rim)
    assert found is not None
    assert len(found) == 8
    assert found[0].tolist() == [4, 5, 6]
    assert signed_areas(points, found).sum() == pytest.approx(16.0)


def test_triangles_that_overlap_or_leave_the_rim_are_refused() -> None:
    points = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3], [6, 2]], dtype=float)
    rim = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    assert closed(points, np.array([[4, 5, 6], [0, 1, 6]]), rim) is None
    assert closed(points, np.array([[5, 7, 6]]), rim) is None


def test_loops_of_two_squares() -> None:
    found = loops_of(np.array([[0, 1], [5, 6], [1, 2], [6, 5], [2, 0]]))
    assert sorted(len(loop) for loop in found) == [2, 3]
