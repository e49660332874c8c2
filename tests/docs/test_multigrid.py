"""Patterns in practice: multigrid on refined patterns is as fast as their quality lets one expect."""

from __future__ import annotations

import re
import runpy
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = runpy.run_path(str(ROOT / "scripts" / "make_multigrid.py"))
ROW = re.compile(r"^(\d[\d:]+) +([\d.]+) +(\d+) +([\d.]+) +([\d.]+) +(\d+) +(\d+)$", re.MULTILINE)


def stored() -> list[tuple[str, list[float]]]:
    rows = ROW.findall((ROOT / "docs" / "practice" / "multigrid.txt").read_text())
    return [(name, [float(number) for number in numbers]) for name, *numbers in rows]


def factor(name: str, length: float | None, n_refinements: int) -> float:
    realised, _ = SCRIPT["straight"](name, length)
    return SCRIPT["v_cycle_factor"](SCRIPT["levels"](realised, n_refinements))


@pytest.mark.parametrize("length", [None, 0.7])
def test_7_4_2_1_beats_7_4_1_and_that_7_1(length: float | None) -> None:
    one, two, three = (factor(name, length, 4) for name in ("7:4:2:1", "7:4:1", "7:1"))
    assert one < two - 0.1 < three - 0.2
    assert one < 0.5


def test_the_factor_hardly_depends_on_the_refinement() -> None:
    factors = [factor("7:4:2:1", None, n) for n in (3, 4, 5)]
    assert 0 < factors[2] - factors[1] < (factors[1] - factors[0]) / 2


def test_a_v_cycle_solves_the_equations() -> None:
    """The prolongation is that of linear functions, and Galerkin's product the matrix of the grid below."""
    realised, _ = SCRIPT["straight"]("7:4:2:1", None)
    grids = SCRIPT["levels"](realised, 3)
    for below, grid in pairwise(grids):
        product = grid.prolongation.T @ grid.matrix @ grid.prolongation
        assert np.allclose(product.toarray(), below.matrix.toarray(), atol=1e-12)


def test_the_table_is_what_the_script_makes() -> None:
    rows = stored()
    assert [name for name, _ in rows] == 2 * list(SCRIPT["PATTERNS"])
    for k, (name, (wide, blocks, q_min, told, cycles, work)) in enumerate(rows):
        length = SCRIPT["LENGTHS"][k // len(SCRIPT["PATTERNS"])]
        realised, quality = SCRIPT["straight"](name, length)
        assert np.ptp(realised.points[:, 0]) == pytest.approx(wide, abs=1e-3)
        assert (len(realised.triangles), cycles * blocks) == (blocks, work)
        assert quality == pytest.approx(q_min, abs=1e-3)
        assert factor(name, length, SCRIPT["REFINEMENTS"] - 1) == pytest.approx(told, abs=0.04)


def test_at_the_best_lengths_the_factor_falls_as_the_quality_rises() -> None:
    rows = sorted(stored()[: len(SCRIPT["PATTERNS"])], key=lambda row: row[1][2])
    factors = [numbers[3] for _, numbers in rows]
    assert all(a >= b - 0.02 for a, b in pairwise(factors))
    cheapest = min(rows, key=lambda row: row[1][5])
    assert cheapest[0] == "7:4:2:1"
