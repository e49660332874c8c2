"""The noun View: a mesh as it is drawn, in plot coordinates, with units and what is seen of a surface.

A planar mesh is drawn as it is, or in degrees where it was projected; a surface on its two largest principal
axes, seen from outside where it is closed. Invariant: later triangles are nearer to the eye.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..mesh import Mesh
from ..sizing import SizeField

ZOOM_SHARE = 0.25
"""Share of the triangles, the finest ones, that decides about a zoom."""

ZOOM_UNDER = 0.1
"""A zoom is drawn where they take less than this share of the domain's extent."""

SHOWN_SHARE = 0.5
"""Share of the triangles, the finest ones, that a zoom shows."""


class GlobeMap(Protocol):
    """What a figure needs of a map projection; `io.Projection` is one."""

    @property
    def longitude(self) -> float:
        """Longitude of the centre, degrees."""

    def to_degrees(self, points: Floats) -> Floats:
        """Return longitude and latitude, (n, 2), of points in the plane."""

    def scale(self, points: Floats) -> Floats:
        """Return plane length per true length, (n,)."""


@dataclass(frozen=True, eq=False)
class View:
    """Where things of a mesh are drawn."""

    mesh: Mesh = field(repr=False)
    """The mesh."""
    projection: GlobeMap | None
    """The map that leads back to degrees, or None."""
    shown: Ints = field(repr=False)
    """Triangles drawn, (n,), the nearest last."""
    axes: Floats | None
    """The two axes a surface is drawn on, (2, 3), or None."""
    scale: Floats = field(repr=False)
    """Drawn size per true size at each point, (n_points,)."""

    def place(self, points: Floats) -> Floats:
        """Return plot coordinates, (..., 2), of points of the mesh, (..., 2 or 3)."""
        flat = points.reshape(-1, points.shape[-1])
        if self.axes is not None:
            flat = flat @ self.axes.T
        if self.projection is not None:
            flat = self.projection.to_degrees(flat)
            centre = self.projection.longitude
            flat[:, 0] = centre + np.mod(flat[:, 0] - centre + 180.0, 360.0) - 180.0
        return flat.reshape(*points.shape[:-1], 2)

    @property
    def placed(self) -> Floats:
        """Plot coordinates of the points, (n_points, 2)."""
        return self.place(self.mesh.points)

    @property
    def axis_labels(self) -> tuple[str, str]:
        """What stands at the axes."""
        if self.projection is not None:
            return "longitude [degrees]", "latitude [degrees]"
        if self.axes is not None:
            return "first principal axis [length of the file]", "second principal axis"
        return "x [length of the file]", "y"

    @property
    def size_unit(self) -> str:
        """Unit of sizes."""
        return "km" if self.projection is not None else "length of the file"

    @property
    def size_factor(self) -> float:
        """That unit in the unit of the mesh."""
        return 1000.0 if self.projection is not None else 1.0

    def stretch(self, box: Floats) -> float:
        """Return drawn height per drawn width of one plot unit: 1 / cos(latitude) in degrees, else 1."""
        if self.projection is None:
            return 1.0
        return float(1 / max(np.cos(np.radians(box[:, 1].mean())), 0.05))


def view_of(mesh: Mesh, projection: GlobeMap | None) -> View:
    """Return the view of a mesh; a surface is turned so that its two longest directions are seen."""
    everything = np.arange(mesh.n_triangles)
    scale = np.ones(mesh.n_points) if projection is None else projection.scale(mesh.points)
    if mesh.is_planar:
        return View(mesh, projection, everything, None, scale)
    middle = mesh.centroids - np.average(mesh.centroids, axis=0, weights=mesh.areas)
    axes = np.linalg.svd((middle * mesh.areas[:, None]).T @ middle)[2]
    axes *= np.sign(axes[np.arange(3), np.abs(axes).argmax(axis=1)])[:, None]  # no sign left to chance
    axes[2] = np.cross(axes[0], axes[1])
    shown = everything[_is_seen(mesh, axes[2])]
    shown = shown[np.argsort(mesh.centroids[shown] @ axes[2], kind="stable")]
    return View(mesh, projection, shown, axes[:2], scale)


def domain_box(view: View) -> Floats:
    """Return the lower left and the upper right corner of what is drawn, (2, 2)."""
    placed = view.placed
    return np.array([placed.min(axis=0), placed.max(axis=0)])


def zoom_box(view: View, size: SizeField) -> Floats | None:
    """Return the box around the finest triangles, (2, 2), or None where they are spread over the domain."""
    order = np.argsort(size.triangle_h[view.shown], kind="stable")
    centres = view.place(view.mesh.centroids[view.shown])[order]
    extent = float(np.ptp(domain_box(view), axis=0).max())
    finest = centres[: max(1, int(ZOOM_SHARE * len(centres)))]
    if np.ptp(finest, axis=0).max() > ZOOM_UNDER * extent:
        return None
    part = centres[: max(1, int(SHOWN_SHARE * len(centres)))]
    middle, half = (part.min(axis=0) + part.max(axis=0)) / 2, 0.55 * np.ptp(part, axis=0).max()
    half = min(half, ZOOM_UNDER * extent)
    if not half > 0:
        return None
    return np.array([middle - half, middle + half])


def with_margin(box: Floats) -> Floats:
    """Return a box widened by a little."""
    margin = 0.02 * np.ptp(box, axis=0).max()
    return np.array([box[0] - margin, box[1] + margin])


def filled(box: Floats, shape: Floats, view: View) -> Floats:
    """Return the box widened about its middle to the shape of its panel, so that lengths are equal."""
    middle, extent = box.mean(axis=0), np.ptp(box, axis=0)
    stretch = view.stretch(box)
    unit = max(extent[0] / shape[0], extent[1] * stretch / shape[1])  # plot units an inch, across
    half = unit * shape / [2.0, 2.0 * stretch]
    return np.array([middle - half, middle + half])


def _is_seen(mesh: Mesh, towards_eye: Floats) -> Bools:
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    if mesh.topology.n_boundary_loops:
        return np.ones(mesh.n_triangles, dtype=bool)
    volume = np.einsum("ti,ti->", a - mesh.points.mean(axis=0), normal)
    return np.asarray(normal @ towards_eye * np.sign(volume) > 0)
