"""Regions drawn by the user: a polygon from text, and the triangles inside it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from ..arrays import Bools
from ..errors import InvalidOption, MeshReadError, NoPatternFits
from ..mesh import Mesh

USE = "give a WKT polygon, a box x0,y0,x1,y1 or a GeoJSON file"


def parse_region(text: str) -> BaseGeometry:
    """Return the polygon that a user wrote: WKT, a box x0,y0,x1,y1, or the path of a GeoJSON file.

    Raises InvalidOption where the text is none of these, MeshReadError where the file is not readable.

    >>> parse_region("0,0,2,1").area
    2.0
    """
    numbers = text.split(",")
    if len(numbers) == 4 and all(_is_number(n) for n in numbers):
        x0, y0, x1, y1 = (float(n) for n in numbers)
        return _checked(shapely.box(min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)), text)
    if len(numbers) > 1 and all(_is_number(n) for n in numbers):
        raise InvalidOption(f"region {text!r} has {len(numbers)} numbers, a box has four; {USE}")
    if "(" in text:
        try:
            return _checked(shapely.from_wkt(text), text)
        except shapely.errors.ShapelyError as error:
            raise InvalidOption(f"region {text!r} is not valid WKT ({_first_line(error)}); {USE}") from None
    path = Path(text)
    if not path.suffix:
        raise InvalidOption(f"region {text!r} is not understood; {USE}")
    return _checked(_from_geojson(path), text)


def triangles_inside(mesh: Mesh, region: BaseGeometry) -> Bools:
    """Return the triangles whose centroid lies in a polygon, (n_triangles,).

    Raises NoPatternFits where there are none, telling where the mesh lies.
    """
    shapely.prepare(region)
    inside: Bools = shapely.contains_xy(region, *mesh.centroids[:, :2].T)
    if not inside.any():
        x0, x1, y0, y1 = mesh.bounds[:4]
        raise NoPatternFits(
            f"the region {_box(region.bounds)} holds no triangle; the mesh lies in {_box((x0, y0, x1, y1))}"
        )
    return inside


def _from_geojson(path: Path) -> BaseGeometry:
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        features = document.get("features", [document]) if isinstance(document, dict) else []
        shapes = [shapely.from_geojson(json.dumps(f.get("geometry", f))) for f in features]
    except OSError as error:
        raise MeshReadError(f"{path}: {error.strerror}; {USE}") from None
    except (ValueError, AttributeError, shapely.errors.ShapelyError) as error:
        raise MeshReadError(f"{path}: not GeoJSON ({_first_line(error)}); {USE}") from None
    return shapely.union_all(shapes)


def _checked(region: BaseGeometry, text: str) -> BaseGeometry:
    if region.geom_type not in {"Polygon", "MultiPolygon"}:
        raise InvalidOption(f"region {text!r} is a {region.geom_type}, not a polygon; {USE}")
    x0, y0, x1, y1 = region.bounds
    if not (np.isfinite(region.bounds).all() and x1 > x0 and y1 > y0):
        raise InvalidOption(f"region {text!r} has no area; {USE}")
    if not region.is_valid:
        raise InvalidOption(
            f"region {text!r} is not a simple polygon ({shapely.is_valid_reason(region)}); "
            "list its corners in order"
        )
    return region


def _is_number(text: str) -> bool:
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False


def _box(bounds: tuple[float, ...]) -> str:
    x0, y0, x1, y1 = bounds
    return f"[{x0:g}, {x1:g}] x [{y0:g}, {y1:g}]"


def _first_line(error: BaseException) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__
