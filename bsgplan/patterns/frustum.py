"""The quality of the triangles between two fronts of any two lengths, open or closed.

Open fronts are concentric arcs between two radii: the walls of a transition region run along the gradient
of the size, square to its fronts, so a strip is a rectangle where its fronts are equally long and a piece of
an annulus, of angle (change of length) / width, where they are not. Closed fronts are circles around a common
axis, at a slant distance: the frustum of a cone, flat (a planar annulus) where the slant is all radial.
Triangle edges are chords. Both reduce to one formula, that of `width.py`: with
base b, height h and apex offset t from the middle of the base, q = 2 sqrt(3) b h / (2 h^2 + 3/2 b^2 + 2 t^2).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints
from .pattern import Pattern
from .shape import Shape
from .strip import strip_table

FLAT = 1e-9
"""A frustum whose rise squared is under this share of its slant squared is flat: rounding of profiles
that are radial by construction (slope 2 pi), amplified by the square root."""

NO_ANGLE = 1e-20
"""Fronts whose lengths differ by less than this share of their distance are straight: far below rounding."""


def pattern_qualities(pattern: Pattern, shape: Shape, positions: Floats) -> Floats:
    """Return the mean ratio of each block with fronts at these positions, (n_blocks,).

    In the order of `realise`; below 0 where a chord of a ring cuts through the next ring.

    >>> pattern_qualities(Pattern.parse("2:1"), Shape.rectangle(0.5), np.array([0.0, 0.5])).round(3)
    array([0.866, 0.866, 0.866])
    """
    table, strip = all_triangles(pattern)
    lengths = shape.front_lengths(positions)
    width = np.diff(positions)[strip]
    return mean_ratios(table, lengths[strip], lengths[strip + 1], width, is_closed=pattern.is_closed)


def mean_ratios(table: Floats, first: Floats, second: Floats, width: Floats, *, is_closed: bool) -> Floats:
    """Return the mean ratio of triangles between fronts of these lengths at this (slant) width.

    table has the four rows of `strip_table`; its columns and the other arguments broadcast together.
    """
    side, share, midpoint, apex = table
    measures = gap_measures(first, second, width, is_closed=is_closed)
    other, longer, third = (np.where(side > 0, on_second, on_first) for on_first, on_second in measures)
    return gap_ratios(share, apex - midpoint, other, longer, third, is_closed=is_closed)


def gap_measures(first: Floats, second: Floats, width: Floats, *, is_closed: bool) -> Floats:
    """Return what `gap_ratios` asks of fronts this width apart, (3, 2, ...): base on the first, the second.

    The length of the front with the apex, by how much longer the front with the base is, and the width of
    rings or the angle by which arcs turn: their radii are length over angle.
    """
    first, second, width = np.broadcast_arrays(first, second, width)
    longer = first - second
    if is_closed:
        return np.array([[second, first], [longer, -longer], [width, width]])
    angle = longer / width
    angle = np.where(np.abs(angle) < NO_ANGLE, NO_ANGLE, angle)
    longer = angle * width
    return np.array([[second, first], [longer, -longer], [angle, -angle]])


def gap_ratios(
    share: Floats, turn: Floats, other: Floats, longer: Floats, third: Floats, *, is_closed: bool
) -> Floats:
    """Return the mean ratio of triangles by the share of their base, and the turn of apex against midpoint.

    other, longer and third are those of `gap_measures`; all broadcast together.
    """
    own = other + longer
    if is_closed:
        half, angle = np.pi * share, 2 * np.pi * turn
        base = own * (np.sin(half) / (2 * np.pi))
        offset = other * (np.sin(angle) / (2 * np.pi))
        radial = other * (np.cos(angle) / (2 * np.pi)) - own * (np.cos(half) / (2 * np.pi))
        difference = longer / (-2 * np.pi)
        square = rise(third, difference) ** 2
        height = np.sqrt(radial**2 + square) * np.sign(radial * difference + square)
    else:  # all lengths times half the angle; by half angles, for a difference of cosines would cancel
        sine, sine_of_turn = np.sin(third * (share / 4)), np.sin(third * (turn / 2))
        if np.abs(third).max(initial=0.0) > 2 * np.pi:  # share and twice the turn are at most 1
            cosine, cosine_of_turn = np.cos(third * (share / 4)), np.cos(third * (turn / 2))
        else:  # no angle is over a right one: a root is a tenth of the cost
            cosine, cosine_of_turn = np.sqrt(1 - sine * sine), np.sqrt(1 - sine_of_turn * sine_of_turn)
        across, beyond = own * sine, other * sine_of_turn
        base, offset = across * cosine, beyond * cosine_of_turn
        height = longer / 2 + beyond * sine_of_turn - across * sine
    return np.asarray(2 * np.sqrt(3) * base * height / (height**2 + 3 * base**2 + offset**2))


def rise(width: Floats, difference: Floats) -> Floats:
    """Return the axial distance of two rings from their slant width and the difference of their radii.

    The slant is at least the difference; flat within a tolerance.

    >>> rise(np.array([5.0, 3.0, 1.0]), np.array([4.0, 3.0, 2.0])).tolist()
    [3.0, 0.0, 0.0]
    """
    square = width**2 - difference**2
    return np.asarray(np.sqrt(np.where(square > FLAT * width**2, square, 0.0)))


@lru_cache(maxsize=1024)
def all_triangles(pattern: Pattern) -> tuple[Floats, Ints]:
    """Return the strip tables of a pattern side by side, (4, n_blocks), and the strip of each column."""
    tables = [strip_table(m, n, is_closed=pattern.is_closed) for m, n in pattern.strips]
    strip = np.repeat(np.arange(len(tables)), [part.shape[1] for part in tables])
    return frozen_floats(np.concatenate(tables, axis=1)), frozen_ints(strip)
