"""Triangle's .node and .ele: either is named, both are read; what is refused and where."""

from __future__ import annotations

import pytest

from bsgplan.errors import MeshReadError
from bsgplan.io import read

NODE = """# made by hand
4 2 1 1
0 0.0 0.0 1.5 1  # the origin

1 1.0 0.0 2.5 1
2 1.0 1.0 3.5 0
3 0.0 1.0 4.5 9
"""
ELE = "2 6 1\n0 0 1 2 3 3 3 5\n1 0 2 3 1 1 1 6\n# end\n"


@pytest.fixture
def pair(tmp_path):
    """A function that writes both files and reads the named one."""

    def read_texts(node=NODE, ele=ELE, named=".ele"):
        (tmp_path / "lake.1.node").write_text(node)
        (tmp_path / "lake.1.ele").write_text(ele)
        return read(tmp_path / f"lake.1{named}")

    return read_texts


@pytest.mark.parametrize("named", [".node", ".ele"])
@pytest.mark.parametrize("base", [0, 1])
def test_either_file_with_numbers_from_0_or_1(pair, named, base):
    node = "4 2 1 1\n" + "".join(
        f"{k + base} {x} {y} {k + 1.5} {m}\n"
        for k, (x, y, m) in enumerate([(0, 0, 1), (1, 0, 1), (1, 1, 0), (0, 1, 9)])
    )
    ele = f"2 3 1\n{base} {base} {base + 1} {base + 2} 5\n{base + 1} {base} {base + 2} {base + 3} 6\n"
    found = pair(node, ele, named)
    assert found.mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert found.mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert found.point_data["attribute"].tolist() == [1.5, 2.5, 3.5, 4.5]
    assert found.point_data["marker"].tolist() == [1, 1, 0, 9]
    assert found.cell_data["attribute"].tolist() == [5, 6]


def test_comments_blank_lines_and_six_corners(pair):
    assert pair().mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_the_other_file_is_missing(tmp_path):
    (tmp_path / "lake.1.node").write_text(NODE)
    with pytest.raises(MeshReadError, match=r"needs lake.1.ele beside it"):
        read(tmp_path / "lake.1.node")


@pytest.mark.parametrize(
    ("node", "ele", "message"),
    [
        (NODE.replace("4 2", "4 3", 1), ELE, r"in lake.1.node: line 2: points of dimension 3; .* TetGen"),
        (NODE.replace("4 2", "0 2", 1), ELE, "no points, they are in the .poly"),
        (NODE.replace("4 2", "5 2", 1), ELE, "the file ends after 4 of 5"),
        (NODE.replace("4 2", "1000000000000 2", 1), ELE, "the file ends after 4 of 1000000000000"),
        (NODE.replace("4 2 1 1", "4 2 1000000000 1"), ELE, "attributes are more than 1000"),
        (NODE.replace("1 1.0", "0 1.0", 1), ELE, "line 5: point 0 stands on line 3 already"),
        (NODE.replace("1.0 1.0 3.5", "1.0 one 3.5"), ELE, "line 6: a point has 'one'"),
        (NODE, ELE.replace("1 0 2 3", "1 0 2 8"), "line 3: names point 8"),
        (NODE, ELE.replace("2 6", "2 4", 1), "line 1: cells of 4 points"),
        (NODE, "two triangles", "line 1: needs the number of triangles"),
    ],
)
def test_an_error_names_file_line_and_remedy(pair, node, ele, message):
    with pytest.raises(MeshReadError, match=message) as caught:
        pair(node, ele)
    assert ";" in str(caught.value)
