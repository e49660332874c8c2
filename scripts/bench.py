"""Measure what bsgplan costs, as ratios within one run; exit code 1 where a demand is not met.

    python scripts/bench.py                    # every section
    python scripts/bench.py planning start     # some: one module each in scripts/benchmarks/
    python scripts/bench.py --write            # and store the tables for docs/performance.md
    python scripts/bench.py layout --only islands,columbia --seeds 1

BLAS runs on one thread, so CPU seconds are those of one core.
"""

from __future__ import annotations

import argparse
import importlib
import inspect
import os
import pkgutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
STORED = HERE.parent / "docs" / "performance"
HELPERS = (
    "cost",
    "gmsh_mesh",
    "layout_cases",
    "layout_outcome",
    "layout_run",
    "meshes",
    "rival",
    "row",
    "stored",
)
"""Modules of scripts/benchmarks that are no section."""


def sections() -> list[str]:
    """Return the names of the sections."""
    names = [module.name for module in pkgutil.iter_modules([str(HERE / "benchmarks")])]
    return [name for name in names if name not in HELPERS]


def measure(name: str, options: argparse.Namespace) -> bool:
    """Print a section row by row, store it if asked; return whether its demands are met."""
    from benchmarks.row import Row
    from benchmarks.stored import merged, stored

    from bsgplan.report.table import Column, Table, text

    section = importlib.import_module(f"benchmarks.{name}")
    known = inspect.signature(section.rows).parameters
    given = {key: value for key, value in vars(options).items() if key in known and value is not None}
    print(f"{section.TITLE}")
    rows: list[Row] = []
    for row in section.rows(**given):
        beside = f"[{row.beside}]" if row.beside else ""
        words = (f"  {row.what}:", f"{row.value:.4g}", row.unit, beside, row.verdict)
        print(" ".join(word for word in words if word), flush=True)
        rows.append(row)
    if options.write:
        STORED.mkdir(parents=True, exist_ok=True)
        heads = ["measured on one core", "value", "unit", "beside", "demand"]
        cells = [(r.what, r.value, r.unit, r.beside, r.verdict) for r in rows]
        if not any(r.beside for r in rows):
            heads.remove("beside")
            cells = [(*cell[:3], cell[4]) for cell in cells]
        if options.only:  # the other cases stay as they were
            cells = merged(stored(STORED / f"{name}.txt"), cells)
        table = Table(section.TITLE, tuple(map(Column, heads)), tuple(cells))
        (STORED / f"{name}.txt").write_text(text(table) + "\n")
    return all(row.holds for row in rows)


def main() -> int:
    """Measure the sections asked for."""
    parser = argparse.ArgumentParser(description="Measure what bsgplan costs, as ratios within one run.")
    parser.add_argument("section", nargs="*", help=", ".join(sections()))
    parser.add_argument("--write", action="store_true", help="store the tables in docs/performance/")
    parser.add_argument("--only", help="cases whose names start with one of these words, with commas")
    parser.add_argument("--seeds", type=int, help="layouts of each case, whose medians count")
    parser.add_argument("--effort", type=int, help="sweeps of each layout")
    options = parser.parse_args()
    unknown = set(options.section) - set(sections())
    if unknown:
        parser.error(f"no section {', '.join(sorted(unknown))}; the sections are {', '.join(sections())}")
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"  # before numpy is loaded
    os.environ["PYTHONPATH"] = os.pathsep.join([str(HERE.parent), os.environ.get("PYTHONPATH", "")])
    sys.path.insert(0, str(HERE.parent))
    met = [measure(name, options) for name in options.section or sections()]
    return 0 if all(met) else 1


if __name__ == "__main__":
    raise SystemExit(main())
