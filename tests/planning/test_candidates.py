"""Candidates of the paper's region, and what the objectives choose among them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

from bsgplan.errors import InvalidOption
from bsgplan.io import read
from bsgplan.mesh import clean
from bsgplan.patterns import Spacing
from bsgplan.planning import OBJECTIVES, Candidate, choose, estimate
from bsgplan.planning.candidate import candidates
from bsgplan.regions import Regions, find_regions, measure_regions
from bsgplan.regions.selection import triangles_inside
from bsgplan.sizing import size_field

CASES = Path(__file__).parents[2] / "cases"


def drawn() -> Regions:
    """The rectangle between the constant parts, cut out and measured by itself."""
    mesh = read(CASES / "rectangle" / "mesh.msh").mesh
    inside = triangles_inside(mesh, shapely.box(0.3, 0, 0.96, 1))
    size = size_field(clean(mesh.points, mesh.triangles[inside]).mesh)
    label = np.zeros(size.mesh.n_triangles, dtype=np.int64)
    return measure_regions(size, label, np.zeros(1, dtype=bool))


@pytest.fixture(scope="module")
def listed() -> dict[str, Candidate]:
    """Candidates of the drawn region at 16 triangles a block, by their pattern."""
    (part,) = estimate(drawn()).region_plans
    return {str(c.pattern): c for c in part.candidates}


def test_the_drawn_region_is_the_transition_of_the_paper() -> None:
    """28 +- 2 elements on the fine front, 4 +- .5 on the coarse, 10 to 11.5 fronts."""
    profile = drawn()[0].profile
    assert profile.fine_elements == pytest.approx(28, abs=2)
    assert profile.coarse_elements == pytest.approx(4, abs=0.5)
    assert 10 <= profile.fronts <= 11.5


@pytest.mark.parametrize(
    ("pattern", "blocks", "triangles", "positive"), [("7:5:3:1", 24, 384, 2), ("7:4:1", 16, 256, 3)]
)
def test_the_patterns_of_the_paper_are_listed(
    listed: dict[str, Candidate], pattern: str, blocks: int, triangles: int, positive: int
) -> None:
    candidate = listed[pattern]
    assert candidate.n_blocks == blocks
    assert candidate.planned_triangles == triangles
    assert candidate.pattern.irregularity.positive == positive


def test_the_anisotropic_pattern_is_listed_and_rejected_with_its_reason(listed: dict[str, Candidate]) -> None:
    assert "strip 7:1 is anisotropic" in str(listed["7:1"].rejected)


@pytest.mark.parametrize("objective", OBJECTIVES)
def test_a_rejected_candidate_is_chosen_only_where_all_are(
    listed: dict[str, Candidate], objective: str
) -> None:
    assert choose(list(listed.values()), objective).rejected is None
    rejected = [c for c in listed.values() if c.rejected]
    assert choose(rejected, objective) in rejected


def test_objectives_choose_what_they_say(listed: dict[str, Candidate]) -> None:
    every = list(listed.values())
    good = [c for c in every if c.rejected is None]
    assert choose(every, "blocks").n_blocks == min(c.n_blocks for c in good)
    assert choose(every, "irregularity").pattern.irregularity.positive == min(
        c.pattern.irregularity.positive for c in good
    )
    assert choose(every, "quality").q_min == max(c.q_min for c in good)
    by_size = min(good, key=lambda c: c.misfit + 2 * c.count_misfit)
    assert choose(every, "size").misfit + 2 * choose(every, "size").count_misfit == pytest.approx(
        by_size.misfit + 2 * by_size.count_misfit
    )


def test_the_order_of_candidates_does_not_matter(listed: dict[str, Candidate]) -> None:
    every = list(listed.values())
    for objective in OBJECTIVES:
        assert choose(every, objective) is choose(every[::-1], objective)


def test_an_unknown_objective_names_the_known_ones(listed: dict[str, Candidate]) -> None:
    with pytest.raises(InvalidOption, match="'cheap' is unknown; choose one of size, blocks"):
        choose(list(listed.values()), "cheap")


def test_blocks_too_large_for_the_coarse_front_are_said_to_be() -> None:
    """The paper's limit: "constrained by the coarsest boundary which only contains four elements"."""
    (part,) = estimate(drawn(), tris_per_block=64).region_plans
    assert part.limited is not None
    assert "coarsest front, which only contains four elements" in part.limited
    assert part.largest_tris_per_block == 16
    (fitting,) = estimate(drawn(), tris_per_block=16).region_plans
    assert fitting.limited is None


def test_a_tie_in_quality_is_no_matter_of_rounding(listed: dict[str, Candidate]) -> None:
    """2:1:1:1 won over 2:2:2:1:1 by 1e-16, though it fits far worse."""
    first, second = (listed[name] for name in ("7:4:2:1", "7:4:1"))
    q = first.q_min
    worse, better = sorted((first, second), key=lambda c: -(c.misfit + c.count_misfit))
    tied = [
        replace(worse, rejected=None, spacing=Spacing(worse.spacing.positions, q + 1e-15, True)),
        replace(better, rejected=None, spacing=Spacing(better.spacing.positions, q, True)),
    ]
    assert choose(tied, "quality").pattern == better.pattern


def test_the_patterns_of_a_region_do_not_depend_on_the_other_regions() -> None:
    regions = [
        r
        for r in find_regions(size_field(read(CASES / "islands" / "mesh.msh").mesh))
        if r.kind == "transition"
    ]
    together = candidates(regions, 16)
    for k in (0, len(regions) // 2, len(regions) - 1):
        (alone,) = candidates([regions[k]], 16)
        assert [c.pattern for c in alone] == [c.pattern for c in together[k]]
        assert [c.q_min for c in alone] == pytest.approx([c.q_min for c in together[k]], abs=1e-9)
    assert candidates([], 16) == []
