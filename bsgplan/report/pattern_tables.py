"""Tables of one pattern, made from its document."""

from __future__ import annotations

from typing import Any

from .pattern_document import MOST_MOVED
from .table import Column, Table, Value

LONGEST = 44
"""Characters of a pattern shown in a row; the rest is in the JSON document."""


def pattern_tables(document: dict[str, Any]) -> list[Table]:
    """Return the tables of one pattern: its numbers, its fronts, its quality over lengths."""
    return [_numbers(document), _fronts(document), _qualities(document)]


def shortened(words: str) -> str:
    """Return a pattern cut to LONGEST characters, its end kept.

    >>> shortened(":".join(["128"] * 20))[-10:]
    '8:..28:128'
    """
    if len(words) <= LONGEST:
        return words
    return f"{words[: LONGEST - 8]}..{words[-6:]}"


def _numbers(document: dict[str, Any]) -> Table:
    limits = document["bounds"]
    kind = "closed rings" if document["is_closed"] else "open fronts"
    rows: tuple[tuple[Value, ...], ...] = (
        ("blocks", str(document["n_blocks"]), "Eq. 15"),
        (
            "triangles",
            str(document["n_triangles"]),
            f"{document['refine']} refinements, {document['tris_per_block']} a block",
        ),
        ("iota+ / iota-", _signs(document["irregularity"]), "sums over fronts, Eq. 20 and 21"),
        ("of vertices", _signs(document["irregularity_of_vertices"]), "counted on the triangulation"),
        ("q_bound", f"{limits['q_bound']:.3f}", "both signs, spread over their fronts"),
        ("positive_spread", f"{limits['positive_spread']:.3f}", "positive only, spread"),
        ("positive_concentrated", f"{limits['positive_concentrated']:.3f}", "positive only, on one vertex"),
        ("smallest angle under", f"{limits['angle']:.1f}", "degrees, both signs"),
        ("edge ratio over", f"{limits['edge_ratio']:.3f}", "both signs"),
    )
    title = f"Pattern {shortened(document['pattern'])}, {kind}"
    return Table(title, (Column(""), Column("value"), Column("what")), rows)


def _fronts(document: dict[str, Any]) -> Table:
    columns = (Column("front"), Column("elements"), Column("Eq. 16"), Column("vertices +"), Column("-"))
    rows: list[tuple[Value, ...]] = [
        (k, f["count"], f"{f['irregularity']:+d}", f"{f['positive']:+d}", f"{f['negative']:+d}")
        for k, f in enumerate(document["fronts"], 1)
    ]
    note = "Eq. 16 is the sum over a front; single vertices may carry both signs."
    return Table("Irregularity per front, relative to the unit square", columns, tuple(rows), (note,))


def _qualities(document: dict[str, Any]) -> Table:
    columns = (
        Column(""),
        Column("length", "heights", ".3f"),
        Column("q_min", "", ".3f"),
        Column("q_mean", "", ".3f"),
        Column("moved, walls fixed", "", ".3f"),
        Column("walls sliding", "", ".3f"),
        Column("length free", "", ".3f"),
        Column("then", "heights", ".3f"),
    )
    keys = (
        "length",
        "q_min",
        "q_mean",
        "moved_walls_fixed",
        "moved_walls_sliding",
        "moved_length_free",
        "free_length",
    )
    places = (("best length", document["best"]), ("asked", document["asked"]))
    rows = tuple((name, *(at[key] for key in keys)) for name, at in places if at is not None)
    best = document["best"]
    notes = [f"Straight fronts are as good from {best['shortest']:.3f} to {best['longest']:.3f} heights."]
    if best["moved_walls_fixed"] is None:
        notes.append(f"Vertices are moved on open fronts, up to {MOST_MOVED} blocks.")
    return Table(
        "Quality: straight fronts at their best positions, then vertices moved", columns, rows, tuple(notes)
    )


def _signs(value: dict[str, int]) -> str:
    return f"{value['positive']:+d} / {value['negative']:+d}"
