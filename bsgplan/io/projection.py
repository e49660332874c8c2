"""The noun Projection: degrees of longitude and latitude mapped to metres in a plane, angles kept.

An oblique stereographic map about the domain's centre on the WGS84 ellipsoid (pyproj). It is conformal:
quality and irregularity keep their meaning, and lengths are true after division by the local `scale`.
"""

from __future__ import annotations

import logging
import re
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import InvalidMesh
from ..mesh import clean
from .file import MeshFile, RawMesh

OCEAN_FORMATS = ("fort.14", "netcdf", "selafin")
"""Formats of ocean models, whose coordinates are degrees more often than not."""
DEPTH = re.compile("depth|bathy|bottom", re.IGNORECASE)
"""What point arrays of ocean models are called: one that varies tells of a mesh of the sea in any format."""
SMALLEST_DEGREES = 0.01
"""An ocean domain is more than a kilometre across; a smaller box of numbers is no box of degrees."""


@dataclass(frozen=True)
class Projection:
    """An oblique stereographic map with its centre, and the range of longitudes the file uses."""

    longitude: float
    """Longitude of the centre, degrees."""
    latitude: float
    """Latitude of the centre, degrees."""
    west: float = -180.0
    """Longitudes are given back in [west, west + 360), as the file had them; degrees."""

    @cached_property
    def _map(self) -> Any:
        import pyproj

        return pyproj.Proj(proj="stere", lat_0=self.latitude, lon_0=self.longitude, ellps="WGS84", k_0=1)

    def to_plane(self, degrees: Floats) -> Floats:
        """Return plane coordinates, (n, 2), metres, of (longitude, latitude) pairs, (n, 2), degrees."""
        x, y = self._map(degrees[:, 0], degrees[:, 1])
        plane = np.column_stack([x, y])
        is_bad = ~np.isfinite(plane).all(axis=1)
        if is_bad.any():
            first = degrees[np.flatnonzero(is_bad)[0]]
            raise InvalidMesh(
                f"the point {first[0]:g} {first[1]:g} lies opposite the domain's centre "
                "and has no place in the plane; plan a part of the globe"
            )
        return plane

    def to_degrees(self, points: Floats) -> Floats:
        """Return (longitude, latitude), (n, 2), degrees, of points in the plane, (n, 2), metres."""
        longitude, latitude = self._map(points[:, 0], points[:, 1], inverse=True)
        return np.column_stack([self.west + np.mod(longitude - self.west, 360.0), latitude])

    def to_unbroken_degrees(self, points: Floats) -> Floats:
        """Return (longitude, latitude), (n, 2), degrees, with longitudes within 180 of the centre.

        A mesh across the date line is not torn; its longitudes may pass 180.
        """
        degrees = self.unbroken(self.to_degrees(points))
        if degrees[:, 0].mean() < self.west:
            degrees[:, 0] += 360.0
        return degrees

    def unbroken(self, degrees: Floats) -> Floats:
        """Return (longitude, latitude), (n, 2), degrees, with longitudes within 180 of the centre."""
        longitude = self.longitude + np.mod(degrees[:, 0] - self.longitude + 180.0, 360.0) - 180.0
        return np.column_stack([longitude, degrees[:, 1]])

    def scale(self, points: Floats) -> Floats:
        """Return plane metres per true metre at points of the plane, (n,), dimensionless."""
        if not len(points):
            return np.empty(0)
        longitude, latitude = self._map(points[:, 0], points[:, 1], inverse=True)
        return np.asarray(self._map.get_factors(longitude, latitude).meridional_scale, dtype=np.float64)

    def description(self) -> dict[str, Any]:
        """Return the map as plain data for a JSON document."""
        return {
            "method": "oblique stereographic",
            "ellipsoid": "WGS84",
            "longitude": self.longitude,
            "latitude": self.latitude,
        }


def projection_of(degrees: Floats) -> Projection:
    """Return the projection centred on points, (n, 2), degrees, wherever the date line runs.

    The centre is the mean unit vector, so that 179 and -179 are neighbours.
    """
    _check_degrees(degrees)
    longitude, latitude = np.radians(degrees).T
    x, y = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
    mean = np.array([x.mean(), y.mean(), np.sin(latitude).mean()])
    centre = np.degrees([np.arctan2(mean[1], mean[0]), np.arctan2(mean[2], np.hypot(mean[0], mean[1]))])
    west = -180.0 if degrees[:, 0].max() < 180.0 or degrees[:, 0].min() < 0 else 0.0
    return Projection(float(centre[0]), float(centre[1]), west)


def project(mesh_file: MeshFile) -> MeshFile:
    """Return a mesh read in degrees as a mesh in metres of the plane, with its projection.

    `read_lonlat` does the same before the clean-up, which a mesh torn by the date line needs.
    """
    if mesh_file.projection is not None:
        return mesh_file
    raw = RawMesh(mesh_file.mesh.points, mesh_file.mesh.triangles, np.empty((0, 4), dtype=np.int64))
    try:
        planar, projection = project_raw(raw)
        quad_points = (
            projection.to_plane(mesh_file.quad_points) if len(mesh_file.quads) else mesh_file.quad_points
        )
        mesh = clean(planar.points, planar.triangles).mesh
    except InvalidMesh as error:
        raise InvalidMesh(f"{mesh_file.path}: {error}") from None
    return replace(mesh_file, mesh=mesh, quad_points=quad_points, projection=projection)


def project_raw(raw: RawMesh) -> tuple[RawMesh, Projection]:
    """Return what a reader found in degrees, with its points in metres of the plane, and the map."""
    points = raw.points
    if points.shape[1] == 3 and np.ptp(points[:, 2]) > 0:
        raise InvalidMesh(
            "points have three coordinates that vary, not longitude and latitude; leave out --lonlat"
        )
    is_used = np.zeros(len(points), dtype=bool)
    cells = np.concatenate([raw.triangles.ravel(), raw.quads.ravel()])
    is_used[cells[(cells >= 0) & (cells < len(points))]] = True
    if not is_used.any():
        raise InvalidMesh("no cell names a point; repair the file")
    projection = projection_of(points[is_used, :2])
    plane = np.zeros((len(points), 2))
    plane[is_used] = projection.to_plane(points[is_used, :2])
    return replace(raw, points=plane), projection


def looks_like_degrees(mesh_file: MeshFile) -> bool:
    """Return True for an ocean model's mesh, not projected, whose box fits degrees."""
    if mesh_file.projection is not None or not mesh_file.mesh.is_planar or not _is_of_the_sea(mesh_file):
        return False
    west, east, south, north = mesh_file.mesh.bounds
    is_inside = west >= -180 and east <= 360 and south >= -90 and north <= 90
    return is_inside and max(east - west, north - south) > SMALLEST_DEGREES


def _is_of_the_sea(mesh_file: MeshFile) -> bool:
    """Return True for a fort.14, and for other meshes of the sea unless a corner of their box is the origin.

    A basin that is drawn from the origin on is no map, and any generator's output converts to these formats.
    """
    if mesh_file.format == "fort.14":
        return True
    if mesh_file.mesh.bounds[0] == 0.0 == mesh_file.mesh.bounds[2]:
        return False
    return mesh_file.format in OCEAN_FORMATS or any(
        DEPTH.search(name) and values.size and np.ptp(values) > 0
        for name, values in mesh_file.point_data.items()
    )


def warn_of_degrees(mesh_file: MeshFile) -> None:
    """Warn where a mesh looks like degrees and was not projected."""
    if looks_like_degrees(mesh_file):
        logging.getLogger("bsgplan").warning(
            "%s: the coordinates look like degrees, lengths are then no lengths; give --lonlat",
            mesh_file.path,
        )


def _check_degrees(degrees: Floats) -> None:
    longitude, latitude = degrees.T
    for name, values, low, high in (("longitude", longitude, -180, 360), ("latitude", latitude, -90, 90)):
        is_bad = ~((values >= low) & (values <= high))
        if is_bad.any():
            first = values[np.flatnonzero(is_bad)[0]]
            raise InvalidMesh(
                f"{name} {first:g} is outside {low} .. {high} ({np.count_nonzero(is_bad)} such points); "
                "the coordinates are no degrees, leave out --lonlat"
            )
