"""One pattern and the best patterns of a transition, as plain documents and as tables made from them.

Lengths are in heights (circumferences of rings): the fronts have length 1. Rings run around a cylinder, their
edges are chords.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import InvalidOption
from ..mesh import Mesh
from ..patterns import (
    Found,
    Pattern,
    Realised,
    Shape,
    best_length,
    best_spacing,
    bounds,
    move_vertices,
    realise,
    vertex_irregularity_of_fronts,
)
from .table import Column, Table, Value

PATTERN_SCHEMA = "bsgplan.pattern/1"
PATTERNS_SCHEMA = "bsgplan.patterns/1"

MOST_TRIANGLES = 2_000_000
"""Triangles of a pattern after refinement, at most: what a figure or a file can show."""
MOST_MOVED = 2000
"""Blocks of a pattern whose vertices are moved, at most: a few seconds."""
LONGEST = 44
"""Characters of a pattern shown in a row; the rest is in the JSON document."""


def straight_shape(pattern: Pattern, length: float) -> Shape:
    """Return the region of a straight pattern, fronts of length 1.

    >>> straight_shape(Pattern.parse("7:4:1"), 0.7).length
    0.7
    """
    return Shape(np.array([0.0, length]), np.ones(2), pattern.is_closed)


def check_pattern(pattern: Pattern, length: float | None, refine: int) -> None:
    """Raise InvalidOption for a length or a number of refinements out of range, or too many triangles."""
    if length is not None and not 0 < length < float("inf"):
        raise InvalidOption(f"length {length:g} is not above 0; give it in heights, for example 0.7")
    if not 0 <= refine <= 10:
        raise InvalidOption(f"{refine} refinements is not from 0 to 10; give for example 2")
    n_triangles = pattern.n_blocks * 4**refine
    if n_triangles > MOST_TRIANGLES:
        raise InvalidOption(f"pattern has {n_triangles} triangles, the most is {MOST_TRIANGLES}; refine less")


def pattern_document(pattern: Pattern, *, length: float | None = None, refine: int = 2) -> dict[str, Any]:
    """Return the document `bsgplan.pattern/1`; what stands for a number that does not apply is None.

    Raises InvalidOption as `check_pattern`.
    """
    check_pattern(pattern, length, refine)
    best, limits, total = best_length(pattern), bounds(pattern), pattern.irregularity
    shape = straight_shape(pattern, best.length)
    realised = realise(pattern, shape, best_spacing(pattern, shape).positions)
    counted = vertex_irregularity_of_fronts(realised)
    return {
        "schema": PATTERN_SCHEMA,
        "pattern": str(pattern),
        "counts": list(pattern.counts),
        "is_closed": pattern.is_closed,
        "n_blocks": pattern.n_blocks,
        "refine": refine,
        "tris_per_block": 4**refine,
        "n_triangles": pattern.n_blocks * 4**refine,
        "irregularity": {"positive": total.positive, "negative": total.negative},
        "irregularity_of_vertices": {
            "positive": sum(front.positive for front in counted),
            "negative": sum(front.negative for front in counted),
        },
        "fronts": [
            {"count": n, "irregularity": i, "positive": c.positive, "negative": c.negative}
            for n, i, c in zip(pattern.counts, pattern.front_irregularity, counted, strict=True)
        ],
        "bounds": {
            "q_bound": limits.q_bound,
            "positive_spread": limits.positive_spread,
            "positive_concentrated": limits.positive_concentrated,
            "angle": float(np.degrees(limits.angle_bound)),
            "edge_ratio": limits.edge_ratio_bound,
        },
        "best": {
            **_at_length(pattern, best.length),
            "shortest": best.shortest,
            "longest": best.longest,
        },
        "asked": None if length is None else _at_length(pattern, length),
    }


def moved_pattern(realised: Realised, *, slides: bool = True, stretches: bool = False) -> Realised | None:
    """Return a straight pattern with its vertices moved; None for rings and for very many blocks."""
    if realised.is_closed or len(realised.triangles) > MOST_MOVED:
        return None
    return move_vertices(realised, slides=slides, stretches=stretches)


def pattern_tables(document: dict[str, Any]) -> list[Table]:
    """Return the tables of one pattern: its numbers, its fronts, its quality over lengths."""
    return [_numbers(document), _fronts(document), _qualities(document)]


def patterns_document(
    found: Sequence[Found],
    *,
    asked: str,
    length: float | None,
    layers: float | None = None,
    tris_per_block: int = 1,
) -> dict[str, Any]:
    """Return the document `bsgplan.patterns/1`: the Pareto front, best quality first."""
    return {
        "schema": PATTERNS_SCHEMA,
        "asked": asked,
        "fine": found[0].pattern.counts[0],
        "coarse": found[0].pattern.counts[-1],
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
            _shortened(p["pattern"]),
            p["n_blocks"],
            *((p["n_triangles"],) if is_refined else ()),
            p["positive"],
            p["q_min"],
            p["q_bound"],
            p["length"],
        )
        for p in shown
    )
    notes = ["No pattern is better in one of blocks, iota+ and q_min without being worse in another."]
    if len(shown) < len(every):
        notes.append(f"{len(shown)} of {len(every)}: close ones are left out; --most shows more, --json all.")
    return Table(title, columns, rows, tuple(notes))


def _at_length(pattern: Pattern, length: float) -> dict[str, Any]:
    shape = straight_shape(pattern, length)
    spacing = best_spacing(pattern, shape)
    realised = realise(pattern, shape, spacing.positions)
    mesh = Mesh(realised.points, realised.triangles)
    fixed, sliding = (moved_pattern(realised, slides=slides) for slides in (False, True))
    free = moved_pattern(realised, stretches=True)
    return {
        "length": length,
        "positions": spacing.positions.tolist(),
        "q_min": spacing.q_min,
        "q_mean": float(mesh.qualities.mean()),
        "moved_walls_fixed": _worst(fixed),
        "moved_walls_sliding": _worst(sliding),
        "moved_length_free": _worst(free),
        "free_length": None if free is None else float(np.ptp(free.points[:, 0])),
    }


def _worst(realised: Realised | None) -> float | None:
    if realised is None:
        return None
    qualities: Floats = Mesh(realised.points, realised.triangles).qualities
    return float(qualities.min())


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
    title = f"Pattern {_shortened(document['pattern'])}, {kind}"
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


def _spread(patterns: list[dict[str, Any]], most: int) -> list[dict[str, Any]]:
    """Return at most so many: one goes where another is about as good in all three, ever more loosely."""
    share, kept = 0.0, patterns
    while len(kept) > most:
        share = share + 0.005 if share < 0.1 else share * 1.2
        kept = []
        for p in sorted(patterns, key=lambda p: (p["n_blocks"], p["positive"], -p["q_min"])):
            if not any(
                o["n_blocks"] <= p["n_blocks"] * (1 + 2 * share)
                and o["positive"] <= p["positive"] * (1 + 2 * share)
                and o["q_min"] >= p["q_min"] - share
                for o in kept
            ):
                kept.append(p)
    return sorted(kept, key=lambda p: -p["q_min"])


def _signs(value: dict[str, int]) -> str:
    return f"{value['positive']:+d} / {value['negative']:+d}"


def _shortened(words: str) -> str:
    if len(words) <= LONGEST:
        return words
    return f"{words[: LONGEST - 8]}..{words[-6:]}"
