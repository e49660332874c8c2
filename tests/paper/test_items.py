"""Printed digits and numbers of ours: what counts as the same."""

from __future__ import annotations

import pytest

from bsgplan.paper.item import Item, items_of, shows
from bsgplan.paper.printed import REASONS, TABLES, Printed, printed


@pytest.mark.parametrize(
    ("value", "text", "same"),
    [
        (0.866, "0.87", True),
        (0.8649, "0.87", False),
        (0.875, "0.87", True),
        (0.8751, "0.87", False),
        (0.9473, "0.95", True),
        (0.9473, "0.94", False),
        (1161.125, "1161", True),
        (1161.6, "1161", False),
        (32511.5, "32511.5", True),
        (-6, "-6", True),
        (-5, "-6", False),
        (0.7, ">= 0.70", True),
        (0.699, ">= 0.70", False),
        (10.4, "10 to 11", True),
        (11.2, "10 to 11", False),
        ("-2, +1, +1", "-2, +1, +1", True),
        ("-2, +1, 0", "-2, +1, +1", False),
        (1.0, "words", False),
    ],
)
def test_a_number_shows_the_printed_digits_or_not(value: float | str, text: str, same: bool) -> None:
    assert shows(value, text) is same


def test_cells_tell_paper_and_correct_apart() -> None:
    assert printed("table_1")["8", "q"] == Printed("0.94", "0.95")
    assert printed("figure_6")["b, 40:39:..:10", "q_min"] == Printed("0.79", "0.790")
    assert printed("figure_6")["b, fronts at best positions", "q_min"] == Printed(None, "0.803")
    assert printed("figure_6")["a, isotropic remeshing", "q_min"] == Printed("0.39", None)
    assert ("2:1", "top left") in printed("figure_2")
    assert ("3:1", "top left") not in printed("figure_2")


def test_more_digits_are_no_slip_but_another_number_is() -> None:
    assert not Item("figure_6", "b", "q_min", "0.79", "0.790", 0.79).is_slip
    assert Item("table_1", "8", "q", "0.94", "0.95", 0.9473).is_slip
    assert not Item("figure_6", "a", "q_min", "0.39", None, 0.7).is_slip


def test_nothing_is_said_where_there_is_nothing_to_compare() -> None:
    assert Item("figure_6", "a", "q_min", "0.39", None, 0.76).agrees is None
    assert Item("figure_6", "a", "q_min", "0.39", "0.39", None).agrees is None
    assert Item("table_1", "8", "q", "0.94", "0.95", 0.94).agrees is False


def test_every_slip_has_a_reason_and_every_reason_a_slip() -> None:
    slips = {(s, *place) for s in TABLES for place in printed(s) if _is_slip(s, place)}
    assert slips == set(REASONS)


def _is_slip(section: str, place: tuple[str, str]) -> bool:
    return next(item for item in items_of(section, {}) if (item.row, item.column) == place).is_slip


def test_numbers_keep_the_order_of_the_rows_and_extra_ones_follow() -> None:
    items = items_of(
        "figure_7", {("b, 128:64:..:1", "irregular"): 128, ("a, isotropic remeshing", "q_min"): 1.0}
    )
    assert [item.name for item in items][:4] == [
        "a, isotropic remeshing, triangles",
        "a, isotropic remeshing, q_min",
        "a, isotropic remeshing, q_mean",
        "b, 128:64:..:1, triangles",
    ]
    assert items[-1].name == "b, 128:64:..:1, irregular"
    assert (items[-1].paper, items[-1].agrees) == (None, None)


@pytest.mark.parametrize(
    ("ours", "correct", "text"),
    [
        (30.000000000000004, "30", "30"),
        (51.43, "51", "51.4"),
        (0.9473, "0.95", "0.947"),
        (5, "5", "5"),
        (None, "5", "-"),
    ],
)
def test_ours_is_shown_with_one_digit_more(ours: float | None, correct: str, text: str) -> None:
    assert Item("table_1", "8", "q", correct, correct, ours).shown == text
