"""The noun ReplacedMesh: a mesh file before and after a replacement, and every way to show or write it."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .atomic import replacing
from .io import MeshFile
from .remesh import Replacement
from .report import Table
from .result import dumps


@dataclass(frozen=True, eq=False)
class ReplacedMesh:
    """A mesh file and what came of it."""

    before: MeshFile
    """The mesh as it was read."""
    replacement: Replacement = field(repr=False)
    """What was replaced."""
    after: MeshFile
    """The mesh with its data and boundaries as it is now."""

    def tables(self) -> list[Table]:
        """Return the tables: in total, by regions, by parts."""
        from .report import replace_tables

        return replace_tables.tables(self.replacement)

    def document(self) -> dict[str, Any]:
        """Return the JSON document `bsgplan.replace/1`."""
        from .report import replace_tables

        return replace_tables.document(self.before.description(), self.replacement)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the document to a JSON file, whole or not at all; raises OutputError."""
        with replacing(path) as temporary:
            temporary.write_text(dumps(self.document()), encoding="utf-8")

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the mesh with its data and boundaries, in the format of the suffix, whole or not at all."""
        from .io.write import write

        write(self.after, path)

    def figure(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Return the matplotlib Figure of before and after, written to path if given."""
        from .report.figure import save_figure
        from .report.replace_figure import replace_figure

        name = "/".join(Path(self.before.path).parts[-2:])
        drawn = replace_figure(self.replacement, projection=self.before.projection, name=name)
        if path is not None:
            save_figure(drawn, path)
        return drawn
