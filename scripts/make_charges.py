"""Draw and tabulate for the documentation how irregular vertices follow the curvature of the size field.

From tests/data/discs.npz (scripts/make_discs.py): docs/theory/charges.txt, the charge that the theory wants
inside two radii beside the irregularity that the generator made and the budget that bsgplan reads off the
mesh; docs/theory/charges.png, one mesh of each field with its irregular vertices red (+) and blue (-).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from bsgplan.mesh import Mesh, clean
from bsgplan.report.table import Column, Table, text
from bsgplan.sizing import size_field
from bsgplan.sizing.charge import edge_fluxes

ROOT = Path(__file__).resolve().parent.parent
RADII = (0.4, 0.6)
N_MESHES = 4
FIELDS = {
    "constant": ("h = 1", lambda rho: 0.0 * rho),
    "exponential": ("h = exp(x)", lambda rho: 0.0 * rho),
    "cone": ("h = sqrt(r^2 + .25^2)", lambda rho: 2 * np.pi * rho**2 / (rho**2 + 0.25**2)),
    "bump": ("h = exp(-r^2)", lambda rho: -4 * np.pi * rho**2),
    "pit": (
        "h = 1 - .8 exp(-8 r^2)",
        lambda rho: 25.6 * np.pi * rho**2 * np.exp(-8 * rho**2) / (1 - 0.8 * np.exp(-8 * rho**2)),
    ),
}
"""Formula of each field, and the flux of grad(log h) out of the disc of radius rho."""


def main() -> None:
    """Write the table and the picture."""
    meshes = {name: load(name) for name in FIELDS}
    (ROOT / "docs" / "theory" / "charges.txt").write_text(text(table(meshes)) + "\n")
    picture(meshes).savefig(ROOT / "docs" / "theory" / "charges.png", dpi=70)


def load(name: str) -> list[Mesh]:
    """Return the meshes of one field."""
    with np.load(ROOT / "tests" / "data" / "discs.npz") as stored:
        pairs = [(stored[f"{name}_{k}_points"], stored[f"{name}_{k}_triangles"]) for k in range(N_MESHES)]
    return [clean(points, triangles).mesh for points, triangles in pairs]


def table(meshes: dict[str, list[Mesh]]) -> Table:
    """Return theory, generator and budget of every field and radius; each a mean over four meshes."""
    rows = []
    for name, (formula, flux) in FIELDS.items():
        for rho in RADII:
            around = rho + np.linspace(-0.03, 0.03, 7)
            counted = [np.mean([inside(mesh, r) for r in around]) for mesh in meshes[name]]
            read = [budget(mesh, rho) for mesh in meshes[name]]
            wanted = float(np.mean(-3 / np.pi * flux(around)))
            spread = float(np.std(counted) / np.sqrt(N_MESHES))
            rows.append((formula, rho, wanted, float(np.mean(counted)), spread, float(np.mean(read))))
    columns = (
        Column("size field"),
        Column("radius", "", ".1f"),
        Column("theory", "iota", "+.2f"),
        Column("in the mesh", "iota", "+.2f"),
        Column("+-", "", ".2f"),
        Column("budget", "iota", "+.2f"),
    )
    return Table("", columns, tuple(rows))


def inside(mesh: Mesh, rho: float) -> int:
    """Return the irregularity of the vertices of a mesh inside a radius."""
    return int(mesh.vertex_irregularity[np.hypot(*mesh.points.T) < rho].sum())


def budget(mesh: Mesh, rho: float) -> float:
    """Return the charge inside a radius that bsgplan reads off the mesh."""
    is_inside = np.hypot(*mesh.centroids.T) < rho
    return float(edge_fluxes(size_field(mesh)).sum(axis=1)[is_inside].sum())


def picture(meshes: dict[str, list[Mesh]]) -> Figure:
    """Draw the first mesh of each field, its irregular vertices red (+) and blue (-)."""
    drawn = Figure(figsize=(15, 3.6), layout="constrained")
    for k, (name, (formula, _)) in enumerate(FIELDS.items()):
        mesh, axes = meshes[name][0], drawn.add_subplot(1, len(FIELDS), k + 1)
        x, y = mesh.points.T
        log_h = np.log(size_field(mesh).triangle_h)
        middle, reach = np.median(log_h), max(1.0, np.ptp(log_h) / 2)
        limits = {"vmin": middle - reach, "vmax": middle + reach}
        axes.tripcolor(x, y, mesh.triangles, facecolors=log_h, cmap="Greys_r", alpha=0.5, **limits)
        values = np.where(mesh.topology.is_boundary, 0, mesh.vertex_irregularity)
        for sign, colour in ((1, "tab:red"), (-1, "tab:blue")):
            is_sign = sign * values > 0
            axes.scatter(x[is_sign], y[is_sign], s=4, color=colour, linewidths=0)
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.set_title(f"{formula}\ninside .6: {inside(mesh, 0.6):+d}", fontsize=10)
    return drawn


if __name__ == "__main__":
    main()
