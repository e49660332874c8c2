"""What the search adds to the candidates of a plan: the paper's region, its limits, what stays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from bsgplan.io import read
from bsgplan.mesh import clean
from bsgplan.planning import estimate
from bsgplan.planning.candidate import MOST_SEARCHED, MOST_SHOWN
from bsgplan.planning.fit import LEAST_SEARCHED, searched
from bsgplan.regions import Profile, measure_regions
from bsgplan.regions.selection import triangles_inside
from bsgplan.sizing import size_field

CASES = Path(__file__).parents[2] / "cases"


def straight(fine, coarse, layers):
    """A profile of counts linear in the depth, over a region of height 1 and equilateral elements."""
    depths = np.linspace(0, layers, 41)
    counts = np.linspace(fine, coarse, 41)
    positions = np.concatenate([[0], np.cumsum(np.diff(depths) * 3**0.5 / (counts[1:] + counts[:-1]))])
    return Profile(depths, counts, positions, np.ones(41), positions)


@pytest.fixture(scope="module")
def listed():
    """Candidates of the paper's region, drawn by hand, by their pattern."""
    mesh = read(CASES / "rectangle" / "mesh.msh").mesh
    size = size_field(
        clean(mesh.points, mesh.triangles[triangles_inside(mesh, shapely.box(0.3, 0, 0.96, 1))]).mesh
    )
    label = np.zeros(size.mesh.n_triangles, dtype=np.int64)
    regions = measure_regions(size, label, np.zeros(1, dtype=bool))
    (part,) = estimate(regions, tris_per_block=16).region_plans
    return {str(c.pattern): c for c in part.candidates}


def test_the_search_adds_7_4_2_1_and_the_patterns_of_the_paper_stay_rejected(listed):
    better = listed["7:4:2:1"]
    assert better.rejected is None
    assert better.pattern.irregularity == listed["7:4:1"].pattern.irregularity
    assert better.q_min > listed["7:4:1"].q_min + 0.15
    for pattern, strip in (("7:5:3:1", "3:1"), ("7:4:1", "4:1")):
        assert f"strip {strip} is asymmetric" in str(listed[pattern].rejected)
    assert len(listed) <= MOST_SHOWN + MOST_SEARCHED


def test_what_is_found_has_the_ends_and_about_the_layers_of_the_region():
    found = searched(straight(28, 4, 9.5), 4, is_closed=False)
    assert (7, 4, 2, 1) in found
    assert all((c[0], c[-1]) == (7, 1) and 1 <= len(c) - 1 <= 4 for c in found)
    assert min(found.values()) >= LEAST_SEARCHED


def test_large_long_and_very_short_regions_are_not_searched():
    assert searched(straight(120, 4, 9.5), 4, is_closed=False) == {}
    assert searched(straight(8, 7, 400), 4, is_closed=False) == {}
    assert searched(straight(4, 4, 0.01), 4, is_closed=False) == {}
    assert all(min(c) >= 3 for c in searched(straight(28, 4, 9.5), 4, is_closed=True))
