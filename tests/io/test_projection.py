"""Degrees to the plane: conformal, true lengths after the scale, the date line, and back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pyproj import Geod

from bsgplan.errors import InvalidMesh
from bsgplan.io import looks_like_degrees, project, read, read_lonlat, write
from bsgplan.io.projection import Projection


def grid_fort14(tmp_path, longitudes, latitudes):
    """Write a grid of triangles in degrees, counter-clockwise on the globe."""
    n = len(longitudes)
    lines = ["grid", f"{2 * (n - 1) * (len(latitudes) - 1)} {n * len(latitudes)}"]
    points = [(x, y) for y in latitudes for x in longitudes]
    lines += [f"{i} {x} {y} 1" for i, (x, y) in enumerate(points, 1)]
    corners = [r * n + c + 1 for r in range(len(latitudes) - 1) for c in range(n - 1)]
    triangles = [t for a in corners for t in ((a, a + 1, a + n + 1), (a, a + n + 1, a + n))]
    lines += [f"{i} 3 {a} {b} {c}" for i, (a, b, c) in enumerate(triangles, 1)]
    path = tmp_path / "grid.14"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_lengths_are_true_after_the_scale(tmp_path):
    """Against geodesics on the ellipsoid, within a thousandth, over a domain of ten degrees."""
    path = grid_fort14(tmp_path, np.arange(-80, -69.0), np.arange(20, 31.0))
    degrees, plane = read(path), read_lonlat(path)
    edges = plane.mesh.topology.edges
    a, b = degrees.mesh.points[edges].swapaxes(0, 1)
    true = Geod(ellps="WGS84").inv(a[:, 0], a[:, 1], b[:, 0], b[:, 1])[2]
    scale = plane.projection.scale(plane.mesh.points)[edges].mean(axis=1)
    assert plane.mesh.edge_lengths / scale == pytest.approx(true, rel=1e-3)
    assert np.ptp(scale) > 1e-3  # it does vary


def test_the_map_keeps_angles():
    here = np.array([[-60.0, 35.0]])
    step = 1e-5
    projection = Projection(-75.0, 25.0)
    east = projection.to_plane(np.add(here, [step, 0])) - projection.to_plane(here)
    north = projection.to_plane(np.add(here, [0, step])) - projection.to_plane(here)
    cosine = (east @ north.T).item() / np.linalg.norm(east) / np.linalg.norm(north)
    assert abs(cosine) < 1e-4


def test_there_and_back(tmp_path):
    path = grid_fort14(tmp_path, np.linspace(200, 230, 5), np.linspace(-60, -40, 5))
    plane = read_lonlat(path)
    assert plane.projection.to_degrees(plane.mesh.points) == pytest.approx(read(path).mesh.points, abs=1e-9)


def test_a_domain_torn_by_the_date_line_is_whole_in_the_plane(tmp_path):
    longitudes = [176.0, 178.0, -180.0, -178.0, -176.0]
    path = grid_fort14(tmp_path, longitudes, [50.0, 52.0, 54.0])
    plane = read_lonlat(path)
    assert abs(abs(plane.projection.longitude) - 180) < 1e-6
    assert plane.mesh.bounds[1] - plane.mesh.bounds[0] < 700e3
    assert plane.notes == ()  # nothing turned
    back = plane.projection.to_degrees(plane.mesh.points)
    difference = (back[:, 0] - np.tile(longitudes, 3) + 180) % 360 - 180
    assert difference == pytest.approx(np.zeros(15), abs=1e-9)
    assert (np.abs(back[:, 0]) <= 180).all()


def test_project_does_what_read_lonlat_does(tmp_path):
    path = grid_fort14(tmp_path, [1.0, 2.0, 3.0], [4.0, 5.0])
    assert np.array_equal(project(read(path)).mesh.points, read_lonlat(path).mesh.points)
    assert project(read_lonlat(path)).mesh.n_points == 6


@pytest.mark.parametrize(
    ("longitudes", "latitudes", "message"),
    [([0.0, 400.0], [0.0, 1.0], "longitude 400"), ([0.0, 1.0], [0.0, 91.0], "latitude 91")],
)
def test_what_is_no_degree_is_named(tmp_path, longitudes, latitudes, message):
    with pytest.raises(InvalidMesh, match=message):
        read_lonlat(grid_fort14(tmp_path, longitudes, latitudes))


def test_degrees_are_recognised_by_their_box(meshes):
    assert looks_like_degrees(read(meshes / "wnat_test_18578.fort.14"))
    assert not looks_like_degrees(read_lonlat(meshes / "wnat_test_18578.fort.14"))
    assert not looks_like_degrees(read(meshes / "bahamas_bight_of_abaco.fort.14"))
    assert not looks_like_degrees(read(meshes / "mesh_NACA0012_inv.su2"))


@pytest.mark.parametrize("name", ["a.2dm", "a.vtu", "a.slf", "a.nc"])
def test_degrees_of_the_sea_are_recognised_in_every_format(tmp_path, name):
    """Not only in a fort.14; no alarm for what is drawn from the origin on, nor without a depth."""
    sea = read(grid_fort14(tmp_path, np.arange(117, 127.0), np.arange(33, 41.0)))
    depth = {"depth": sea.mesh.points[:, 0]}
    write(replace(sea, point_data=depth), tmp_path / name)
    assert looks_like_degrees(read(tmp_path / name))
    drawn = read(grid_fort14(tmp_path, np.arange(2.0), np.arange(2.0)))
    write(replace(drawn, point_data={"depth": drawn.mesh.points[:, 0]}), tmp_path / name)
    assert not looks_like_degrees(read(tmp_path / name))
    if name in ("a.2dm", "a.vtu"):
        write(replace(sea, point_data={"depth": np.zeros(sea.mesh.n_points)}), tmp_path / name)
        assert not looks_like_degrees(read(tmp_path / name))


def test_the_real_sea_in_2dm_is_recognised(meshes):
    """And, of all the other real meshes, neither the wing nor the apartment nor the bone."""
    assert looks_like_degrees(read(meshes / "bohai_yellow_sea_BYS_20814.2dm"))
    for name in ("helmholtz_apartment.vtk", "osteonT1_11.mesh", "la.1.ele", "notched_plate_phasefield.msh"):
        assert not looks_like_degrees(read(meshes / name))
