"""What the paper prints and what is correct, digit by digit: typed once, compared with everywhere.

[Zint & Grosso], On the Link between Mesh Size Adaptation and Irregular Vertices. A cell holds what the paper
prints; in brackets stands the number that independent reckoning gives, with its own digits, where the paper
prints none or another one; empty brackets where there is nothing to compare ours with (another mesh, another
remesher). A cell of one dash is empty. Cells are apart by two spaces or more.
"""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Printed:
    """One number, as text: its digits say how exact it is."""

    paper: str | None
    """As in the paper; None where it prints none."""
    correct: str | None
    """What ours is compared with; None where there is nothing to compare."""


TABLES: dict[str, str] = {
    "table_1": """
        valence  q            angle  edge ratio
        3        0.60         30     1.73
        4        0.87         45     1.41
        5        0.97         54     1.18
        6        1.00         60     1.00
        7        0.98         51     1.15
        8        0.94 [0.95]  45     1.31
        9        0.90         40     1.46
        10       0.85         36     1.62
        11       0.81         33     1.77
        12       0.76         30     1.93
        15       0.65         24     2.40
        20       0.51         18     3.20
        25       0.42         14     3.99
    """,
    "figure_1": """
        mesh             iota  iota+  iota-
        a, unit square   -6    0      -6
        b, refined       -6    0      -6
        c, edge flipped  -6    1      -7
    """,
    "figure_2": """
        pattern  triangles  iota+  iota-  top left  top right
        2:1      3          1      -1     -1        1
        3:1      4          2      -2     -         -
        3:2      5          1      -1     -         -
        4:1      5          3      -3     -         -
        4:2      6          2      -2     -         -
        4:3      7          1      -1     -         -
    """,
    "figure_3": """
        strip  best q    at width
        1:1    [0.8660]  [1.0000]
        2:1    [0.8660]  [0.5000]
        3:1    [0.5000]  [0.5774]
        4:1    [0.5000]  [0.4330]
        3:2    [0.8660]  [0.3333]
        4:3    [0.8660]  [0.2500]
        5:3    [0.7206]  [0.2404]
        7:4    [0.7559]  [0.1637]
        7:5    [0.7777]  [0.1591]
        7:1    [0.2402]  [0.5151]
    """,
    "figure_4": """
        pattern  triangles  per front              iota+  iota-
        4:1      [5]        -3, +3                 3      -3
        4:3:2:1  [15]       -1, 0, 0, +1           1      -1
        4:3:1    [11]       [-1, -1, +2]           [2]    [-2]
        4:2:1    [9]        +2, -1, -1 [-2, +1, +1]  [2]  [-2]
    """,
    "figure_5": """
        pattern  0.25     0.5      0.75     1        1.5      2        3        best length
        4:1      [0.433]  [0.495]  [0.433]  [0.365]  [0.266]  [0.207]  [0.141]  [0.433]
        4:2:1    [0.371]  [0.670]  [0.866]  [0.831]  [0.693]  [0.569]  [0.408]  [0.75]
        4:3:1    [0.310]  [0.476]  [0.500]  [0.500]  [0.491]  [0.424]  [0.311]  -
        4:3:2:1  [0.300]  [0.560]  [0.756]  [0.858]  [0.822]  [0.725]  [0.553]  [1.083]
    """,
    "figure_6": """
        mesh                         triangles  q_min         q_mean
        a, isotropic remeshing       1512 []    0.39 []       0.98 []
        b, 40:39:..:10               1500       0.79 [0.790]  0.86 [0.860]
        b, fronts at best positions  [1500]     [0.803]       -
    """,
    "figure_7": """
        mesh                         triangles  q_min         q_mean
        a, isotropic remeshing       313 []     0.33 []       0.75 []
        b, 128:64:..:1               381        0.87 [0.866]  0.87 [0.867]
    """,
    "figure_8": """
        region  triangles  irregular vertices  q_min
        before  205 []     63 []               0.76 []
        after   189 []     8 []                0.75 []
    """,
    "figure_9": """
        region                paper
        fine end, elements    28 []
        coarse end, elements  4 []
        fronts                10 to 11
        triangles             297 []
        q_min                 0.75 []
        iota+                 40 []
    """,
    "table_2": """
        BSG                                 7:5:3:1      7:4:1        7:4:2:1
        blocks                              24           16           [20]
        triangles, 16 a block               384          256          [320]
        q under: positive, spread           0.98         [0.95]       -
        q under: positive, concentrated     [0.95]       0.90         -
        q under: both signs, spread         0.98 [0.97]  0.90 [0.95]  -
        iota+                               2            3            [3]
    """,
    "figure_10": """
        pattern  q_min at best length  q_min at length 0.7  vertices moved, length free
        7:5:3:1  [0.500]               -                    [>= 0.75]
        7:4:1    [0.500]               -                    [>= 0.70]
        7:4:2:1  [0.756]               [0.736]              [>= 0.86]
    """,
    "patterns": """
        pattern        blocks   per front         iota+  iota-  best q_min
        4:1            [5]      [-3, +3]          [3]    [-3]   [0.500]
        4:3:1          [11]     [-1, -1, +2]      [2]    [-2]   [0.500]
        4:2:1          [9]      [-2, +1, +1]      [2]    [-2]   [0.866]
        4:3:2:1        [15]     [-1, 0, 0, +1]    [1]    [-1]   -
        7:5:3:1        24       [-2, 0, 0, +2]    2      [-2]   [0.500]
        7:4:1          16       [-3, 0, +3]       3      [-3]   [0.500]
        7:2:1          14 [12]  [-5, +4, +1]      [5]    [-5]   [0.500]
        7:3:1          [14]     -                 -      -      [0.500]
        7:3:2:1        -        -                 -      -      [0.596]
        7:4:2:1        [20]     [-3, +1, +1, +1]  [3]    [-3]   [0.756]
        7:6:5:4:3:2:1  -        -                 -      -      [0.866]
        40:39:..:10    1500     [-1, 0 x 29, +1]  [1]    [-1]   -
        128:64:..:1    381      -                 -      -      -
    """,
    "equation_24": """
        estimate                            paper
        18578 triangles, 16 a block         1161
        a fourth of them refined once       32510 [32511.5]
        blocks then, 64 a block             510 [508]
    """,
    "words": """
        place                      paper
        irregularity >= 0, if      f(k-1) + f(k+1) <= 2 f(k) [f(k-1) + f(k+1) >= 2 f(k)]
        none inside, if linear     size [counts]
        a size function may be     a lower limit [an upper limit]
    """,
}
"""The tables by section: the first line holds the headings, the first column names the rows."""

REASONS: dict[tuple[str, str, str], str] = {
    ("table_1", "8", "q"): "Table 1: sqrt(3) sin(45) / (2 - cos(45)) is 0.9473.",
    ("figure_4", "4:2:1", "per front"): "Sec. 2.2, prose: signs the other way round; Eq. 16 gives these.",
    ("patterns", "7:2:1", "blocks"): "Sec. 4: Eq. 15 gives 7 + 1 + 2 x 2; it is 7:3:1 that has 14.",
    ("table_2", "q under: both signs, spread", "7:5:3:1"): (
        "Table 2 counts positive irregularity only, here spread over the front (valence 7). Where a front "
        "loses elements it forces a vertex of valence 5: no transition exceeds 0.974."
    ),
    ("table_2", "q under: both signs, spread", "7:4:1"): (
        "Table 2 counts positive irregularity only, here all on one vertex (valence 9); spread over the two "
        "vertices of the last front it is valence 8."
    ),
    ("equation_24", "a fourth of them refined once", "paper"): "Sec. 4: 18578 x 1.75.",
    ("equation_24", "blocks then, 64 a block", "paper"): "Sec. 4: 32511.5 / 64.",
    ("words", "irregularity >= 0, if", "paper"): (
        "Eq. 19, and the conditions of Eq. 22 and 23: by Eq. 16, tried on all triples of fronts up to 9."
    ),
    ("words", "none inside, if linear", "paper"): (
        "Sec. 2.2 and conclusions: counts linear in the front, so log h linear in x for isotropic triangles; "
        "counts that halve per front are h linear in x, and irregular on every front."
    ),
    ("words", "a size function may be", "paper"): (
        "Sec. 4, by its own words: elements might be smaller but not larger than the value given. A matter "
        "of words, nothing to compute."
    ),
}
"""Why the correct number is not the paper's, by section, row and column."""


def printed(section: str) -> dict[tuple[str, str], Printed]:
    """Return the printed numbers of a section by row and column, in reading order.

    >>> printed("table_1")["8", "q"]
    Printed(paper='0.94', correct='0.95')
    """
    head, *rows = _lines(section)
    return {
        (row[0], column): _cell(text)
        for row in rows
        for column, text in zip(head[1:], row[1:], strict=True)
        if text != "-"
    }


def row_heading(section: str) -> str:
    """Return what the rows of a section are.

    >>> row_heading("table_1")
    'valence'
    """
    return _lines(section)[0][0]


def _lines(section: str) -> list[list[str]]:
    return [re.split(r"\s{2,}", line.strip()) for line in TABLES[section].strip().splitlines()]


def _cell(text: str) -> Printed:
    paper, bracket, correct = text.removesuffix("]").partition("[")
    return Printed(paper.strip() or None, (correct or None) if bracket else paper)
