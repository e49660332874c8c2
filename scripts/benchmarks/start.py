"""What every call pays: the help, and the plan of a small mesh, all in."""

from __future__ import annotations

from collections.abc import Iterator

from .cost import cost_of
from .meshes import CASES
from .row import Row, least

TITLE = "Start"


def rows() -> Iterator[Row]:
    """Measure whole processes: imports, reading, planning, printing."""
    yield Row("bsgplan --help", least(lambda: cost_of(["--help"]).cpu), "s CPU", below=0.3)
    for name in ("square", "annulus"):
        words = ["estimate", str(CASES / name / "mesh.msh")]
        n = "2 036" if name == "square" else "2 532"
        yield Row(
            f"bsgplan estimate cases/{name}, {n} triangles",
            least(lambda words=words: cost_of(words).cpu),
            "s CPU",
            below=1.5,
        )
