"""Variables of a netCDF file as arrays: classic files through scipy, netCDF-4 through the package netCDF4.

Sizes are checked against the file before anything is read: a few bytes may claim an array of any size.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import BsgplanError, MeshReadError

MOST_COMPRESSED = 1032
"""Bytes that one byte of deflate can stand for at most [Deutsch 1996, RFC 1951: 258 bytes in two bits]."""
ALWAYS_ALLOWED = 1 << 24
"""Bytes that an array may have in any case."""


@dataclass(frozen=True, eq=False)
class Variable:
    """One variable of a file: its dimensions, its attributes, and a way to its values."""

    name: str
    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    attributes: dict[str, Any]
    load: Callable[[Any], Any]
    """Function from an index to the values there, as they are stored."""

    def text(self, name: str) -> str:
        """Return an attribute as text, empty where it has none."""
        return _text(self.attributes.get(name, ""))

    def number(self, name: str, default: float) -> float:
        """Return an attribute as a number."""
        try:
            return float(np.ravel(self.attributes.get(name, default))[0])
        except (ValueError, TypeError, IndexError):
            return default

    def values(self, index: Any = slice(None)) -> Any:
        """Return the values at an index as a numeric array, as they are stored."""
        array = np.asarray(self.load(index))
        if array.dtype.kind not in "iufb":
            raise MeshReadError(f"variable {self.name} holds no numbers; repair the file")
        return array


@dataclass(frozen=True, eq=False)
class Contents:
    """The variables of an open file by name."""

    variables: dict[str, Variable]
    title: str
    """Its global attribute `title`, empty where it has none."""
    close: Callable[[], object]
    """Function that closes the file."""


def open_variables(path: Path) -> Contents:
    """Return the variables of a file, whose values are read when they are asked for."""
    with path.open("rb") as stream:
        signature = stream.read(4)
    try:
        if signature in (b"CDF\x01", b"CDF\x02"):
            return _classic(path)
        return _through_netcdf4(path)
    except (BsgplanError, OSError):
        raise
    except Exception as error:  # readers raise anything on a damaged file
        raise unreadable(error) from None


def _text(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def unreadable(error: Exception) -> MeshReadError:
    """Return the error of a damaged file."""
    reason = " ".join(str(error).split())[:100] or type(error).__name__
    return MeshReadError(f"not readable as netCDF ({reason}); fetch the file again")


class BoundedFile(io.FileIO):
    """A file that never makes room for more bytes than it has, whatever a header asks for."""

    def __init__(self, path: Path, size: int) -> None:
        super().__init__(path)
        self.size = size

    def read(self, n: int | None = -1, /) -> bytes | Any:
        """Return the next n bytes, or those that are left."""
        left = max(self.size - self.tell(), 0)
        return super().read(left if n is None or n < 0 else min(n, left))


def _classic(path: Path) -> Contents:
    from scipy.io import netcdf_file

    size = path.stat().st_size
    with warnings.catch_warnings(), BoundedFile(path, size) as stream:
        warnings.simplefilter("ignore")
        found = netcdf_file(stream, mmap=False)
    variables = {}
    for name, variable in found.variables.items():
        shape = tuple(int(n) for n in variable.shape)
        variables[name] = Variable(
            name,
            tuple(variable.dimensions),
            shape,
            dict(variable._attributes),
            _copying(variable),
        )
        _check_size(name, shape, variable.itemsize(), size)
    return Contents(variables, _text(getattr(found, "title", "")), found.close)


def _copying(variable: Any) -> Callable[[Any], Any]:
    return lambda index: variable[index].copy()


def _through_netcdf4(path: Path) -> Contents:
    try:
        import netCDF4
    except ModuleNotFoundError:
        raise MeshReadError(
            "this is netCDF-4 (or CDF-5), which needs the package netCDF4; pip install 'bsgplan[netcdf]', "
            "or make it classic with `nccopy -k classic`"
        ) from None
    size = path.stat().st_size
    try:
        found = netCDF4.Dataset(path)
    except OSError as error:
        raise unreadable(error) from None
    found.set_auto_maskandscale(False)
    variables = {}
    for name, variable in found.variables.items():
        if not isinstance(variable.dtype, np.dtype):
            continue
        _check_size(name, variable.shape, variable.dtype.itemsize, size)
        variables[name] = Variable(
            name,
            tuple(variable.dimensions),
            tuple(variable.shape),
            {key: variable.getncattr(key) for key in variable.ncattrs()},
            variable.__getitem__,
        )
    return Contents(variables, _text(getattr(found, "title", "")), found.close)


def _check_size(name: str, shape: tuple[int, ...], itemsize: int, file_size: int) -> None:
    n_bytes = itemsize
    for n in shape:
        n_bytes *= int(n)
    if n_bytes > max(file_size * MOST_COMPRESSED, ALWAYS_ALLOWED):
        raise MeshReadError(
            f"variable {name} claims {n_bytes} bytes in a file of {file_size}; fetch the file again"
        )
