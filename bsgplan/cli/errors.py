"""Exit codes, and what the user sees of an error: one line on stderr, a traceback only with --debug."""

from __future__ import annotations

import logging
import sys
import traceback

from ..errors import (
    BsgplanError,
    InvalidMesh,
    InvalidOption,
    InvalidSize,
    LayoutRefused,
    MeshReadError,
    NoPatternFits,
    OutputError,
)

DONE = 0
NO_PLAN = 1
WRONG_USAGE = 2
BAD_INPUT = 3
INTERNAL_ERROR = 70
"""A defect of bsgplan itself (EX_SOFTWARE of sysexits.h)."""
INTERRUPTED = 130

EXIT_CODES: tuple[tuple[type[BaseException], int], ...] = (
    (KeyboardInterrupt, INTERRUPTED),
    (InvalidOption, WRONG_USAGE),
    (NoPatternFits, NO_PLAN),
    (LayoutRefused, NO_PLAN),
    (MeshReadError, BAD_INPUT),
    (InvalidMesh, BAD_INPUT),
    (InvalidSize, BAD_INPUT),
    (OutputError, BAD_INPUT),
    (OSError, BAD_INPUT),
)
"""The first class that fits gives the code; anything else is an internal error."""


def exit_code(error: BaseException) -> int:
    """Return the exit code of an error.

    >>> exit_code(InvalidOption("--tris-per-block 17"))
    2
    """
    return next((code for kind, code in EXIT_CODES if isinstance(error, kind)), INTERNAL_ERROR)


def tell(error: BaseException, *, is_debug: bool) -> int:
    """Write one line about an error to stderr, after its traceback with --debug; return its exit code."""
    code = exit_code(error)
    if is_debug:
        traceback.print_exception(error)
    print(one_line(error), file=sys.stderr)  # noqa: T201 - this is where the program speaks
    return code


def one_line(error: BaseException) -> str:
    """Return the line that a user reads.

    >>> one_line(NoPatternFits("no plan with 10 blocks"))
    'error: no plan with 10 blocks'
    """
    from ..atomic import REMEDIES, unwritten

    message = " ".join(str(error).split())
    if isinstance(error, KeyboardInterrupt):
        return "interrupted"
    if isinstance(error, OSError) and not isinstance(error, BsgplanError) and error.strerror:
        where = "" if error.filename is None else f"{error.filename}: "
        message = f"{where}{error.strerror}"
        if error.errno in REMEDIES:  # of standard output, say
            message = f"{where or 'the output '}{unwritten(error)}"
    if exit_code(error) != INTERNAL_ERROR:
        return f"error: {message}"
    return f"internal error: {type(error).__name__}: {message}; run again with --debug and report it"


class WarningLines(logging.Handler):
    """Writes each warning of the logger "bsgplan" to stderr as one line."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write one record."""
        message = " ".join(record.getMessage().split())
        print(f"{record.levelname.lower()}: {message}", file=sys.stderr)  # noqa: T201
