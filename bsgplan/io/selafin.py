"""Reader of TELEMAC Selafin (SERAFIN) files: single and double precision, big-endian or little-endian.

Grammar: Fortran records, each  length, bytes, length  with a length of 4 bytes; integers of 4 bytes, reals of
4 or, where the title ends in SERAFIND, of 8:

    title                             80 characters, the last 8 SERAFIN or SERAFIND
    n_variables n_clandestine         2 integers
    name                              32 characters for each variable: 16 of name, 16 of unit
    parameters                        10 integers: [2], [3] origin of x and y, [6] planes, [9] a date follows
    year month day hour minute second 6 integers, where parameters[9] is 1
    n_elements n_points n_corners 1   4 integers
    connectivity                      n_elements n_corners integers, points count from 1
    ipobo                             n_points integers: 0 inside, else the place in the numbered boundary
    x                                 n_points reals
    y                                 n_points reals
    time, values of each variable     for each frame: 1 real, then n_points reals a variable

Variables are point data, those of the last whole frame; `ipobo` is point data too. No package is needed.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..arrays import Floats, Ints
from ..errors import MeshReadError
from .cell_rows import check_corners
from .file import RawMesh

TITLE, NAME = 80, 32
"""Characters of the title and of a variable's name with its unit."""


class Records:
    """Fortran records of a binary file, whose lengths are believed only as far as the file goes."""

    def __init__(self, stream: BinaryIO) -> None:
        self.stream = stream
        self.size = stream.seek(0, 2)
        stream.seek(0)
        self.order = "<" if stream.read(4) == struct.pack("<i", TITLE) else ">"
        stream.seek(0)

    @property
    def n_left(self) -> int:
        """Bytes from here to the end of the file."""
        return self.size - self.stream.tell()

    def next(self, n_bytes: int, what: str) -> bytes:
        """Return the next record, which must have so many bytes."""
        start = self.stream.tell()
        (length,) = struct.unpack(self.order + "i", self._bytes(4, what))
        if length != n_bytes:
            raise MeshReadError(
                f"byte {start}: {what} has {n_bytes} bytes, the record there {length}; "
                "the file is damaged or no Selafin file, fetch it again"
            )
        content = self._bytes(n_bytes, what)
        if struct.unpack(self.order + "i", self._bytes(4, what)) != (length,):
            raise MeshReadError(f"byte {start}: the record of {what} has no end; fetch the file again")
        return content

    def integers(self, n: int, what: str) -> Ints:
        """Return the next record as n integers."""
        return np.frombuffer(self.next(4 * n, what), self.order + "i4").astype(np.int64)

    def reals(self, n: int, n_bytes: int, what: str) -> Floats:
        """Return the next record as n reals of 4 or 8 bytes."""
        return np.frombuffer(self.next(n_bytes * n, what), f"{self.order}f{n_bytes}").astype(np.float64)

    def _bytes(self, n: int, what: str) -> bytes:
        if n > self.n_left:
            raise MeshReadError(
                f"byte {self.stream.tell()}: {what} needs {n} bytes, the file ends after {self.n_left}; "
                "fetch the whole file"
            )
        return self.stream.read(n)


@dataclass(frozen=True)
class Header:
    """What a file says before its connectivity."""

    title: str
    names: tuple[str, ...]
    real_bytes: int
    origin: tuple[int, int]
    n_elements: int
    n_points: int


def read_selafin(path: Path) -> RawMesh:
    """Return the mesh of a two-dimensional Selafin file with the variables of its last frame."""
    with path.open("rb") as stream:
        records = Records(stream)
        header = _header(records)
        n_points, real_bytes = header.n_points, header.real_bytes
        corners = records.integers(3 * header.n_elements, "the connectivity").reshape(-1, 3)
        check_corners(corners - 1, n_points, "element")
        ipobo = records.integers(n_points, "the boundary numbers (ipobo)")
        x, y = (records.reals(n_points, real_bytes, f"coordinate {name}") for name in "xy")
        data = {"ipobo": ipobo.astype(np.float64)}
        frame_bytes = 8 + real_bytes + len(header.names) * (8 + n_points * real_bytes)
        n_frames, rest = divmod(records.n_left, frame_bytes)
        if n_frames:
            stream.seek((n_frames - 1) * frame_bytes, 1)
            records.reals(1, real_bytes, "the time of the last frame")
            data |= {name: records.reals(n_points, real_bytes, f"variable {name}") for name in header.names}
    return RawMesh(
        points=np.column_stack([x, y]) + np.array(header.origin, dtype=np.float64),
        triangles=corners - 1,
        quads=np.empty((0, 4), dtype=np.int64),
        point_data=data,
        notes=tuple(_notes(header, n_frames, rest)),
        title=header.title,
    )


def _header(records: Records) -> Header:
    title = records.next(TITLE, "the title").decode("latin-1")
    n_variables, n_clandestine = records.integers(2, "the number of variables").tolist()
    n_names = n_variables + n_clandestine
    if n_variables < 0 or n_clandestine < 0 or n_names * (NAME + 8) > records.n_left:
        raise MeshReadError(f"{n_names} variables do not fit into the file; fetch it again")
    texts = [records.next(NAME, "the name of a variable").decode("latin-1") for _ in range(n_names)]
    parameters = records.integers(10, "the parameters").tolist()
    if parameters[9] == 1:
        records.next(24, "the date")
    n_elements, n_points, n_corners, _ = records.integers(4, "the sizes of the mesh").tolist()
    if n_corners != 3 or parameters[6] > 1:
        raise MeshReadError(
            f"elements of {n_corners} nodes in {max(parameters[6], 1)} planes are no triangles; "
            "give the two-dimensional result"
        )
    if n_elements < 1 or n_points < 3:
        raise MeshReadError(f"{n_elements} elements and {n_points} points are no mesh; fetch the file again")
    real_bytes = 8 if title[72:].startswith("SERAFIND") else 4
    return Header(
        title=title[:72].strip(),
        names=tuple(_unique(text[:16].strip() for text in texts)),
        real_bytes=real_bytes,
        origin=(parameters[2], parameters[3]),
        n_elements=n_elements,
        n_points=n_points,
    )


def _unique(names: Iterator[str]) -> Iterator[str]:
    seen: set[str] = {"ipobo"}
    for name in names:
        number, found = 2, name
        while found in seen:
            found, number = f"{name} {number}", number + 1
        seen.add(found)
        yield found


def _notes(header: Header, n_frames: int, rest: int) -> Iterator[str]:
    if n_frames > 1:
        yield f"variables of the last of {n_frames} frames"
    if rest:
        yield f"{rest} bytes after the last whole frame left out"
    if any(header.origin):
        yield f"origin ({header.origin[0]}, {header.origin[1]}) added to the coordinates"
