"""Make what the documentation shows: docs/examples/, docs/paper.md, docs/pictures/, from the program.

    python scripts/make_docs.py            # everything
    python scripts/make_docs.py --text     # the examples only, pictures stay as they are

tests/docs runs the same commands and compares, so an example cannot go stale unnoticed. Run from anywhere:
paths in the commands are those of the repository.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import re
import shlex
import shutil
import tempfile
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
EXAMPLES = DOCS / "examples"
PICTURES = DOCS / "pictures"

COLORS = 128
"""Colours of a picture: with a palette that covers rare colours too, a file is a quarter as large."""

REFINEMENTS = 5
"""Rounds of k-means by which the palette is improved."""

WIDEST = 1600
"""Pixels across a picture at most: twice the column of a page."""

LARGEST_PICTURE = 250_000
"""Bytes of a picture at most."""


def case(name: str) -> str:
    """Return the path of a case's mesh in the repository."""
    return f"cases/{name}/mesh.msh"


def region_of(name: str) -> str:
    """Return the polygon that a case records for --region."""
    region: str = tomllib.loads((ROOT / "cases" / name / "case.toml").read_text())["region"]
    return region


TEXTS: dict[str, tuple[str, ...]] = {
    "info.txt": ("info", case("rectangle")),
    "formats.txt": ("info", "--formats"),
    "square.txt": ("estimate", case("square")),
    "rectangle.txt": ("estimate", case("rectangle"), "--tris-per-block", "16"),
    "region.txt": ("estimate", case("rectangle"), "--region", region_of("rectangle")),
    "annulus.txt": ("estimate", case("annulus")),
    "objective.txt": ("estimate", case("rectangle"), "--objective", "irregularity"),
    "sizes.txt": ("estimate", case("shoreline"), "--tris-per-block", "4,16,64,256"),
    "blocks.txt": ("estimate", case("islands"), "--blocks", "500"),
    "too-few-blocks.txt": ("estimate", case("shoreline"), "--blocks", "5"),
    "no-square.txt": ("estimate", case("square"), "--tris-per-block", "20"),
    "no-array.txt": ("estimate", case("plate"), "--size", "depth"),
    "uncovered.txt": ("estimate", case("rectangle"), "--size-file", case("square")),
    "replace.txt": ("replace", case("transition"), "--region", region_of("transition")),
    "size.txt": ("estimate", case("plate"), "--size", "size"),
}
"""File in docs/examples/ and the command whose output it holds."""

DOCUMENTS: dict[str, tuple[str, ...]] = {
    "info.json": ("info", case("rectangle"), "--json"),
    "estimate.json": ("estimate", case("rectangle"), "--region", region_of("rectangle"), "--json"),
}
"""The same for JSON documents, one of each schema."""

CASES = ("shoreline", "islands", "aerofoil", "plate", "rectangle", "annulus", "square")
"""Cases with a picture in docs/pictures/."""

LAYOUTS = DOCS / "layout"
"""What docs/layout.md shows of `bsgplan layout`: a table over the cases, one document."""

LAYOUT_DOCUMENT = ("layout", case("plate"), "--effort", "5", "--ranks", "8", "--json")
"""The command of docs/layout/plate.json: few sweeps, so that a test can run it again."""

PAPER = tuple(f"figure_{n}" for n in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10))
"""Pictures of `bsgplan paper` that docs/paper.md shows."""

DRAWN = (*CASES, "layout_shoreline", *(f"paper_{name}" for name in PAPER))
"""Pictures in docs/pictures/ that are made here."""


def run(words: tuple[str, ...]) -> tuple[int, str, str]:
    """Run a command in this process; return exit code, standard output and standard error."""
    from bsgplan.cli import main

    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(ROOT), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(list(words))
    return code, out.getvalue(), err.getvalue()


def transcript(words: tuple[str, ...]) -> str:
    """Return a command as typed, what it says, and its exit code where that is not 0."""
    code, out, err = run(words)
    tail = f"exit code {code}\n" if code else ""
    return f"$ {shlex.join(('bsgplan', *words))}\n{out}{err}{tail}"


def document(words: tuple[str, ...]) -> str:
    """Return the JSON document that a command prints."""
    code, out, err = run(words)
    if code or err:
        raise SystemExit(f"{shlex.join(words)}: exit code {code}: {err}")
    return out


def draw(name: str) -> int:
    """Draw the plan of a case as the command line does, with a palette; return the bytes written."""
    path = PICTURES / f"{name}.png"
    code, _, err = run(("estimate", case(name), "--figure", str(path)))
    if code:
        raise SystemExit(f"{name}: exit code {code}: {err}")
    return shrink(path)


def layouts(*, draws: bool) -> None:
    """Write docs/layout/: each case laid out, beside its estimate; its picture where draws."""
    LAYOUTS.mkdir(exist_ok=True)
    (LAYOUTS / "plate.json").write_text(document(LAYOUT_DOCUMENT))
    lines = ["| case | " + " | ".join(LAYOUT_COLUMNS) + " |", "|---|" + "---|" * len(LAYOUT_COLUMNS)]
    for name in CASES:
        figure = ("--figure", str(PICTURES / f"layout_{name}.png")) if name == "shoreline" and draws else ()
        found = json.loads(document(("layout", case(name), "--json", *figure)))
        estimated = json.loads(document(("estimate", case(name), "--json")))["totals"]
        lines.append(f"| {name} | " + " | ".join(layout_row(found, estimated)) + " |")
        print(lines[-1])
    (LAYOUTS / "cases.md").write_text("\n".join(lines) + "\n")
    if draws:
        print(f"layout_shoreline.png  {shrink(PICTURES / 'layout_shoreline.png')} bytes")


LAYOUT_COLUMNS = (
    "blocks: by patterns",
    "boundary-limited",
    "laid out",
    "`q_min`: estimate",
    "straight blocks",
    "grid",
    "input",
    "`iota+` `iota-`: estimate",
    "laid out",
    "input",
    "irregular inside: input",
    "laid out",
)
"""Heads of the table of cases."""


def layout_row(found: dict[str, Any], estimated: dict[str, Any]) -> list[str]:
    """Return the cells of one case from its documents of layout and estimate."""

    def iota(part: str) -> str:
        return "{positive:+d} {negative:+d}".format(**found[part]["irregularity"])

    def quality(part: str) -> str:
        value = found[part]["q_min"]
        return "-" if value is None else f"{value:.2f}"

    return [
        str(found["estimate"]["n_blocks"]),
        f"{estimated['blocks_boundary_limited']:.0f}",
        str(found["layout"]["n_blocks"]),
        *(quality(part) for part in ("estimate", "layout", "grid", "input")),
        *(iota(part) for part in ("estimate", "layout", "input")),
        str(found["input"]["irregular_interior"]),
        str(found["layout"]["irregular_interior"]),
    ]


def paper(*, draws: bool) -> None:
    """Write docs/paper.md from the report of `bsgplan paper`, with its pictures; mmg (extra) is wanted."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report"
        code, _, err = run(("paper", "--out", str(report)))
        if code:
            raise SystemExit(f"paper: exit code {code}: {err}")
        page = (report / "report.md").read_text()
        (ROOT / "docs" / "paper.md").write_text(re.sub(r"\]\((\w+\.png)\)", r"](pictures/paper_\1)", page))
        for name in PAPER if draws else ():
            picture = PICTURES / f"paper_{name}.png"
            shutil.copyfile(report / f"{name}.png", picture)
            print(f"{picture.name}  {shrink(picture)} bytes")


def shrink(path: Path) -> int:
    """Give a picture a palette and at most the width of a page; return the bytes written."""
    from PIL import Image

    with Image.open(path) as picture:
        colored = picture.convert("RGB")
    colored.thumbnail((WIDEST, 2 * WIDEST), Image.Resampling.LANCZOS)
    colored.quantize(
        COLORS, method=Image.Quantize.MAXCOVERAGE, kmeans=REFINEMENTS, dither=Image.Dither.NONE
    ).save(path, optimize=True)
    if path.stat().st_size > LARGEST_PICTURE:
        raise SystemExit(f"{path}: {path.stat().st_size} bytes, more than {LARGEST_PICTURE}; draw less")
    return path.stat().st_size


def main() -> None:
    """Write every example, and every picture unless told otherwise."""
    parser = argparse.ArgumentParser(description="Make the examples and pictures of the documentation.")
    parser.add_argument("--text", action="store_true", help="leave the pictures alone")
    options = parser.parse_args()
    os.environ["NO_COLOR"] = "1"
    for folder in (EXAMPLES, PICTURES):
        folder.mkdir(parents=True, exist_ok=True)
    for name, words in TEXTS.items():
        (EXAMPLES / name).write_text(transcript(words))
        print(name)
    for name, words in DOCUMENTS.items():
        (EXAMPLES / name).write_text(document(words))
        print(name)
    layouts(draws=not options.text)
    paper(draws=not options.text)
    print("paper.md")
    for name in () if options.text else CASES:
        print(f"{name}.png  {draw(name)} bytes")


if __name__ == "__main__":
    main()
