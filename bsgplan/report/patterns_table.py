"""The best patterns of a transition, as a plain document and as a table made from it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..patterns import Found, bounds, is_exact
from ..patterns.search import EXACT
from .pattern_tables import shortened
from .table import Column, Table

PATTERNS_SCHEMA = "bsgplan.patterns/1"


def patterns_document(
    found: Sequence[Found],
    *,
    asked: str,
    length: float | None,
    layers: float | None = None,
    tris_per_block: int = 1,
) -> dict[str, Any]:
    """Return the document `bsgplan.patterns/1`: the Pareto front, best quality first."""
    ends = found[0].pattern.counts[0], found[0].pattern.counts[-1]
    return {
        "schema": PATTERNS_SCHEMA,
        "asked": asked,
        "fine": ends[0],
        "coarse": ends[1],
        "is_exact": is_exact(*ends),
        "is_closed": found[0].pattern.is_closed,
        "length": length,
        "layers": layers,
        "tris_per_block": tris_per_block,
        "patterns": [
            {
                "pattern": str(f.pattern),
                "counts": list(f.pattern.counts),
                "n_blocks": f.n_blocks,
                "n_triangles": f.n_blocks * tris_per_block,
                "positive": f.positive,
                "q_min": f.q_min,
                "q_bound": bounds(f.pattern).q_bound,
                "length": f.length,
            }
            for f in found
        ],
    }


def patterns_table(document: dict[str, Any], *, most: int) -> Table:
    """Return the patterns of a transition, best quality first; at most so many, the closest ones left out."""
    every = document["patterns"]
    shown, is_refined = _spread(every, most), document["tris_per_block"] > 1
    length = document["length"]
    where = "each at its best length" if length is None else f"length {length:.3g} heights"
    title = f"Patterns from {document['fine']} to {document['coarse']}, {where}, best quality first"
    columns = (
        Column("pattern"),
        Column("blocks"),
        *((Column("triangles"),) if is_refined else ()),
        Column("iota+"),
        Column("q_min", "", ".3f"),
        Column("q_bound", "", ".3f"),
        Column("length", "heights", ".3f"),
    )
    rows = tuple(
        (
            shortened(p["pattern"]),
            p["n_blocks"],
            *((p["n_triangles"],) if is_refined else ()),
            p["positive"],
            p["q_min"],
            p["q_bound"],
            p["length"],
        )
        for p in shown
    )
    notes = ["None of these is better in one of blocks, iota+ and q_min without being worse in another."]
    if not document["is_exact"]:
        notes.append(
            f"Over {EXACT} elements on a front the search is pruned: others may be better; never worse than "
            "the arithmetic, the geometric and the halving sequences."
        )
    if len(shown) < len(every):
        notes.append(f"{len(shown)} of {len(every)}: close ones are left out; --most shows more, --json all.")
    return Table(title, columns, rows, tuple(notes))


def _spread(patterns: list[dict[str, Any]], most: int) -> list[dict[str, Any]]:
    """Return at most so many: the best one, and others that are not about as good in all three as another."""
    if len(patterns) <= most or most == 1:
        return patterns[:most]
    best, *others = patterns
    share, kept = 0.0, others
    while len(kept) > most - 1:  # ever more loosely
        share = share + 0.005 if share < 0.1 else share * 1.2
        kept = []
        for p in sorted(others, key=lambda p: (p["n_blocks"], p["positive"], -p["q_min"])):
            if not any(
                o["n_blocks"] <= p["n_blocks"] * (1 + 2 * share)
                and o["positive"] <= p["positive"] * (1 + 2 * share)
                and o["q_min"] >= p["q_min"] - share
                for o in kept
            ):
                kept.append(p)
    return [best, *sorted(kept, key=lambda p: -p["q_min"])]
