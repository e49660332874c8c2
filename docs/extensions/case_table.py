"""The directive `case-table`: every case of cases/ with what it shows, read from its case.toml."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

CASES = Path(__file__).parents[2] / "cases"


class CaseTable(SphinxDirective):
    """Put a section of plain facts for each case."""

    def run(self) -> list[nodes.Node]:
        """Return a definition list, one entry a case."""
        entries = nodes.definition_list()
        for path in sorted(CASES.glob("*/case.toml")):
            self.env.note_dependency(str(path))
            entries += entry(path.parent.name, tomllib.loads(path.read_text()))
        return [entries]


def entry(name: str, case: dict[str, Any]) -> nodes.definition_list_item:
    """Return the name, what the case shows, how it was made and how large it is."""
    mesh = case["mesh"]
    size = f"{mesh['n_triangles']} triangles, {mesh['n_points']} points, least quality {mesh['q_min']:.2f}."
    lines = [f"{case['title']}. {case['shows']}", f"Made by {case['made_by']}", size]
    term = nodes.term("", "", nodes.literal(text=name))
    return nodes.definition_list_item(
        "", term, nodes.definition("", *(nodes.paragraph(text=x) for x in lines))
    )


def setup(app: Any) -> dict[str, bool]:
    """Tell Sphinx about the directive."""
    app.add_directive("case-table", CaseTable)
    return {"parallel_read_safe": True}
