"""Fixtures of the whole test tree."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from bsgplan.io import read

settings.register_profile(
    "house",
    deadline=None,
    derandomize=True,  # the suite says the same on every machine; hunt with --hypothesis-seed
    max_examples=60,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
settings.load_profile("house")

SHARED = Path(os.environ.get("BSGPLAN_SHARED", Path(__file__).parents[2] / "shared"))


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of real meshes, beside the checkout or where BSGPLAN_SHARED says; skips where absent."""
    if not (SHARED / "meshes").is_dir():
        pytest.skip(f"no real meshes in {SHARED}; set BSGPLAN_SHARED")
    return SHARED


@pytest.fixture(scope="session")
def meshes(shared: Path) -> Path:
    """The real meshes and MEASURED.tsv."""
    return shared / "meshes"


@pytest.fixture
def reading(tmp_path):
    """A function that takes a file name and gives one that writes a text or bytes there and reads it."""

    def at(name):
        def read_content(content):
            path = tmp_path / name
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
            return read(path)

        return read_content

    return at
