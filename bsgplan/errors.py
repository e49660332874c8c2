"""The errors that bsgplan raises: few, named, each also the built-in that a caller would catch."""

from __future__ import annotations


class BsgplanError(Exception):
    """Any error that bsgplan raises on purpose; its message is one line for the user."""


class MeshReadError(BsgplanError, OSError):
    """A file is missing, unreadable, not of a known format, or lacks what was asked of it."""


class InvalidMesh(BsgplanError, ValueError):  # noqa: N818 - names the thing, as the house does
    """The points and triangles are not a conforming triangle mesh."""


class InvalidSize(BsgplanError, ValueError):  # noqa: N818
    """A size field is not positive and finite, or does not belong to the mesh."""


class InvalidOption(BsgplanError, ValueError):  # noqa: N818
    """An option's value is wrong by itself, whatever the mesh (wrong usage)."""


class NoPatternFits(BsgplanError, ValueError):  # noqa: N818
    """The input is valid, but no plan meets the request."""


class LayoutRefused(BsgplanError, ValueError):  # noqa: N818
    """A layout or its grid does not verify, also after repair; nothing is written."""


class PaperIsOff(NoPatternFits):
    """A number of ours is not the one that it should be: `bsgplan paper` differs from the paper."""


class OutputError(BsgplanError, OSError):
    """An output cannot be written."""
