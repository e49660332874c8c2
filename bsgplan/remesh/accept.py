"""Whether a replaced part pays: fewer irregular vertices, quality kept, sizes and triangles within bounds."""

from __future__ import annotations

from dataclasses import dataclass

from .measures import Measures

LEAST_GAIN = 0.2
"""A part is replaced only for so large a share of its n irregular vertices, and for sqrt(n) of them: less is
chance, and another run would do it again."""

QUALITY_LOSS = 0.02
"""The worst triangle may lose so much."""

SMALLEST_MISFIT = 0.02
"""A size misfit under this is as good as none."""


@dataclass(frozen=True)
class Terms:
    """What a replacement must keep to."""

    tolerance: float = 0.1
    """Share by which triangles may differ in number, and by which the size misfit may grow."""
    min_quality: float | None = None
    """The least mean ratio asked for, beside what the part had."""


def gains(before: Measures, after: Measures) -> bool:
    """Return True where enough irregular vertices go, some of them inside."""
    gone = _irregular(before) - _irregular(after)
    n = _irregular(before)
    is_enough = gone >= max(1.0, LEAST_GAIN * n, n**0.5)
    return is_enough and after.irregular_interior < before.irregular_interior


def refusal(before: Measures, after: Measures, wanted: float, terms: Terms) -> str:
    """Return why a part is left alone, "" where the replacement pays. wanted is the number of triangles.

    >>> refusal(a := Measures(9, 9, 8, 0, 0, None, .8, .8, .9, .1), a, 9.0, Terms())
    'no more than 0 of 8 irregular vertices would go'
    """
    if not gains(before, after):
        gone = max(_irregular(before) - _irregular(after), 0)
        return f"no more than {gone} of {_irregular(before)} irregular vertices would go"
    if terms.min_quality is not None and after.q_min < terms.min_quality:
        return f"quality {after.q_min:.3f} would be under the {terms.min_quality:g} asked for"
    if after.q_min < before.q_min - QUALITY_LOSS:
        return f"quality would fall from {before.q_min:.3f} to {after.q_min:.3f}"
    if abs(after.n_triangles / wanted - 1.0) > terms.tolerance:
        return f"triangles would be {after.n_triangles}, {wanted:.0f} are wanted"
    if after.size_misfit > max(before.size_misfit, SMALLEST_MISFIT) * (1.0 + terms.tolerance):
        return f"the size misfit would grow from {before.size_misfit:.3f} to {after.size_misfit:.3f}"
    return ""


def _irregular(measures: Measures) -> int:
    return measures.irregular_interior + measures.irregular_boundary_fitted
