"""Files that appear whole or not at all: written under another name beside the target, then renamed."""

from __future__ import annotations

import contextlib
import errno
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .errors import OutputError

REMEDIES = {
    errno.ENOSPC: "free space on its disk, or write to another",
    errno.EDQUOT: "free space in your quota, or write elsewhere",
    errno.EFBIG: "raise the limit of file sizes (ulimit -f), or write to another disk",
}
"""What to do where there is no room for a file."""


def unwritten(error: OSError) -> str:
    """Return what an error of a write says, and the remedy.

    >>> unwritten(OSError(errno.ENOSPC, "No space left on device"))
    'cannot be written (No space left on device); free space on its disk, or write to another'
    """
    remedy = REMEDIES.get(error.errno or 0, "check the folder")
    return f"cannot be written ({error.strerror or error}); {remedy}"


@contextlib.contextmanager
def naming(target: str | os.PathLike[str]) -> Iterator[None]:
    """Turn an OSError of the block into an OutputError that names the target."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{os.fspath(target)}: {unwritten(error)}") from None


@contextlib.contextmanager
def replacing(target: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the path of an empty file beside the target, with its suffix; rename it when the block ends.

    On any error the new file is removed and the target stays as it was; an OSError becomes an OutputError
    that names the target.
    """
    path = Path(os.path.realpath(target))
    if path.exists() and not path.is_file():
        raise OutputError(f"{os.fspath(target)}: is no regular file; give the name of one")
    with naming(path):
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            umask = os.umask(0)
            os.umask(umask)
            temporary.chmod(0o666 & ~umask)
            temporary.replace(path)
        except BaseException:
            with contextlib.suppress(OSError):
                temporary.unlink()
            raise
