"""Files that appear whole or not at all, and what is said where there is no room for them."""

from __future__ import annotations

import errno
import os

import pytest

from bsgplan.atomic import replacing
from bsgplan.cli.errors import one_line
from bsgplan.errors import OutputError
from bsgplan.io import read, write


@pytest.mark.parametrize(
    ("code", "remedy"),
    [
        (errno.ENOSPC, "free space on its disk"),
        (errno.EDQUOT, "free space in your quota"),
        (errno.EFBIG, "raise the limit of file sizes"),
        (errno.EACCES, "check the folder"),
    ],
)
def test_no_room_is_told_as_such(tmp_path, code, remedy):
    """Not as a fault of the folder; the old file stays and nothing beside it."""
    path = tmp_path / "plan.json"
    path.write_text("old")
    with (
        pytest.raises(OutputError, match=rf"plan\.json: cannot be written \(.*\); {remedy}"),
        replacing(path),
    ):
        raise OSError(code, os.strerror(code))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("suffix", [".msh", ".vtu", ".off"])
def test_a_limit_of_file_sizes_is_told_by_every_writer(tmp_path, suffix):
    """Ours and those of meshio: a file of two kilobytes at most."""
    resource = pytest.importorskip("resource")
    mesh_file = read("cases/plate/mesh.msh")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    write(mesh_file, tmp_path / f"first{suffix}")  # imports done, before the limit
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, limits[1]))
    try:
        with pytest.raises(OutputError, match=r"File too large.*ulimit -f"):
            write(mesh_file, tmp_path / f"second{suffix}")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert [path.name for path in tmp_path.iterdir()] == [f"first{suffix}"]


def test_a_full_standard_output_is_told_as_such():
    """A result piped to a full disk."""
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    told = one_line(full)
    assert told.startswith("error: the output cannot be written (No space left on device); free space on")
