"""The warning of stretched triangles: at layers, not at slivers."""

from __future__ import annotations

import logging

import numpy as np
import pytest
from conftest import SHARED
from hypothesis import given
from hypothesis import strategies as st
from reference import stretch
from strategies import jittered

from bsgplan.cli import main
from bsgplan.io import read
from bsgplan.io.file import RawMesh, assemble
from bsgplan.io.isotropy import MANY, QUALITY, STRETCHED, warn_of_stretched
from bsgplan.mesh.quality import corner_edge_lengths, mean_ratio, signed_areas

ISOTROPIC = (
    "north_sea.msh", "la.1.node", "wnat_test_18578.fort.14", "helmholtz_apartment.vtk",
    "square_triquad.mesh", "multizone_cht_3cyl_ffd.su2", "mesh_NACA0012_inv.su2",
)  # fmt: skip
EQUILATERAL = np.array([[0, 0], [1, 0], [0.5, np.sqrt(0.75)]])


def test_the_quality_that_is_warned_of_is_that_of_the_stretch():
    assert stretch(np.array([QUALITY]))[0] == pytest.approx(STRETCHED, rel=1e-12)


@given(ratio=st.floats(1, 1e4), turn=st.floats(0, 6), after=st.floats(0, 6), scale=st.floats(1e-3, 1e3))
def test_stretch_is_the_ratio_of_the_singular_values(ratio, turn, after, scale):
    def rotation(angle):
        return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])

    map_ = rotation(after) @ np.diag([scale * ratio, scale]) @ rotation(turn)
    points, triangle = EQUILATERAL @ map_.T, np.array([[0, 1, 2]])
    q = mean_ratio(np.abs(signed_areas(points, triangle)), corner_edge_lengths(points, triangle))
    assert stretch(q)[0] == pytest.approx(ratio, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(("share", "is_warned"), [(MANY - 0.005, False), (MANY + 0.005, True)])
def test_a_layer_is_told_from_its_share_on(caplog, share, is_warned):
    """A strip of a grid of squares flattened tenfold."""
    n = 200
    mesh = jittered(n + 1, 21, 1, jitter=0.0)
    x, y = mesh.points.T
    n_flat = round(share * n)
    points = np.column_stack(
        [np.where(x < n_flat, x / (2 * STRETCHED), x - n_flat * (1 - 0.5 / STRETCHED)), y]
    )
    raw = RawMesh(points, mesh.triangles, np.empty((0, 4), dtype=np.int64))
    with caplog.at_level(logging.WARNING, "bsgplan"):
        warn_of_stretched(assemble("layer", "made", raw))
    assert bool(caplog.records) == is_warned
    if is_warned:
        assert "of 8000 triangles are stretched over 5 times" in caplog.text


@pytest.mark.parametrize("name", ISOTROPIC)
def test_real_meshes_of_generators_are_not_warned_of(meshes, name, caplog):
    with caplog.at_level(logging.WARNING, "bsgplan"):
        warn_of_stretched(read(meshes / name, split_quads=True))
    assert not caplog.records


@pytest.mark.skipif(not (SHARED / "meshes").is_dir(), reason="no real meshes")
def test_estimate_warns_of_split_boundary_layers_and_not_of_the_part_outside(capsys, tmp_path):
    """The inner loop of the triangles is the edge of the layer of quads."""
    path = SHARED / "meshes" / "mesh_RAE2822_turb.su2"
    assert main(["estimate", str(path), "--split-quads"]) == 0
    assert "20 % of 27642 triangles are stretched over 5 times" in capsys.readouterr().err
    assert main(["estimate", str(path), "--split-quads", "--region", "2,-5,12,5"]) == 0
    assert "stretched" not in capsys.readouterr().err
