"""Solve Poisson's equation by geometric multigrid on refined patterns: docs/practice/multigrid.txt and .png.

Blocks refined uniformly are the levels of a geometric multigrid: the pattern is the coarsest grid. Each
V-cycle has one forward sweep of Gauss-Seidel before and one backward sweep after the coarse correction; its
factor is the limit of the error's reduction in the energy norm. Needs scikit-fem (dependency group `test`).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.sparse import csc_array, csr_array, eye_array, tril, triu, vstack
from scipy.sparse.linalg import splu
from skfem import Basis, ElementTriP1, MeshTri
from skfem.models.poisson import laplace

from bsgplan.arrays import Floats
from bsgplan.patterns import Pattern, Realised, Shape, best_length, best_spacing, realise
from bsgplan.report.table import Column, Table, text

TARGET = Path(__file__).resolve().parent.parent / "docs" / "practice"
PATTERNS = ("7:1", "7:4:1", "7:5:3:1", "7:4:2:1", "7:6:4:2:1")
SHOWN = ("7:1", "7:4:1", "7:4:2:1", "7:6:4:2:1")
LENGTHS = (None, 0.7)
"""In heights, None for each pattern's best."""
REFINEMENTS = 5
"""1024 triangles a block."""
DRAWN = 2
CYCLES = 40
"""Cycles after which the reduction has settled."""
SEED = 7319
REDUCTION = 1e-8


@dataclass(frozen=True, eq=False)
class Level:
    """The equations of one grid, walls taken out, and how corrections come up to it."""

    matrix: csr_array
    forward: csc_array
    """Lower triangle with the diagonal: one sweep of Gauss-Seidel."""
    backward: csc_array
    prolongation: csr_array | None
    """From the grid below, None on the coarsest."""


def main() -> None:
    """Write the table and the picture."""
    TARGET.mkdir(exist_ok=True)
    (TARGET / "multigrid.txt").write_text(text(table(REFINEMENTS)) + "\n")
    picture().savefig(TARGET / "multigrid.png", dpi=70)


def table(n_refinements: int) -> Table:
    """Return quality, V-cycle factor and work of each pattern and length."""
    rows = []
    for length in LENGTHS:
        for name in PATTERNS:
            realised, q_min = straight(name, length)
            factor = v_cycle_factor(levels(realised, n_refinements))
            n_cycles, n_blocks = ceil(log(REDUCTION) / log(factor)), len(realised.triangles)
            wide = float(np.ptp(realised.points[:, 0]))
            rows.append((name, wide, n_blocks, q_min, factor, n_cycles, n_cycles * n_blocks))
    columns = (
        Column("pattern"),
        Column("length", "heights", ".3f"),
        Column("blocks"),
        Column("q_min", "", ".3f"),
        Column("V-cycle factor", "", ".2f"),
        Column(f"cycles to {REDUCTION:.0e}"),
        Column("cycles x blocks"),
    )
    return Table("", columns, tuple(rows))


def straight(name: str, length: float | None) -> tuple[Realised, float]:
    """Return a straight pattern, its fronts where they are best, and its smallest mean ratio."""
    pattern = Pattern.parse(name)
    shape = Shape.rectangle(best_length(pattern).length if length is None else length)
    spacing = best_spacing(pattern, shape)
    return realise(pattern, shape, spacing.positions), spacing.q_min


def levels(realised: Realised, n_refinements: int) -> list[Level]:
    """Return the equations on the pattern and on its refinements, coarsest first.

    Nodes of a refined mesh are the old ones, then the midpoints of edges: P = [I; 1/2 edge incidence].
    """
    mesh, found = MeshTri(realised.points.T, realised.triangles.T), []
    prolongation, below = None, np.zeros(0, dtype=np.int64)
    for k in range(n_refinements + 1):
        free = mesh.interior_nodes()
        stiffness = csr_array(laplace.assemble(Basis(mesh, ElementTriP1())))
        if len(free):
            matrix = stiffness[free][:, free]
            up = None if prolongation is None or not found else prolongation[free][:, below]
            found.append(Level(matrix, csc_array(tril(matrix)), csc_array(triu(matrix)), up))
        if k < n_refinements:
            n, (start, end) = mesh.nvertices, mesh.facets
            edge = np.arange(len(start))
            halves = np.full(2 * len(edge), 0.5), (np.tile(edge, 2), np.concatenate([start, end]))
            prolongation = csr_array(vstack([eye_array(n), csr_array(halves, shape=(len(edge), n))]))
            below, mesh = free, mesh.refined(1)
    return found


def v_cycle_factor(grids: list[Level]) -> float:
    """Return by how much a V-cycle reduces the error in the energy norm, after many."""
    exact = splu(csc_array(grids[0].matrix))
    order = {"permc_spec": "NATURAL", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    sweeps = [(splu(g.forward, **order).solve, splu(g.backward, **order).solve) for g in grids]

    def cycle(k: int, right: Floats) -> Floats:
        if k == 0:
            return np.asarray(exact.solve(right))
        grid, (forward, backward) = grids[k], sweeps[k]
        x = forward(right)
        x += grid.prolongation @ cycle(k - 1, grid.prolongation.T @ (right - grid.matrix @ x))
        return np.asarray(x + backward(right - grid.matrix @ x))

    matrix, top = grids[-1].matrix, len(grids) - 1
    error = np.random.default_rng(SEED).standard_normal(matrix.shape[0])
    for _ in range(CYCLES):
        error /= np.sqrt(error @ (matrix @ error))
        error = error - cycle(top, matrix @ error)
    return float(np.sqrt(error @ (matrix @ error)))


def picture() -> Figure:
    """Draw some patterns with their blocks refined, and the factor of all beside q_min."""
    drawn = Figure(figsize=(15, 4), layout="constrained")
    panels = drawn.subplots(1, len(SHOWN) + 1, width_ratios=[1] * len(SHOWN) + [1.5])
    marks: dict[str, tuple[float, float]] = {}
    for name in PATTERNS:
        realised, q_min = straight(name, LENGTHS[0])
        marks[name] = q_min, v_cycle_factor(levels(realised, REFINEMENTS))
    for axes, name in zip(panels[:-1], SHOWN, strict=True):
        realised, _ = straight(name, LENGTHS[0])
        fine = MeshTri(realised.points.T, realised.triangles.T).refined(DRAWN)
        axes.triplot(*fine.p, fine.t.T, color="0.6", linewidth=0.5)
        axes.triplot(*realised.points.T, realised.triangles, color="tab:blue", linewidth=1.4)
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.set_title(f"{name}\nq_min {marks[name][0]:.2f}, factor {marks[name][1]:.2f}")
    last = panels[-1]
    for k, (name, (q_min, factor)) in enumerate(marks.items()):
        last.plot(q_min, factor, "o", color="tab:blue")
        last.annotate(name, (q_min, factor), (6, -11 if k == 1 else 5), textcoords="offset points")
    last.set(xlabel="q_min", ylabel="V-cycle factor", xlim=(0.15, 1.15), ylim=(0, 1))
    last.grid(alpha=0.3)
    return drawn


if __name__ == "__main__":
    main()
