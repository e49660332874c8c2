"""The figure of a plan: what it shows, that its labels keep apart, that its file is whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bsgplan.errors import InvalidOption, OutputError
from bsgplan.io import MeshFile, read, read_lonlat
from bsgplan.mesh import Mesh
from bsgplan.patterns import subdivide
from bsgplan.planning import Plan, estimate
from bsgplan.regions import find_regions
from bsgplan.report.figure import figure, save_figure
from bsgplan.report.figure_labels import EM, LINE, colour_indices, neighbour_pairs, place_labels
from bsgplan.report.figure_list import MOST_LISTED, listed_regions
from bsgplan.report.figure_panels import pattern_text
from bsgplan.report.figure_scene import charge_density, scene_of
from bsgplan.report.figure_view import view_of, zoom_box
from bsgplan.sizing import SizeField, size_field

CASES = Path(__file__).parents[2] / "cases"


def plan_of(size: SizeField, n: int = 16) -> Plan:
    return estimate(find_regions(size, tris_per_block=n), tris_per_block=n)


def case(name: str) -> MeshFile:
    return read(CASES / name / "mesh.msh")


@pytest.fixture(scope="module")
def rectangle() -> Plan:
    return plan_of(size_field(case("rectangle").mesh))


@pytest.fixture(scope="module")
def islands() -> Plan:
    return plan_of(size_field(case("islands").mesh))


def labels(drawn) -> list[str]:
    return [t.get_text() for axes in drawn.axes for t in axes.texts if t.get_gid() == "region-label"]


def test_every_region_has_a_label_and_a_line_in_the_list(rectangle: Plan):
    drawn = figure(rectangle, name="rectangle")
    assert sorted(text.split("\n")[0] for text in labels(drawn)) == ["0", "1", "2"]
    assert "rectangle" in drawn.get_suptitle()
    assert f"{rectangle.n_blocks} blocks" in drawn.get_suptitle()
    rows = [t.get_text() for t in drawn.axes[-1].texts if not t.get_text().lstrip().startswith("id")]
    assert len(rows) == len(rectangle.regions)
    assert str(rectangle.region_plans[1].chosen.pattern) in rows[1]


def test_a_domain_with_a_small_fine_part_is_zoomed(rectangle: Plan):
    size = size_field(case("aerofoil").mesh)
    box = zoom_box(view_of(size.mesh, None), size)
    assert (box[0] < [-0.5, -0.05]).all()
    assert (box[1] > [0.5, 0.05]).all()
    assert np.ptp(box, axis=0).max() < 10
    titles = [axes.get_title(loc="left") for axes in figure(plan_of(size)).axes]
    assert sum(title.startswith("(") for title in titles) == 6
    assert zoom_box(view_of(rectangle.regions.size.mesh, None), rectangle.regions.size) is None


def test_neighbours_differ_in_colour(islands: Plan):
    scene = scene_of(islands, None)
    pairs = neighbour_pairs(islands.regions.size.mesh, islands.regions.label)
    assert len(pairs) > 12
    assert (scene.colour[pairs[:, 0]] != scene.colour[pairs[:, 1]]).all()


@given(st.lists(st.tuples(st.integers(0, 19), st.integers(0, 19)), max_size=60))
def test_colours_are_proper_where_the_palette_lasts(pairs: list[tuple[int, int]]):
    edges = np.array([p for p in pairs if p[0] != p[1]], dtype=np.int64).reshape(-1, 2)
    colour = colour_indices(edges, range(20), 20)
    assert (colour[edges[:, 0]] != colour[edges[:, 1]]).all()


@given(
    st.lists(st.tuples(st.floats(0, 6), st.floats(0, 4), st.floats(0, 1)), max_size=30),
    st.integers(1, 24),
)
def test_labels_never_overlap(spots: list[tuple[float, float, float]], length: int):
    values = np.array(spots).reshape(-1, 3)
    box = np.array([[0.0, 0.0], [6.0, 4.0]])
    short = [str(k) for k in range(len(spots))]
    long = [f"{text}\n{'x' * length}" for text in short]
    placed = place_labels(long, short, values[:, :2], values[:, 2], 0.1, box)
    assert len(placed) <= len(spots)
    frames = []
    for label in placed:
        lines = label.text.split("\n")
        half = np.array([EM * max(map(len, lines)), LINE * len(lines)]) * 0.05
        frames.append((np.array(label.place) - half, np.array(label.place) + half))
    for i, (low, high) in enumerate(frames):
        assert (low >= box[0] - 1e-6).all()
        assert (high <= box[1] + 1e-6).all()
        for other_low, other_high in frames[:i]:
            assert (low >= other_high - 1e-6).any() or (high <= other_low + 1e-6).any()


def test_every_region_of_a_map_of_some_finds_room(islands: Plan):
    assert len(labels(figure(islands))) == len(islands.regions)


def test_more_regions_than_fit_the_list_are_told_together(islands: Plan, monkeypatch):
    assert listed_regions(islands) == list(range(len(islands.regions)))
    monkeypatch.setattr("bsgplan.report.figure_list.MOST_LISTED", 5)
    listed = listed_regions(islands)
    assert len(listed) == 4
    drawn = figure(islands)
    assert len(labels(drawn)) == 4
    rest = f"{len(islands.regions) - 4} smaller regions"
    assert any(rest in t.get_text() for t in drawn.axes[-1].texts)
    assert MOST_LISTED >= 30


def test_long_patterns_lose_their_middle(islands: Plan):
    scene = scene_of(islands, None)
    longest = max(islands.region_plans, key=lambda p: p.chosen.pattern.n_fronts if p.chosen else 0)
    for width in (12, 20, 60):
        text = pattern_text(scene, longest.region.id, width)
        counts = longest.chosen.pattern.counts
        assert len(text) <= max(width, len(f"{counts[0]}:..:{counts[-1]}"))
        assert text.startswith(f"{counts[0]}:")
        assert text.endswith(f":{counts[-1]}")


def test_the_charge_of_a_uniform_square_is_noise_and_that_of_a_transition_is_not(rectangle: Plan):
    density, noise = charge_density(plan_of(size_field(case("square").mesh)))
    assert np.sqrt((density**2).mean()) < noise
    assert charge_density(rectangle)[0].max() > 10 * noise


def test_the_smoothed_charge_keeps_its_sum(rectangle: Plan):
    from bsgplan.mesh.operators import vertex_areas
    from bsgplan.sizing.field import EQUILATERAL

    size = rectangle.regions.size
    blocks = vertex_areas(size.mesh) / (16 * EQUILATERAL * size.h**2)
    assert (charge_density(rectangle)[0] * blocks).sum() == pytest.approx(rectangle.drivers.charge, rel=0.01)


def test_a_projected_plan_is_drawn_in_degrees():
    mesh_file = read_lonlat(CASES / "rectangle" / "mesh.msh")
    drawn = figure(plan_of(size_field(mesh_file.mesh)), projection=mesh_file.projection)
    assert "degrees" in drawn.axes[0].get_xlabel()
    assert drawn.axes[0].get_xlim()[0] == pytest.approx(0.0, abs=0.2)
    assert drawn.axes[0].get_xlim()[1] == pytest.approx(2.96, abs=0.2)


def test_a_closed_surface_is_seen_from_one_side():
    corners = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]])
    points, triangles, _ = subdivide(corners * [4.0, 2.0, 1.0], faces, 8)
    mesh = Mesh(points, triangles)
    view = view_of(mesh, None)
    assert len(view.shown) == mesh.n_triangles // 2
    assert np.abs(view.axes) == pytest.approx(np.eye(3)[:2], abs=1e-9)
    drawn = figure(plan_of(size_field(mesh)))
    assert "principal axis" in drawn.axes[0].get_xlabel()


@pytest.mark.parametrize(("suffix", "first"), [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_figures_are_written_whole(rectangle: Plan, tmp_path: Path, suffix: str, first: bytes):
    path = tmp_path / f"plan.{suffix}"
    save_figure(figure(rectangle), path)
    assert path.read_bytes().startswith(first)
    assert list(tmp_path.iterdir()) == [path]


def test_another_suffix_is_wrong_usage(rectangle: Plan, tmp_path: Path):
    with pytest.raises(InvalidOption, match=r"plan\.bmp: suffix '\.bmp' .* \.png, \.svg, \.pdf"):
        save_figure(figure(rectangle), tmp_path / "plan.bmp")


def test_a_failed_write_leaves_nothing(rectangle: Plan, tmp_path: Path, monkeypatch):
    drawn = figure(rectangle)
    with pytest.raises(OutputError, match=r"plan\.png: cannot be written \(No such file"):
        save_figure(drawn, tmp_path / "nowhere" / "plan.png")

    def full(path: Path, **_: object) -> None:
        path.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(drawn, "savefig", full)
    with pytest.raises(OutputError, match="No space left"):
        save_figure(drawn, tmp_path / "plan.png")
    assert list(tmp_path.iterdir()) == []
