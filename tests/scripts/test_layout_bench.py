"""The bench of layouts: the rival stands on the same domain, is counted as we are, and is beaten."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import bsgplan
from bsgplan.blocks.curve_places import CurvePlaces
from bsgplan.blocks.domain import Domain, domain_of
from bsgplan.blocks.kinds import CORNER, INTERIOR
from bsgplan.blocks.lack import qualities
from bsgplan.blocks.target import Target, target_of
from bsgplan.sizing import size_field

Place = tuple[Domain, Target, np.ndarray]

ROOT = Path(__file__).parents[2]

EFFORT = 20
"""A fifth of the default: enough for the ratios asked for here."""


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The section, where gmsh can be had."""
    try:
        import gmsh  # noqa: F401
    except (ImportError, OSError) as missing:  # OSError: the wheel without the system's libraries
        pytest.skip(f"no gmsh: {missing}")
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return importlib.import_module("benchmarks.layout")


@pytest.fixture(scope="module", params=["plate", "annulus"])
def place(request: pytest.FixtureRequest) -> Place:
    """A plate with corners, and a ring without any: domain, target and s h for s = 4."""
    size = size_field(bsgplan.read(ROOT / "cases" / request.param / "mesh.msh").mesh)
    domain = domain_of(size.mesh)
    return domain, target_of(domain, size, 4), 4 * size.h[domain.source] / domain.scale


def test_the_rival_stands_on_the_domain(bench: ModuleType, place: Place) -> None:
    """As many triangles, all upright, as many loops, corners kept, sides on curves."""
    domain, target, wanted = place
    n = round(target.blocks["resolution"])
    mesh = bench.rival_of(domain, target, wanted, n)
    assert abs(len(mesh.triangles) / n - 1) < 0.07  # rings of triangles come and go as one
    assert qualities(mesh).min() > 0.5
    assert mesh.topology.euler_characteristic == domain.mesh.topology.euler_characteristic
    kept = {tuple(point) for point in domain.points[target.is_corner].round(9)}
    assert {tuple(point) for point in mesh.points[mesh.kinds == CORNER].round(9)} == kept
    on_curve = mesh.kinds != INTERIOR
    assert np.array_equal(on_curve, mesh.topology.is_boundary)
    places = CurvePlaces(domain, np.zeros(domain.n_points))
    assert np.allclose(places.points(mesh.curves[on_curve], mesh.arcs[on_curve]), mesh.points[on_curve])


def test_every_loop_is_cut_into_pieces_that_join(bench: ModuleType, place: Place) -> None:
    """At its corners, and into three at least; each piece starts where the one before ends."""
    domain, target, _ = place
    outline = importlib.import_module("benchmarks.rival").outline_of(domain, target)
    for loop in range(len(domain.curves)):
        own = domain.curve_of_point == loop
        numbers = np.flatnonzero(outline.loop == loop)
        assert len(numbers) == max(3, np.count_nonzero(own & target.is_corner))
        pieces = [outline.nodes[outline.first[k] : outline.first[k + 1]] for k in numbers]
        assert all(a[-1] == b[0] for a, b in zip(pieces, [*pieces[1:], pieces[0]], strict=True))
        assert sorted(np.concatenate([piece[:-1] for piece in pieces])) == sorted(np.flatnonzero(own))


def test_gmsh_that_never_ends_is_given_up(
    bench: ModuleType, place: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then there is no rival, and the bench goes on."""
    monkeypatch.setattr(importlib.import_module("benchmarks.rival"), "LIMIT", 0.01)
    domain, target, wanted = place
    assert bench.rival_of(domain, target, wanted, 300) is None


@pytest.mark.usefixtures("meshes")
@pytest.mark.parametrize("name", ["plate", "rectlin"])
def test_cheap_rows(bench: ModuleType, name: str) -> None:
    """At a fifth of the effort: 70 % fewer irregular vertices than gmsh, an upright grid no larger."""
    case = next(case for case in bench.ALL if case.name == f"{name}, s = 4")
    rows = {row.what.split(": ", 1)[1]: row for row in bench.case_rows(case, seeds=1, effort=EFFORT)}
    assert rows["irregular vertices that gmsh has and we have not"].value > 0.7
    assert rows["irregular inside, input over grid"].value > 20
    assert rows["q_min of blocks"].value > 0.8
    assert rows["inverted triangles, any seed"].value == 0
    assert 0.85 < rows["triangles, grid over input"].value < 1.1
    blocks = rows["blocks"]
    assert abs(float(blocks.beside) / blocks.value - 1) < 0.05  # gmsh got the same number


@pytest.mark.parametrize(
    ("below", "above", "value", "holds"),
    [
        (None, None, 5.0, True),
        (5.0, None, 5.0, False),
        (None, 5.0, 5.0, True),
        (None, 5.0, 4.9, False),
        (1.0, None, float("nan"), False),
        (None, 1.0, float("nan"), False),
    ],
)
def test_a_demand_holds_or_fails(
    monkeypatch: pytest.MonkeyPatch, below: float | None, above: float | None, value: float, holds: bool
) -> None:
    """Below is strict, above is not, and what could not be measured meets no demand."""
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    row = importlib.import_module("benchmarks.row").Row("x", value, below=below, above=above)
    assert row.holds is holds
    assert row.verdict.endswith("holds" if holds else "FAILS") == (below is not None or above is not None)
