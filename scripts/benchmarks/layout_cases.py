"""What layouts are demanded to reach: meshes, block sizes and numbers, one line each."""

from __future__ import annotations

from dataclasses import dataclass

CASES = "cases"
"""Folder of the repository; every other path lies among the real meshes, beside the checkout."""


@dataclass(frozen=True)
class Case:
    """A mesh, a block size and demands; a demand left out is not checked."""

    name: str
    path: str
    """Below the folder of real meshes, or below the repository where it starts with CASES."""
    side: int
    is_lonlat: bool = False
    fewer: float | None = None
    """Share of gmsh's irregular vertices (interior + boundary fitted) that must be gone."""
    q_blocks: float | None = None
    rms_times: float | None = None
    """Most rms of log(edge / s h) over gmsh's."""
    rms_plus: float | None = None
    """Most rms of log(edge / s h) above gmsh's."""
    is_even: bool = False
    """No vertex may be off by two edges or more."""
    gain: float | None = None
    """Times fewer irregular vertices in the grid than in the input, boundary fitted."""
    gain_interior: float | None = None
    """The same of interior vertices."""
    enough_interior: int = 0
    """So few irregular interior vertices will do, whatever the input's."""
    q_grid: float | None = None
    is_as_good: bool = False
    """q_min of the grid must also be the input's."""
    triangles: float | None = None
    """Most triangles of the grid over those of the input."""
    deviation: float | None = None
    """Most deviation of the boundary, in fine edges."""
    is_no_poorer: bool = False
    """No more triangles of q under .3 than the input."""
    is_warned: bool = False
    """The user must be told beforehand that the boundary does not carry such blocks."""
    jigsaw: tuple[int, int] | None = None
    """Blocks and irregular interior vertices of JIGSAW's mesh, guide/layout.md section 8."""
    jigsaw_share: float | None = None
    """Most irregular interior vertices over JIGSAW's."""
    jigsaw_near: float | None = None
    """Most relative difference of the number of blocks from JIGSAW's."""

    @property
    def has_rival(self) -> bool:
        """True where gmsh's run is asked for."""
        return self.fewer is not None


def _islands(side: int, fewer: float, q: float) -> Case:
    return Case(
        f"islands, s = {side}",
        "rivals/islands.vtu",
        side,
        fewer=fewer,
        q_blocks=q,
        rms_times=1.05,
        is_even=True,
        gain=40,
        q_grid=0.60,
        is_as_good=True,
        deviation=1.0,
    )


def _plain(name: str) -> Case:
    return Case(
        f"{name}, s = 4", f"rivals/{name}.vtu", 4, fewer=0.80, q_blocks=0.84, rms_plus=0.03, is_even=True
    )


def _coast(name: str, k: int, blocks: int, irregular: int) -> Case:
    share, q, near = (0.45, 0.78, 0.05) if k == 2 else (0.35, 0.67, 0.10)
    return Case(
        f"{name}, k = {k}",
        f"rivals/{name}.vtu",
        2**k,
        q_blocks=q,
        jigsaw=(blocks, irregular),
        jigsaw_share=share,
        jigsaw_near=near,
    )


def _smooth(name: str, path: str) -> Case:
    return Case(
        f"{name}, s = 4",
        path,
        4,
        fewer=0.75,
        gain_interior=15,
        enough_interior=5,
        q_grid=0.65,
        is_as_good=True,
        triangles=1.25,
    )


def _steep(name: str, path: str) -> Case:
    return Case(f"{name}, s = 4", path, 4, fewer=0.55, q_grid=0.75)


def _ragged(name: str, path: str, side: int, *, is_lonlat: bool = True) -> Case:
    gain, q, triangles = (15, 0.30, 1.6) if side == 4 else (12, 0.25, 1.1)
    return Case(
        f"{name}, s = {side}", path, side, is_lonlat, gain_interior=gain, q_grid=q, triangles=triangles
    )


RAGGED = {
    "wnat": "wnat_test_18578.fort.14",
    "bohai": "bohai_yellow_sea_BYS_20814.2dm",
    "katrina": "katrina_wnat_om2d.fort.14",
}

ALL = (
    _islands(4, 0.75, 0.78),
    _islands(8, 0.60, 0.70),
    *map(_plain, ("rectlin", "rectexp", "plate", "lshape")),
    _coast("coast_g01", 2, 1242, 150),
    _coast("coast_g02", 2, 1301, 204),
    _coast("coast_g01", 3, 325, 56),
    _coast("coast_g02", 3, 307, 49),
    _smooth("columbia", "columbia_plume_02_normal.msh"),
    _smooth("bahamas", "bahamas_bight_of_abaco.fort.14"),
    _smooth("naca", "mesh_NACA0012_inv.su2"),
    _smooth("osteon", "osteonT1_11.mesh"),
    _steep("notched", "notched_plate_phasefield.msh"),
    _steep("three_point", "three_point_bending_test.msh"),
    *(_ragged(name, path, side) for side in (4, 2) for name, path in RAGGED.items()),
    *(_ragged("shoreline", f"{CASES}/shoreline/mesh.msh", side, is_lonlat=False) for side in (4, 2)),
    Case("north_sea, s = 4", "north_sea.msh", 4, is_no_poorer=True, is_warned=True),
)
