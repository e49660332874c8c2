"""The quality of the triangles between two fronts of any two lengths, open or closed.

Open fronts are concentric arcs between two radii: the walls of a transition region run along the gradient
of the size, square to its fronts, so a strip is a rectangle where its fronts are equally long and a piece of
an annulus, of angle (change of length) / width, where they are not. Closed fronts are circles around a common
axis, at a slant distance: the frustum of a cone, flat (a planar annulus) where the slant is all radial.
Triangle edges are chords. Both reduce to one formula, that of `width.py`: with
base b, height h and apex offset t from the middle of the base, q = 2 sqrt(3) b h / (2 h^2 + 3/2 b^2 + 2 t^2).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints, frozen_floats, frozen_ints
from .pattern import Pattern
from .shape import Shape
from .strip import critical_table, strip_table

FLAT = 1e-9
"""A frustum whose rise squared is under this share of its slant squared is flat: rounding of profiles
that are radial by construction (slope 2 pi), amplified by the square root."""


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
    own, other = np.where(side > 0, second, first), np.where(side > 0, first, second)
    if is_closed:
        turn = 2 * np.pi * (apex - midpoint)
        base = own * (np.sin(np.pi * share) / np.pi)
        offset = other * (np.sin(turn) / (2 * np.pi))
        radial = (other * np.cos(turn) - own * np.cos(np.pi * share)) / (2 * np.pi)
        difference = (other - own) / (2 * np.pi)
        square = rise(width, difference) ** 2
        height = np.sqrt(radial**2 + square) * np.sign(radial * difference + square)
    else:
        angle = (second - first) / width
        base = own * _sine(angle, share / 2) * 2
        offset = other * _sine(angle, apex - midpoint)
        sag = other * _versine(angle, apex - midpoint) - own * _versine(angle, share / 2)
        height = width - np.where(side > 0, -sag, sag)
    return np.asarray(2 * np.sqrt(3) * base * height / (2 * height**2 + 1.5 * base**2 + 2 * offset**2))


def rise(width: Floats, difference: Floats) -> Floats:
    """Return the axial distance of two rings from their slant width and the difference of their radii.

    The slant is at least the difference; flat within a tolerance.

    >>> rise(np.array([5.0, 3.0, 1.0]), np.array([4.0, 3.0, 2.0])).tolist()
    [3.0, 0.0, 0.0]
    """
    square = width**2 - difference**2
    return np.asarray(np.sqrt(np.where(square > FLAT * width**2, square, 0.0)))


def _sine(angle: Floats, share: Floats) -> Floats:
    """Return sin(angle * share) / angle, which is share where the angle is 0."""
    return np.asarray(share * np.sinc(angle * share / np.pi))


def _versine(angle: Floats, share: Floats) -> Floats:
    """Return (1 - cos(angle * share)) / angle, which is 0 where the angle is 0."""
    half = np.sin(angle * share / 2)
    return np.asarray(share * np.sinc(angle * share / (2 * np.pi)) * half)


@lru_cache(maxsize=1024)
def all_triangles(pattern: Pattern) -> tuple[Floats, Ints]:
    """Return the strip tables of a pattern side by side, (4, n_blocks), and the strip of each column."""
    return _side_by_side(pattern, strip_table)


@lru_cache(maxsize=1024)
def critical_triangles(pattern: Pattern) -> tuple[Floats, Ints]:
    """Return the critical columns of a pattern, (4, n_critical), and the strip of each."""
    return _side_by_side(pattern, critical_table)


def _side_by_side(pattern: Pattern, table: Callable[..., Floats]) -> tuple[Floats, Ints]:
    tables = [table(m, n, is_closed=pattern.is_closed) for m, n in pattern.strips]
    strip = np.repeat(np.arange(len(tables)), [part.shape[1] for part in tables])
    return frozen_floats(np.concatenate(tables, axis=1)), frozen_ints(strip)
