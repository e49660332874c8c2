"""The commands and `main`: parse, run, tell errors in one line, return the exit code."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
from collections.abc import Iterator

from cyclopts import App, CycloptsError, UnknownCommandError

from ..memory import reused
from .errors import DONE, WRONG_USAGE, WarningLines, tell

HELP = """Plan block-structured triangular grids: how many blocks, which patterns, what quality.

Results go to stdout, all else to stderr.

Exit codes: 0 done, 1 no plan meets the request, 2 wrong usage, 3 file missing, invalid or not \
writable, 70 a defect of bsgplan, 130 interrupted.

With --debug an error shows its traceback.
"""
COMMANDS = {
    "info": ("bsgplan.cli.info:info", "Show what is in a mesh."),
    "export": ("bsgplan.cli.export:export", "Write a saved layout for a solver."),
    "convert": ("bsgplan.cli.convert:convert", "Write a mesh in another format."),
    "estimate": ("bsgplan.cli.estimate:estimate", "Plan the blocks of a mesh."),
    "layout": ("bsgplan.cli.layout:layout", "Lay the whole mesh out in blocks and cut them into a grid."),
    "sweep": ("bsgplan.cli.sweep:sweep", "Plan many meshes at many block sizes into a CSV file."),
    "replace": ("bsgplan.cli.replace:replace", "Replace parts of a mesh, far fewer irregular vertices left."),
    "pattern": ("bsgplan.cli.pattern:pattern", "Show what a pattern is worth."),
    "patterns": ("bsgplan.cli.patterns:patterns", "Find the best patterns of a transition."),
    "paper": ("bsgplan.cli.paper:paper", "Reproduce every table and figure of the paper."),
}
"""Import path and help of each command; its module is imported when the command runs, not before."""


def main(argv: list[str] | None = None) -> int:
    """Run a command line, default that of the process, and return its exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    is_debug = "--debug" in words
    words = [word for word in words if word != "--debug"]
    with _warnings_on_stderr(), reused():
        try:
            app()(words, exit_on_error=False, print_error=False, result_action="return_none")
            sys.stdout.flush()
        except CycloptsError as error:
            print(f"error: {_usage_error(error)}", file=sys.stderr)  # noqa: T201
            return WRONG_USAGE
        except BrokenPipeError:  # the reader, `head` for one, has seen enough
            with contextlib.suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return DONE
        except (Exception, KeyboardInterrupt) as error:
            return tell(error, is_debug=is_debug)
    return DONE


def app() -> App:
    """Return the command-line application with every command registered by its import path."""
    result = App(name="bsgplan", help=HELP, version=_version, help_format="plaintext")
    result.suppress_keyboard_interrupt = False  # `main` tells it, as it tells every error
    for name, (import_path, help_line) in COMMANDS.items():
        result.command(import_path, name=name, help=help_line)
    return result


def _version() -> str:
    from importlib.metadata import version  # loads the email package

    return version("bsgplan")


def _usage_error(error: CycloptsError) -> str:
    if isinstance(error, UnknownCommandError):  # its own text would import every command
        return f"no command {(error.unused_tokens or ['?'])[0]!r}; the commands are {', '.join(COMMANDS)}"
    message = " ".join(str(error).split()).rstrip(".")
    return f"{message[:1].lower()}{message[1:]}; see bsgplan --help"


@contextlib.contextmanager
def _warnings_on_stderr() -> Iterator[None]:
    logger, handler = logging.getLogger("bsgplan"), WarningLines(logging.WARNING)
    was_propagating, logger.propagate = logger.propagate, False
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.propagate = was_propagating
