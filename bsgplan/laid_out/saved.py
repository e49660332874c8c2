"""Blocks and grid as arrays in the JSON document of a layout, and back from it.

"blocks" and "grid": points (n, 2) in the plane of the layout, triangles (n, 3) from 0, point_data, cell_data,
cell_names, boundaries {kind, code, name, nodes, partners, columns, edges}, title, projection or null.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..errors import BsgplanError, MeshReadError
from ..io import Boundary, MeshFile, Projection
from ..mesh import clean
from .laid_out import FORMAT

SCHEMA = "bsgplan.layout/1"
"""The `schema` of the document."""

PARTS = ("blocks", "grid")
"""The meshes in it."""

REMEDY = "save the layout again (bsgplan layout --save)"


def arrays_of(mesh_file: MeshFile) -> dict[str, Any]:
    """Return the arrays of a mesh file as plain data for a JSON document; a number that is none is null."""
    projection = mesh_file.projection
    return {
        "title": mesh_file.title,
        "points": mesh_file.mesh.points.tolist(),
        "triangles": mesh_file.mesh.triangles.tolist(),
        "point_data": {name: _plain(values) for name, values in mesh_file.point_data.items()},
        "cell_data": {name: _plain(values) for name, values in mesh_file.cell_data.items()},
        "cell_names": {
            array: {str(number): name for number, name in names.items()}
            for array, names in mesh_file.cell_names.items()
        },
        "boundaries": [
            {
                "kind": b.kind,
                "code": b.code,
                "name": b.name,
                "nodes": b.nodes.tolist(),
                "partners": None if b.partners is None else b.partners.tolist(),
                "columns": None if b.columns is None else _plain(b.columns),
                "edges": None if b.edges is None else b.edges.tolist(),
            }
            for b in mesh_file.boundaries
        ],
        "projection": None
        if projection is None
        else {"longitude": projection.longitude, "latitude": projection.latitude, "west": projection.west},
    }


def load_layout(path: str | os.PathLike[str], part: str) -> MeshFile:
    """Return the blocks or the grid of a saved layout; raises MeshReadError for a file that is none."""
    try:
        return _loaded(Path(path), part)
    except BsgplanError as error:
        raise MeshReadError(f"{os.fspath(path)}: {error}") from None
    except (ValueError, RecursionError, OverflowError) as error:
        what = "too deeply nested" if isinstance(error, RecursionError) else str(error)
        raise MeshReadError(f"{os.fspath(path)}: no readable JSON ({what}); {REMEDY}") from None
    except OSError as error:
        raise MeshReadError(
            f"{os.fspath(path)}: cannot be read ({error.strerror or error}); check the file"
        ) from None
    except MemoryError:
        raise MeshReadError(f"{os.fspath(path)}: does not fit into memory; {REMEDY}") from None


def _loaded(path: Path, part: str) -> MeshFile:
    document = json.loads(path.read_text(encoding="utf-8"))
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema != SCHEMA:
        raise MeshReadError(f"its schema is {_shown(schema)}, not {SCHEMA!r}; give a saved layout")
    if part not in document:
        raise MeshReadError(f"holds no {part!r}; {REMEDY}")
    found = _field(document, part, dict, part)
    points = _floats(_field(found, "points", list, part), f"{part}.points", 2)
    triangles = _ints(_field(found, "triangles", list, part), f"{part}.triangles", 2, len(points))
    if not np.isfinite(points).all() or points.shape[1:] != (2,) or triangles.shape[1:] != (3,):
        raise MeshReadError(f"{part}: needs finite points (n, 2) and triangles (n, 3); {REMEDY}")
    cleaned = clean(points, triangles)
    if cleaned.n_flipped or len(cleaned.kept_points) != len(points):
        raise MeshReadError(f"{part}: has inverted triangles or points in no triangle; {REMEDY}")
    boundaries = _field(found, "boundaries", list, part)
    names = _field(found, "cell_names", dict, part)
    title = found.get("title")
    return MeshFile(
        path=os.fspath(path),
        format=FORMAT,
        mesh=cleaned.mesh,
        quads=np.empty((0, 4), dtype=np.int64),
        quad_points=np.empty((0, 2)),
        point_data=_data(_field(found, "point_data", dict, part), len(points), f"{part}.point_data"),
        cell_data=_data(_field(found, "cell_data", dict, part), len(triangles), f"{part}.cell_data"),
        cell_names={str(array): _names(given, part) for array, given in names.items()},
        boundaries=tuple(
            _boundary(b, len(points), f"{part}.boundaries[{k}]") for k, b in enumerate(boundaries)
        ),
        title=title if isinstance(title, str) else "",
        projection=_projection(found.get("projection"), part),
    )


def _plain(values: Floats | Ints) -> list[Any]:
    if np.isfinite(values).all():
        return list(values.tolist())
    as_objects = values.astype(object)
    as_objects[~np.isfinite(values)] = None
    return list(as_objects.tolist())


def _field(found: dict[str, Any], name: str, kind: type, where: str) -> Any:
    value = found.get(name)
    if not isinstance(value, kind):
        raise MeshReadError(f"{where}: {name!r} is {_shown(value)}, not a {kind.__name__}; {REMEDY}")
    return value


def _floats(value: Any, where: str, n_dimensions: int = 0) -> Floats:
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise MeshReadError(f"{where}: is no table of numbers; {REMEDY}") from None
    if array.ndim == 0 or (n_dimensions and array.ndim != n_dimensions):
        raise MeshReadError(f"{where}: has {array.ndim} dimensions; {REMEDY}")
    return array


def _ints(value: Any, where: str, n_dimensions: int, n: int) -> Ints:
    array = _floats(value, where, n_dimensions)
    if not ((array >= 0) & (array < n) & (array == np.rint(array))).all():
        raise MeshReadError(f"{where}: names a point outside 0 .. {n - 1}; {REMEDY}")
    return array.astype(np.int64)


def _data(found: dict[str, Any], n: int, where: str) -> dict[str, Floats]:
    result: dict[str, Any] = {}
    for name, value in found.items():
        values = _floats(value, f"{where}.{name}")
        if len(values) != n:
            raise MeshReadError(f"{where}.{name}: has {len(values)} rows, not {n}; {REMEDY}")
        is_whole = all(isinstance(v, int) for v in value)
        result[name] = np.asarray(values.astype(np.int64) if is_whole else values)
    return result


def _names(given: Any, part: str) -> dict[int, str]:
    try:
        return {int(number): str(name) for number, name in given.items()}
    except (AttributeError, TypeError, ValueError):
        raise MeshReadError(f"{part}: 'cell_names' are no names by number; {REMEDY}") from None


def _boundary(found: Any, n: int, where: str) -> Boundary:
    if not isinstance(found, dict) or found.get("kind") not in ("open", "land", "named"):
        raise MeshReadError(f"{where}: is no boundary; {REMEDY}")
    code, name = found.get("code"), found.get("name")
    if not isinstance(code, int | None) or not isinstance(name, str):
        raise MeshReadError(f"{where}: code {_shown(code)} or name {_shown(name)} is wrong; {REMEDY}")
    nodes = _ints(found.get("nodes"), f"{where}.nodes", 1, n)
    partners = None if found.get("partners") is None else _ints(found["partners"], f"{where}.partners", 1, n)
    columns = None if found.get("columns") is None else _floats(found["columns"], f"{where}.columns", 2)
    given = found.get("edges")
    edges = None if given is None else _ints(given, f"{where}.edges", 2, n)
    lengths = {len(part) for part in (nodes, partners, columns) if part is not None}
    if len(lengths) > 1 or (edges is not None and edges.shape[1:] != (2,)):
        raise MeshReadError(f"{where}: its lists differ in length; {REMEDY}")
    return Boundary(found["kind"], nodes, code, name, partners, columns, edges)


def _projection(found: Any, part: str) -> Projection | None:
    if found is None:
        return None
    values = [
        found.get(key) if isinstance(found, dict) else None for key in ("longitude", "latitude", "west")
    ]
    if not all(isinstance(v, int | float) and abs(v) <= 360 for v in values):
        raise MeshReadError(f"{part}: 'projection' needs longitude, latitude and west; {REMEDY}")
    return Projection(*(float(v) for v in values if v is not None))


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
