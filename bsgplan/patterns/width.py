"""The straight strip in closed form: quality over width, the best width, the widths that reach a quality.

Two parallel fronts of equal height H with m and n elements, distance w. A triangle with base b whose apex
projects at distance e from the midpoint of the base has, with c = 3/2 b^2 + 2 e^2,

    q(w) = 2 sqrt(3) b w / (2 w^2 + c),     largest at w = sqrt(c / 2),
    q(w) >= Q  for  w  in  (2 sqrt(3) b -+ sqrt(12 b^2 - 8 Q^2 c)) / (4 Q).

q falls with c, so of each front only the triangle with the largest c counts: a strip is two triangles.
"""

from __future__ import annotations

from functools import lru_cache
from math import inf, sqrt

import numpy as np

from ..arrays import Floats, Ints, frozen_floats
from .strip import strip_table


@lru_cache(maxsize=4096)
def strip_form(m: int, n: int, *, is_closed: bool = False) -> Floats:
    """Return b and c of the worst triangle on either front at height 1, (2, 2).

    >>> strip_form(1, 1).tolist()
    [[1.0, 2.0], [1.0, 2.0]]
    """
    _, base, midpoint, apex = strip_table(m, n, is_closed=is_closed)
    c = 1.5 * base**2 + 2 * (apex - midpoint) ** 2
    return frozen_floats([[base[0], c[:m].max()], [base[-1], c[m:].max()]])


def strip_quality(m: int, n: int, width: float, *, height: float = 1.0, is_closed: bool = False) -> float:
    """Return the smallest mean ratio of a straight strip of this width.

    >>> round(strip_quality(2, 1, 0.5), 4)
    0.866
    """
    return float(form_quality(strip_form(m, n, is_closed=is_closed), np.array(width / height)))


def best_width(m: int, n: int, *, height: float = 1.0, is_closed: bool = False) -> tuple[float, float]:
    """Return the width at which a straight strip is best, length, and its smallest mean ratio there.

    The smaller of two unimodal curves is largest at a peak of either or where they cross.

    >>> [round(v, 4) for v in best_width(3, 1)]
    [0.5774, 0.5]
    """
    (b, c), (d, e) = strip_form(m, n, is_closed=is_closed).tolist()
    candidates = [sqrt(c / 2), sqrt(e / 2)]
    if b != d and (crossing := (d * c - b * e) / (2 * (b - d))) > 0:
        candidates.append(sqrt(crossing))
    q, w = max((strip_quality(m, n, w, is_closed=is_closed), w) for w in candidates)
    return w * height, q


def strip_forms(first: Ints, second: Ints, *, is_closed: bool = False) -> Floats:
    """Return `strip_form` of strips between these counts, (..., 2, 2), in closed form.

    The midpoints of the edges of one front, in units of 1 / (2 lcm), meet every odd residue between two
    vertices of the other where both reduced counts are odd, every even or every odd one under the half
    otherwise: the largest offset from the nearest vertex is half an edge of the other front where both are
    odd and the strip is open, 1 / (2 lcm) less elsewhere.

    >>> strip_forms(np.array(1), np.array(1)).tolist()
    [[1.0, 2.0], [1.0, 2.0]]
    """
    shared, least = np.gcd(first, second), np.lcm(first, second)
    is_tied = ((first // shared) % 2 == 1) & ((second // shared) % 2 == 1) & (not is_closed)
    less = np.where(is_tied, 0.0, 0.5 / least)
    base = 1 / np.stack([first, second], axis=-1)
    offset = base[..., ::-1] / 2 - less[..., None]
    return np.stack([base, 1.5 * base**2 + 2 * offset**2], axis=-1)


def best_widths(forms: Floats) -> tuple[Floats, Floats]:
    """Return `best_width` of strips of these forms, (n, 2, 2): widths and mean ratios, two of (n,)."""
    (b, c), (d, e) = forms.transpose(1, 2, 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        square = (d * c - b * e) / (2 * (b - d))
    trials = np.sqrt(np.stack([c / 2, e / 2, np.where(square > 0, square, c / 2)]))  # (3, n)
    qualities = np.stack([form_quality(forms, trial) for trial in trials])
    pick = qualities.argmax(axis=0), np.arange(len(forms))
    return trials[pick], qualities[pick]


def width_interval(
    m: int, n: int, q: float, *, height: float = 1.0, is_closed: bool = False
) -> tuple[float, float]:
    """Return the smallest and largest width of a straight strip with mean ratio at least q, length.

    (inf, -inf) where no width reaches q.

    >>> [round(w, 3) for w in width_interval(2, 1, 0.8)]
    [0.433, 0.749]
    """
    low, high = width_intervals(strip_form(m, n, is_closed=is_closed)[None], q)
    return float(low[0]) * height, float(high[0]) * height


def form_quality(forms: Floats, widths: Floats) -> Floats:
    """Return the smallest mean ratio of each strip at its width, (n_strips,); forms as below."""
    b, c, w = forms[..., 0], forms[..., 1], widths[..., None]
    return np.asarray((2 * np.sqrt(3) * b * w / (2 * w**2 + c)).min(axis=-1))


def width_intervals(forms: Floats, q: float | Floats) -> tuple[Floats, Floats]:
    """Return smallest and largest width of each strip with mean ratio at least q, two of (n_strips,).

    forms holds `strip_form` of each strip, (n_strips, 2, 2), q one quality or one a strip, (n_strips, 1);
    (inf, -inf) where no width reaches q.
    """
    b, c = forms[..., 0], forms[..., 1]
    root = 12 * b**2 - 8 * q**2 * c
    high = (2 * np.sqrt(3) * b + np.sqrt(np.maximum(root, 0))) / (4 * q)
    low = c / (2 * high)  # the product of both is c / 2: no cancellation
    narrow, wide = low.max(axis=1), high.min(axis=1)
    is_empty = (root.min(axis=1) < 0) | (narrow > wide)
    return np.where(is_empty, inf, narrow), np.where(is_empty, -inf, wide)
