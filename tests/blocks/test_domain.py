"""Domains by hand: which curves, which corners, which junctions, in meshes made of squares."""

from __future__ import annotations

import domains
import numpy as np
import pytest

from bsgplan.blocks.corners import find_corners
from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.kinds import CORNER, INTERIOR, JUNCTION, SLIDING
from bsgplan.blocks.placed import place
from bsgplan.errors import InvalidMesh
from bsgplan.mesh import Mesh, clean

SQUARE = domains.grid_mesh(6, 6)


def corners(domain: Domain, edge: float = 1.0) -> list[list[float]]:
    """Corners in the coordinates of the mesh, sorted, for a wanted edge of that length."""
    is_corner, _ = find_corners(domain, np.full(domain.n_points, edge / domain.scale))
    return sorted(domain.to_mesh(domain.points[is_corner]).round(9).tolist())


def facts(domain: Domain) -> tuple[int, int, int, int]:
    """Curves, closed ones, ones inside, junctions."""
    lines = domain.lines
    return (
        len(lines.is_closed),
        int(lines.is_closed.sum()),
        int(lines.is_inside.sum()),
        int(lines.is_junction.sum()),
    )


def test_a_square_is_one_closed_curve_with_four_corners() -> None:
    """Counter-clockwise round the domain, as long as its perimeter."""
    domain = domain_of(SQUARE)
    assert facts(domain) == (1, 1, 0, 0)
    assert corners(domain) == [[0, 0], [0, 6], [6, 0], [6, 6]]
    assert domain.scale * domain.curve_lengths == pytest.approx([24.0])
    xy = domain.curve_points[:, :2]
    assert (xy[:-1, 0] * xy[1:, 1] - xy[1:, 0] * xy[:-1, 1]).sum() > 0
    assert (np.diff(domain.curve_points[:, 2]) > 0).all()


def test_an_annulus_has_two_curves_and_eight_corners() -> None:
    """The hole runs the other way: its corners turn right, by 90 degrees."""
    keep = np.ones((6, 6), bool)
    keep[2:4, 2:4] = False
    domain = domain_of(domains.grid_mesh(6, 6, keep))
    assert facts(domain) == (2, 2, 0, 0)
    _, turning = find_corners(domain, np.full(domain.n_points, 1.0 / domain.scale))
    assert np.degrees(turning[np.abs(turning) > 0.5]).round(6).tolist().count(-90.0) == 4


def test_a_pinch_becomes_two_points() -> None:
    """Two squares that touch are two curves; the point where they touch is a corner of both."""
    keep = np.zeros((6, 6), bool)
    keep[:3, :3], keep[3:, 3:] = True, True
    mesh = domains.grid_mesh(6, 6, keep)
    domain = domain_of(mesh)
    assert domain.n_points == mesh.n_points + 1
    assert facts(domain) == (2, 2, 0, 0)
    assert corners(domain).count([3.0, 3.0]) == 2


def test_an_interface_across_cuts_the_boundary() -> None:
    """Two junctions at the boundary, the boundary in two curves, each a closed loop with the interface."""
    keep = np.ones((6, 6), bool)
    keep[3:, 3:] = False
    mesh = domains.grid_mesh(6, 6, keep)
    domain = domain_of(mesh, interfaces=domains.edges_where(mesh, mesh.points[:, 0] == 3))
    assert facts(domain) == (3, 0, 1, 2)
    is_corner, turning = find_corners(domain, np.full(domain.n_points, 1.0 / domain.scale))
    placed = place(domain, is_corner, turning)
    ends = placed.kinds == JUNCTION
    at = {
        tuple(p): goal
        for p, goal in zip(domain.to_mesh(placed.points[ends]), placed.goals[ends], strict=True)
    }
    assert at == {(3.0, 0.0): pytest.approx(4.0), (3.0, 3.0): pytest.approx(1 + 270 / 60)}
    inside = placed.codes[(placed.codes >= 0) & (placed.neighbours >= 0)]
    assert sorted(set((inside % 2).tolist())) == [0, 1]


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(0, 4, (2, 0, 1, 2)), (2, 4, (2, 1, 1, 2))],
    ids=["one end at the boundary", "both ends inside"],
)
def test_an_interface_may_end_inside(low: int, high: int, expected: tuple[int, int, int, int]) -> None:
    """Its ends are junctions."""
    x, y = SQUARE.points.T
    domain = domain_of(SQUARE, interfaces=domains.edges_where(SQUARE, (x == 3) & (y >= low) & (y <= high)))
    assert facts(domain) == expected


def test_closed_interfaces() -> None:
    """A loop inside is a closed curve; with one line that meets it, a curve from a junction to itself."""
    loop = domains.on_rectangle(SQUARE, 2, 4)
    assert facts(domain_of(SQUARE, interfaces=loop)) == (2, 2, 1, 0)
    x, y = SQUARE.points.T
    tail = domains.edges_where(SQUARE, (x == 3) & (y >= 4))
    assert facts(domain_of(SQUARE, interfaces=loop | tail)) == (3, 0, 2, 2)


def test_kept_points() -> None:
    """One inside is fixed there, one on the boundary is a corner; all others are what they were."""
    inside, beside = 3 * 7 + 3, 3 * 7
    domain = domain_of(SQUARE, kept=np.array([inside, beside]))
    is_corner, turning = find_corners(domain, np.full(domain.n_points, 1.0 / domain.scale))
    placed = place(domain, is_corner, turning)
    fixed = domain.source[placed.kinds == CORNER]
    assert set(fixed.tolist()) == {inside, beside, 0, 6, 42, 48}
    assert set(placed.kinds.tolist()) == {INTERIOR, SLIDING, CORNER}


def test_a_folded_sliver_of_the_boundary_leaves_the_domain() -> None:
    """Its tip lies a little outside, so that made counter-clockwise it lies on top of its neighbours."""
    points = np.array([[0.0, 0], [2, 0], [2, 2], [0, 2], [1, -1e-6]])
    mesh = Mesh(points, np.array([[0, 4, 3], [4, 2, 3], [4, 1, 2], [0, 4, 1]]))
    domain = domain_of(mesh)
    assert len(domain.triangles) == 3
    assert facts(domain) == (1, 1, 0, 0)


def test_a_fold_inside_is_refused() -> None:
    """Where it is no sliver of the boundary."""
    points = SQUARE.points.copy()
    points[3 * 7 + 3] += [1.4, 0.3]
    mesh = clean(points, SQUARE.triangles).mesh
    with pytest.raises(InvalidMesh, match="same side of their common edge: the mesh is folded"):
        domain_of(mesh)
