"""UGRID netCDF: classic and netCDF-4, the spellings that models use, the twin of a real file."""

from __future__ import annotations

import sys

import meshio
import numpy as np
import pytest
from hypothesis import given
from predicates import assert_is_mesh_file
from scipy.io import netcdf_file
from strategies import meshes as random_meshes

from bsgplan.errors import MeshReadError
from bsgplan.io import Boundary, MeshFile, read
from bsgplan.io.ugrid_write import write_ugrid

X, Y = [0.0, 1.0, 1.0, 0.0, 2.0, 2.0], [0.0, 0.0, 1.0, 1.0, 0.0, 1.0]
FACES = [[0, 1, 2, -1], [0, 2, 3, -1], [1, 4, 5, 2]]


def write_small(path, *, start=0, says_start=True, fill=-99, transposed=False, swapped=False, **changes):
    """Write two triangles and a quad with data and a boundary as a model would; changes are attributes."""
    with netcdf_file(path, "w") as file:
        for name, size in (("node", 6), ("face", 3), ("corner", 4), ("edge", 2), ("two", 2), ("time", 2)):
            file.createDimension(name, size)
        topology = file.createVariable("grid", "i4", ())
        attributes = {
            "cf_role": "mesh_topology",
            "topology_dimension": np.int32(2),
            "node_coordinates": "lat lon" if swapped else "lon lat",
            "face_node_connectivity": "nv",
            "boundary_node_connectivity": "bnd",
        }
        if transposed:
            attributes["face_dimension"] = "face"
        for key, value in {**attributes, **changes}.items():
            setattr(topology, key, value)
        for name, values, standard in (("lon", X, "longitude"), ("lat", Y, "latitude")):
            variable = file.createVariable(name, "f8", ("node",))
            variable.standard_name = standard
            variable[:] = values
        faces = np.where(np.array(FACES) < 0, fill, np.array(FACES) + start)
        dimensions = ("corner", "face") if transposed else ("face", "corner")
        nv = file.createVariable("nv", "i4", dimensions)
        nv[:] = faces.T if transposed else faces
        nv._FillValue = np.int32(fill)
        bnd = file.createVariable("bnd", "i4", ("edge", "two"))
        bnd[:] = np.array([[0, 1], [3, 0]]) + start
        if says_start:
            nv.start_index = bnd.start_index = np.int32(start)
        kind = file.createVariable("kind", "i4", ("edge",))
        kind[:] = [1, 2]
        kind.flag_values = np.array([1, 2], dtype=np.int32)
        kind.flag_meanings = "wall open_sea"
        depth = file.createVariable("depth", "i2", ("time", "node"))
        depth[:] = [[0] * 6, [10, 20, 30, 40, 50, -1]]
        depth.scale_factor, depth.add_offset, depth._FillValue = 0.5, 1.0, np.int16(-1)
        friction = file.createVariable("friction", "f4", ("face",))
        friction[:] = [1.0, 2.0, 3.0]


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize("fill", [-99, 2**31 - 1])
@pytest.mark.parametrize("transposed", [False, True])
@pytest.mark.parametrize("swapped", [False, True])
def test_the_spellings_of_one_mesh(tmp_path, start, fill, transposed, swapped):
    write_small(tmp_path / "a.nc", start=start, fill=fill, transposed=transposed, swapped=swapped)
    found = read(tmp_path / "a.nc")
    assert_is_mesh_file(found)
    assert found.format == "netcdf"
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.quad_points[found.quads[0]].tolist() == [[1, 0], [2, 0], [2, 1], [1, 1]]
    assert found.point_data["depth"].tolist() == [6, 11, 16, 21]
    assert np.isnan(found.quad_point_data["depth"]).sum() == 1
    assert found.cell_data["friction"].tolist() == [1, 2]
    assert [(b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [
        ("wall", 1, [0, 1]),
        ("open_sea", 2, [0, 3]),
    ]


def test_counting_from_1_without_saying_so_is_told(tmp_path):
    write_small(tmp_path / "a.nc", start=1, says_start=False, boundary_node_connectivity="")
    found = read(tmp_path / "a.nc")
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert "nv has no start_index, its nodes count from 1" in found.notes


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cf_role": "nothing"}, "no variable with cf_role mesh_topology"),
        ({"topology_dimension": np.int32(1)}, "a mesh topology of another dimension"),
        ({"node_coordinates": "lon"}, "needs node_coordinates of two variables, got 'lon'"),
        ({"node_coordinates": "lon height"}, "height is not in the file"),
        ({"node_coordinates": "lon friction"}, "have not one value a node"),
        ({"face_node_connectivity": "faces"}, "its face_node_connectivity 'faces' is not in the file"),
        ({"face_node_connectivity": "lon"}, "lon has 1 dimensions, not 2"),
        ({"face_node_connectivity": "bnd"}, "bnd has 2 corners a face"),
        ({"boundary_node_connectivity": "nv"}, r"nv has shape \(3, 4\)"),
        ({"start": 3}, "triangle 1 names point 6"),
    ],
)
def test_what_is_refused(tmp_path, changes, message):
    path = tmp_path / "a.nc"
    if "start" in changes:  # indices shifted by 3, but said to count from 0
        write_small(path, start=3, says_start=False)
    else:
        write_small(path, **changes)
    with pytest.raises(MeshReadError, match=message):
        read(path)


def test_fill_between_corners_is_refused(tmp_path):
    write_small(tmp_path / "a.nc", fill=2)
    with pytest.raises(MeshReadError, match="fill values between corners"):
        read(tmp_path / "a.nc")


def test_the_missing_package_is_named(tmp_path, meshes, monkeypatch):
    monkeypatch.setitem(sys.modules, "netCDF4", None)
    with pytest.raises(MeshReadError, match=r"needs the package netCDF4; pip install 'bsgplan\[netcdf\]'"):
        read(meshes / "small_ugrid_zero_based.nc")
    write_small(tmp_path / "classic.nc")
    assert read(tmp_path / "classic.nc").mesh.n_triangles == 2


def test_netcdf4_agrees_with_classic(tmp_path):
    netcdf4 = pytest.importorskip("netCDF4")
    write_small(tmp_path / "classic.nc")
    with netcdf4.Dataset(tmp_path / "classic.nc") as old, netcdf4.Dataset(tmp_path / "new.nc", "w") as new:
        for name, dimension in old.dimensions.items():
            new.createDimension(name, len(dimension))
        old.set_auto_maskandscale(False)
        for name, variable in old.variables.items():
            attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
            fill = attributes.pop("_FillValue", None)
            copy = new.createVariable(
                name, variable.dtype, variable.dimensions, fill_value=fill, zlib=bool(variable.ndim)
            )
            copy.setncatts(attributes)
            copy.set_auto_maskandscale(False)
            copy[...] = variable[...]
    one, other = read(tmp_path / "classic.nc"), read(tmp_path / "new.nc")
    assert np.array_equal(one.mesh.points, other.mesh.points)
    assert np.array_equal(one.mesh.triangles, other.mesh.triangles)
    assert one.description()["arrays"] == other.description()["arrays"]
    assert np.array_equal(one.point_data["depth"], other.point_data["depth"])
    assert [(b.name, b.nodes.tolist()) for b in one.boundaries] == [
        (b.name, b.nodes.tolist()) for b in other.boundaries
    ]


def test_a_variable_that_claims_more_than_the_file_can_hold(tmp_path):
    netcdf4 = pytest.importorskip("netCDF4")
    with netcdf4.Dataset(tmp_path / "bomb.nc", "w") as file:
        file.createDimension("node", 10**12)
        file.createVariable("lon", "f8", ("node",), zlib=True, chunksizes=(10**6,))
    with pytest.raises(MeshReadError, match="variable lon claims 8000000000000 bytes"):
        read(tmp_path / "bomb.nc")


def test_the_real_file_is_its_twin(meshes):
    pytest.importorskip("netCDF4")
    found = read(meshes / "small_ugrid_zero_based.nc")
    twin = meshio.read(meshes / "oracle" / "small_ugrid_zero_based.nc.vtu")
    assert_is_mesh_file(found)
    assert np.array_equal(found.mesh.points, twin.points[:, :2])
    assert np.array_equal(np.sort(found.mesh.triangles), np.sort(twin.cells_dict["triangle"]))
    assert np.array_equal(found.point_data["depth"], twin.point_data["depth"])
    assert {b.name: b.n_nodes for b in found.boundaries} == {"no_flow_boundary": 19, "open_boundary": 2}
    assert set(found.cell_data) == {"u", "v"}


def test_what_is_written_is_read_again_quads_and_all(tmp_path):
    write_small(tmp_path / "a.nc")
    found = read(tmp_path / "a.nc")
    write_ugrid(found, tmp_path / "b.nc")
    again = read(tmp_path / "b.nc")
    assert np.array_equal(again.mesh.triangles, found.mesh.triangles)
    assert np.array_equal(again.quad_points[again.quads], found.quad_points[found.quads])
    assert np.array_equal(again.point_data["depth"], found.point_data["depth"])
    assert np.array_equal(again.cell_data["friction"], found.cell_data["friction"])
    assert {b.name for b in again.boundaries} == {"wall", "open_sea", "unmarked"}


@given(mesh=random_meshes())
def test_random_meshes_survive_to_the_last_bit(tmp_path, mesh):
    rim = np.flatnonzero(mesh.topology.is_boundary)
    written = MeshFile(
        "x", "test", mesh, np.empty((0, 4), int), np.empty((0, 2)),
        point_data={"a b": np.arange(mesh.n_points) / 3}, cell_data={"node": mesh.areas},
        boundaries=(Boundary("land", rim, 20),), title="a coast",
    )  # fmt: skip
    write_ugrid(written, tmp_path / "random.nc")
    found = read(tmp_path / "random.nc")
    assert np.array_equal(found.mesh.points, mesh.points)
    assert np.array_equal(found.mesh.triangles, mesh.triangles)
    assert np.array_equal(found.point_data["a_b"], np.arange(mesh.n_points) / 3)
    assert np.array_equal(found.cell_data["node"], mesh.areas)
    assert found.title == "a coast"
    assert [(b.name, b.code, b.nodes.tolist()) for b in found.boundaries] == [("land_20", 20, rim.tolist())]


def test_degrees_are_written_where_the_mesh_was_projected(tmp_path, meshes):
    from bsgplan.io import read_lonlat

    projected = read_lonlat(meshes / "shinnecock_inlet.fort.14")
    write_ugrid(projected, tmp_path / "inlet.nc")
    plain = read(meshes / "shinnecock_inlet.fort.14")
    assert read(tmp_path / "inlet.nc").mesh.points == pytest.approx(plain.mesh.points, abs=1e-9)
    with netcdf_file(tmp_path / "inlet.nc", mmap=False) as file:
        assert file.variables["mesh_node_lon"].units == b"degrees_east"
