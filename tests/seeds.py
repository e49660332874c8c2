"""Small valid files of every format that bsgplan reads itself, and ways to damage them.

Looked up from the registry: a reader of ours without a seed is an error, so that no fuzz test forgets it.
"""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from hypothesis import strategies as st
from reference import selafin

from bsgplan.errors import BsgplanError
from bsgplan.io import Boundary, MeshFile
from bsgplan.io.formats import FORMATS, Format
from bsgplan.mesh import clean

OWN = tuple(found for found in FORMATS if found.reader and not found.reader.startswith("meshio."))
"""The formats with a reader of ours."""

BY_HAND: dict[str, list[str | bytes]] = {
    "su2": [
        """NZONE= 2\nIZONE= 1\nNDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3\n0 0 0\n1 0 1\n0 1 2
NMARK= 1\nMARKER_TAG= a\nMARKER_ELEMS= 1\n3 0 1
IZONE= 2\nNDIME= 2\nNPOIN= 3\n1 0\n2 0\n2 1\nNELEM= 1\n5 2 1 0\nNMARK= 0
""",
        """% space\nNDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1
NMARK= 1\nMARKER_TAG= b\nMARKER_ELEMS= 2\nSEND_RECV= 1\n5 0 2 1\n5 0 1 3
""",
    ],
    "mfem": [
        """MFEM mesh v1.0\n\n# comment\ndimension\n2\n\nelements\n2\n1 2 0 1 2\n2 2 0 2 3
boundary\n1\n1 1 0 1\n\nvertices\n4\n
nodes\nFiniteElementSpace\nFiniteElementCollection: H1_2D_P1\nVDim: 2\nOrdering: 1\n
0 0\n1 0\n1 1\n0 1
""",
    ],
    "fort.14": [
        """a weir\n2 4\n1 0 0 1\n2 1 0 1d0\n3 1 1 1 ! c\n4 0 1 1\n1 3 1 2 3\n2 3 1 3 4
0\n0\n1\n2\n1 24\n4 1 0.2 1 1
""",
    ],
    "gmsh1": [
        """$NOD\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n7 0 1 0\n$ENDNOD
$ELM\n4\n1 1 5 6 2 1 2\n2 2 1 1 3 1 2 3\n3 2 1 1 3 1 3 7\n9 15 1 1 1 7\n$ENDELM
""",
        """$NOD\n5\n1 0 0 0\n2 1 0 0\n7 1 1 0\n4 0 1 0\n6 2 1 0\n$ENDNOD\n$ELM\n5\n1 15 0 1 1 1
2 1 5 1 2 1 2\n4 2 8 1 3 1 2 7\n5 2 9 1 3 1 7 4\n6 3 0 1 4 2 6 7 4\n$ENDELM\n""",
    ],
    "2dm": [
        """MESH2D\nE6T 1 10 50 20 60 30 40 2\nE3T 2 10 30 40\nE2L 3 10 20 1\nND 10 0 0 -1.5\nND 40 0 1 4
ND 20 1 0 2\nND 30 1 1 3\nND 50 2 0 5\nND 60 2 1 6\nNS 10 20\nNS -30 3 "sea"\nMAT 2 "sand"
""",
    ],
    "jigsaw": [
        """# c\nMSHID=3;ELLIPSOID-MESH\nRADII=1;1;1\nNDIMS=2\nPOINT=4\n0;0;0\n.1;0;1\n.1;.1;0\n0;.1;0
VALUE=4;2\n1;2\n3;4\n5;6\n7;8\nEDGE2=1\n0;1;4\nBOUND=1\n0;1;2\nTRIA3=2\n0;1;2;0\n0;2;3;3\nTRIA4=0
""",
    ],
    "selafin": [selafin(order="<", date=True)],
}
"""Further files with what the writers do not write."""

WORDS = (b"", b"-1", b"0", b"1", b"3", b"2.5", b"nan", b"inf", b"1e300", b"1e999", b"x", b"1000000000000",
         b"99999999999999999999", b"-9223372036854775808", b"=", b'"', b"#", b"\xff", b"\0")  # fmt: skip
"""What a word of a text is replaced by."""
INTEGERS = tuple(n.to_bytes(4, order, signed=True) for n in (0, 1, -1, 3, 80, 2**31 - 1, -(2**31), 10**9)
                 for order in ("big", "little"))  # fmt: skip
"""What four bytes of a binary file are replaced by."""


@dataclass(frozen=True)
class Seed:
    """One valid mesh: its format, its files by name, and the one that is named to the reader."""

    format: Format
    files: dict[str, bytes]
    main: str

    def __repr__(self) -> str:
        return f"{self.format.name}:{self.main}"

    def written(self, folder: Path, damaged: str | None = None, content: bytes = b"") -> Path:
        """Write the files into a folder, one of them with other content; return the path to read."""
        for name, whole in self.files.items():
            (folder / name).write_bytes(content if name == damaged else whole)
        return folder / self.main


def small_mesh_file(*, has_quads: bool) -> MeshFile:
    """Return nine points, a few triangles, boundaries of every kind, data, and a quad if wanted."""
    x, y = (v.ravel() for v in np.meshgrid([0.0, 1.0, 2.5], [0.0, 1.25, 2.0]))
    cells = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [3, 4, 7], [3, 7, 6], [4, 5, 8]])
    mesh = clean(np.column_stack([x, y]), cells).mesh
    quads = np.array([[0, 1, 3, 2]]) if has_quads else np.empty((0, 4), dtype=np.int64)
    return MeshFile(
        path="seed",
        format="test",
        mesh=mesh,
        quads=quads,
        quad_points=np.array([[2.5, 0], [3.5, 0], [2.5, 1.25], [3.5, 1.25]])[: 4 * has_quads],
        quad_nodes=np.array([2, -1, 5, -1])[: 4 * has_quads],
        quad_point_data={"depth": np.arange(4.0)[: 4 * has_quads]},
        point_data={"depth": np.linspace(1, 2, 9)},
        cell_data={"attribute": np.arange(1.0, 8.0)},
        boundaries=(
            Boundary("open", [0, 1, 2]),
            Boundary("land", [2, 5, 8], 20),
            Boundary("named", [0, 3, 6], 3, "west"),
        ),
        title="a seed",
    )


def seeds() -> list[Seed]:
    """Return the seeds of all formats of ours: what their writers make of a small mesh, and those by hand."""
    found = []
    for own in OWN:
        suffix = own.suffixes[0] if own.suffixes else ".mesh"
        for has_quads in (False, True) if own.writer else ():
            with tempfile.TemporaryDirectory() as folder:
                try:
                    own.write(small_mesh_file(has_quads=has_quads), Path(folder) / f"seed{suffix}")
                except BsgplanError:
                    continue  # no place for quads
                files = {path.name: path.read_bytes() for path in Path(folder).iterdir()}
                found.append(Seed(own, files, f"seed{suffix}"))
        name = f"seed{suffix}"
        for by_hand in BY_HAND.get(own.name, ()):
            content = by_hand if isinstance(by_hand, bytes) else by_hand.encode()
            found.append(Seed(own, {name: content}, name))
    return found


def is_text(content: bytes) -> bool:
    """Return whether a file is text."""
    return b"\0" not in content


@st.composite
def damaged(draw: st.DrawFn, content: bytes) -> bytes:
    """A file with one to four damages: bytes, words, lines or integers changed, cut, doubled, swapped."""
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.sampled_from(["word", "word", "line", "byte", "cut", "double", "end"]))
        where = draw(st.integers(0, max(len(content) - 1, 0)))
        length = draw(st.integers(1, 12))
        if kind == "word" and is_text(content):
            words = list(re.finditer(rb"\S+", content))
            if words:
                word = words[where % len(words)]
                new = draw(st.sampled_from(WORDS) | st.integers(-20, 20).map(lambda n: str(n).encode()))
                content = content[: word.start()] + new + content[word.end() :]
        elif kind == "word":
            start = where - where % 4
            content = content[:start] + draw(st.sampled_from(INTEGERS)) + content[start + 4 :]
        elif kind == "line":
            lines = content.splitlines(keepends=True)
            a, b = where % max(len(lines), 1), draw(st.integers(0, max(len(lines) - 1, 0)))
            if lines:
                lines[a : a + draw(st.integers(0, 1))] = [lines[b]]
            content = b"".join(lines)
        elif kind == "byte":
            content = content[:where] + bytes([draw(st.integers(0, 255))]) + content[where + 1 :]
        elif kind == "cut":
            content = content[:where] + content[where + length :]
        elif kind == "double":
            content = content[:where] + content[where : where + length] * 2 + content[where + length :]
        else:
            content = content[:where]
    return content
