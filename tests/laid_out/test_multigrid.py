"""What a layout is for: geometric multigrid on the blocks, uniformly refined."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import csr_array, tril, triu
from scipy.sparse.linalg import LinearOperator, cg, spsolve, spsolve_triangular

from bsgplan.laid_out import LaidOut, export

skfem = pytest.importorskip("skfem")

TOLERANCE = 1e-8
LEVELS = 4


def prolongation(coarse: skfem.MeshTri, fine: skfem.MeshTri) -> csr_array:
    """Return the interpolation of linear functions from a mesh to its uniform refinement."""
    n, edges = coarse.nvertices, coarse.facets
    rows = np.concatenate([np.arange(n), np.repeat(n + np.arange(edges.shape[1]), 2)])
    columns = np.concatenate([np.arange(n), edges.T.ravel()])
    values = np.concatenate([np.ones(n), np.full(2 * edges.shape[1], 0.5)])
    result = csr_array((values, (rows, columns)), shape=(fine.nvertices, n))
    np.testing.assert_allclose(result @ coarse.p.T, fine.p.T, atol=1e-12)  # the numbering is as thought
    return result


def iterations(meshes: list[skfem.MeshTri]) -> tuple[int, int]:
    """Return the steps of conjugate gradients for Poisson on the last mesh, with multigrid and without.

    One V(1,1) cycle a step, Gauss-Seidel forth before and back after the correction of the coarser mesh.
    """
    from skfem.models.poisson import laplace, unit_load

    matrices, frees = [], []
    for mesh in meshes:
        basis = skfem.Basis(mesh, skfem.ElementTriP1())
        free = np.setdiff1d(np.arange(mesh.nvertices), mesh.boundary_nodes())
        matrices.append(csr_array(laplace.assemble(basis))[free][:, free])
        frees.append(free)
        load = unit_load.assemble(basis)[free]
    steps = [
        prolongation(meshes[k], meshes[k + 1])[frees[k + 1]][:, frees[k]] for k in range(len(meshes) - 1)
    ]

    def cycle(k: int, b: np.ndarray) -> np.ndarray:
        a = matrices[k]
        if k == 0:
            return spsolve(a.tocsc(), b)
        x = spsolve_triangular(tril(a).tocsr(), b, lower=True)
        x = x + steps[k - 1] @ cycle(k - 1, steps[k - 1].T @ (b - a @ x))
        return x + spsolve_triangular(triu(a).tocsr(), b - a @ x, lower=False)

    top, a = len(meshes) - 1, matrices[-1]
    counts = []
    for operator in (LinearOperator(a.shape, lambda b: cycle(top, b)), None):
        history: list[None] = []
        cg(a, load, rtol=TOLERANCE, M=operator, callback=lambda _, told=history: told.append(None))
        counts.append(len(history))
    return counts[0], counts[1]


def test_multigrid_does_not_feel_the_level(straight: LaidOut, tmp_path: Path) -> None:
    """To 1e-8 on two to five levels: bounded, at most one more at the last; plain ones nearly double a level.

    The first levels are too small to hold the slowest local modes of Gauss-Seidel: there it is quicker.
    """
    export(straight.blocks_file(), tmp_path / "b.msh", format="msh22")
    meshes = [skfem.MeshTri.load(tmp_path / "b.msh")]
    for _ in range(LEVELS):
        meshes.append(meshes[-1].refined())
    counts = np.array([iterations(meshes[: k + 1]) for k in range(1, LEVELS + 1)])
    multigrid, plain = counts.T
    assert multigrid.max() <= 13, counts
    assert multigrid[-1] - multigrid[-2] <= 1, counts
    assert (plain[1:] > 1.7 * plain[:-1]).all(), counts


def test_straight_grids_are_the_refined_blocks(straight: LaidOut) -> None:
    """Two refinements of the blocks have the very points of the straight grid at s = 4."""
    blocks, grid = straight.blocks_file().mesh, straight.grid_file().mesh
    refined = skfem.MeshTri(blocks.points.T.copy(), blocks.triangles.T.copy()).refined(2)
    digits = [np.round(p, 9) + 0.0 for p in (refined.p.T, grid.points)]
    assert {tuple(p) for p in digits[0].tolist()} == {tuple(p) for p in digits[1].tolist()}
