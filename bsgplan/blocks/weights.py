"""Weights of the energy, in units of that of a triangle's quality."""

from __future__ import annotations

SHAPE_WEIGHT, SIZE_WEIGHT, VALENCE_WEIGHT, BEND_WEIGHT = 1.0, 0.5, 0.6, 1.0
"""Quality, size, irregularity and the bend of sides."""
