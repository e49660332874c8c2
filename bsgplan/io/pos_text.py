"""The text of a Gmsh post-processing file a buffer at a time: without comments, by views, at whole elements.

A buffer ends anywhere: comments, names and elements that go on are carried over to the next, at most
`LONGEST` bytes of them, so that no file takes more memory than a few buffers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..errors import MeshReadError

LONGEST = 2**20
"""Bytes of one element, or of a name: none of a scalar view has as many."""
TOKEN = re.compile(rb'((?:"[^"\n]*+")++)|//[^\n]*(?=\n)|/\*.*?\*/|("[^"\n]*|//[^\n]*|/\*.*|/)\Z', re.DOTALL)
"""Texts in quotes, a whole comment, or what goes on in the next buffer."""
STRING = re.compile(rb'(?:"[^"\n]*+")++')
HEADER = re.compile(rb'View\s*("[^"\n]*")\s*\{')
BETWEEN = b" \t\r\n;}"
"""What may stand between elements: the closing bracket is that of the view."""


class Part(NamedTuple):
    """Whole elements of one view."""

    view: int
    """Number of the view in the file, from 0."""
    name: str
    text: bytes
    """The elements; texts in quotes are blotted out, their brackets are none."""


def parts(pieces: Iterable[bytes]) -> Iterator[Part]:
    """Give the elements of every view in parts, one or more a view; what stands before the first is dropped.

    Raises MeshReadError where a comment does not end or an element is too long to be one.
    """
    view, name, rest, is_end = -1, "", b"", False
    texts = uncommented(pieces)
    while not is_end:
        piece = next(texts, None)
        is_end = piece is None
        text = rest + (piece or b"")
        blotted = STRING.sub(_blot, text) if b'"' in text else text
        start, stop = 0, len(text) if is_end else blotted.rfind(b"}") + 1
        for header in HEADER.finditer(text) if b'"' in text else ():
            if view >= 0:
                yield Part(view, name, blotted[start : header.start()])
            view, name, start = view + 1, header[1][1:-1].decode("utf-8", "replace"), header.end()
        stop = max(start, stop)
        if view >= 0:
            yield Part(view, name, blotted[start:stop])
        rest = text[stop:].lstrip(BETWEEN)
        if len(rest) > LONGEST:
            raise MeshReadError(
                f"{shown(rest)} and {LONGEST} bytes more without a closing bracket; repair it"
            )


def uncommented(pieces: Iterable[bytes]) -> Iterator[bytes]:
    r"""Give a text with a blank for each comment, // and /* */; texts in quotes stay whole, in one piece.

    >>> b"".join(uncommented([b"1 /", b"* 2 *", b"/ 3 // 4", b" 5", b"\n6"]))
    b'1   3  \n6'
    """
    end, rest = b"", b""
    for piece in pieces:
        text, rest = rest + piece, b""
        if end:
            stop = text.find(end)
            if stop < 0:
                rest = text[-1:] if end == b"*/" else b""
                continue
            text, end = text[stop:].removeprefix(b"*/"), b""
        if b"/" in text or b'"' in text:
            text, end, rest = _without_comments(text)
        yield text
    if not end:
        text, end, _ = _without_comments(rest + b"\n")  # no name goes on behind the end of a line
        yield text[:-1]
    if end == b"*/":
        raise MeshReadError("a comment /* that does not end; repair the file")


def shown(text: bytes) -> str:
    """Return the beginning of a text for a message, quoted."""
    return repr(text.strip(BETWEEN)[:60].decode("utf-8", "replace"))


def _without_comments(text: bytes) -> tuple[bytes, bytes, bytes]:
    """Return a text without comments, the end of one that goes on, and what must be seen again with more."""
    going_on = b""

    def replaced(found: re.Match[bytes]) -> bytes:
        nonlocal going_on
        if found[2] is None:
            return found[1] or b" "
        going_on = found[2]
        return b" " if going_on[:2] in (b"//", b"/*") else b""

    text = TOKEN.sub(replaced, text)
    if going_on[:2] == b"//":
        return text, b"\n", b""
    if going_on[:2] == b"/*":
        return text, b"*/", going_on[2:][-1:]
    if len(going_on) > LONGEST:
        raise MeshReadError(f"{shown(going_on)} and {LONGEST} bytes more without a closing quote; repair it")
    return text, b"", going_on


def _blot(found: re.Match[bytes]) -> bytes:
    return b'"' + b"." * (len(found[0]) - 2) + b'"'
