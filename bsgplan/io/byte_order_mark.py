"""The mark that editors of Windows put before a text, of no meaning in a mesh."""

from __future__ import annotations

from typing import BinaryIO

MARK = b"\xef\xbb\xbf"


def skip_mark(stream: BinaryIO) -> bool:
    """Return whether a stream begins with the mark, and leave it after the mark."""
    has_mark = stream.read(len(MARK)) == MARK
    if not has_mark:
        stream.seek(0)
    return has_mark
