"""`bsgplan patterns`: the ranked front, layers as a length, block sizes, and one line for what is wrong."""

from __future__ import annotations

import json

import pytest

from bsgplan.cli import main
from bsgplan.patterns import length_of_layers


def listed(capsys, *words):
    assert main(["patterns", *words, "--json"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return json.loads(out)


def test_7_to_1_ranks_7_4_2_1_above_the_patterns_of_the_paper(capsys):
    found = listed(capsys, "7:1")
    assert found["schema"] == "bsgplan.patterns/1"
    assert found["length"] is None
    names = [p["pattern"] for p in found["patterns"]]
    assert names.index("7:4:2:1") < min(names.index("7:4:1"), names.index("7:5:3:1"))
    best = found["patterns"][names.index("7:4:2:1")]
    assert (best["n_blocks"], best["positive"], round(best["q_min"], 3)) == (20, 3, 0.756)
    assert [p["q_min"] for p in found["patterns"]] == sorted(
        (p["q_min"] for p in found["patterns"]), reverse=True
    )
    at = {p["pattern"]: round(p["q_min"], 3) for p in listed(capsys, "7:1", "--length", "0.7")["patterns"]}
    assert at["7:4:2:1"] == 0.736


def test_layers_and_a_block_size_make_the_transition_of_the_paper(capsys):
    found = listed(capsys, "28:4", "--layers", "9.5", "--tris-per-block", "16")
    assert (found["asked"], found["fine"], found["coarse"]) == ("28:4", 7, 1)
    assert found["length"] == pytest.approx(length_of_layers(28, 4, 9.5))
    by_name = {p["pattern"]: p for p in found["patterns"]}
    assert by_name["7:5:3:1"]["n_triangles"] == 384
    assert by_name["7:4:1"]["n_triangles"] == 256
    assert found["patterns"][0]["pattern"] == "7:4:2:1"
    same = listed(capsys, "28:4", "--length", str(found["length"]), "--tris-per-block", "16")
    assert same["patterns"] == found["patterns"]


def test_the_table_has_the_rows_asked_for_and_says_what_it_leaves_out(capsys):
    assert main(["patterns", "20:2", "--most", "5"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    n = len(listed(capsys, "20:2")["patterns"])
    assert f"of {n}: close ones are left out" in out
    assert 3 <= sum(line.startswith("20:") for line in out.splitlines()) <= 5


def test_reversed_and_closed_transitions(capsys):
    forth, back = listed(capsys, "7:2"), listed(capsys, "2:7")
    assert [p["counts"][::-1] for p in forth["patterns"]] == [p["counts"] for p in back["patterns"]]
    assert listed(capsys, "12:6", "--closed")["is_closed"]


@pytest.mark.parametrize(
    "words",
    [
        ["7"],
        ["7:4:1"],
        ["7:one"],
        ["0:1"],
        ["700:1"],
        ["7:2", "--closed"],
        ["7:1", "--length", "-1"],
        ["7:1", "--length", "1", "--layers", "3"],
        ["7:1", "--layers", "0"],
        ["7:1", "--tris-per-block", "15"],
        ["7:1", "--least-quality", "2"],
        ["7:1", "--most", "0"],
    ],
)
def test_what_is_wrong_by_itself_is_one_line_and_code_2(capsys, words):
    assert main(["patterns", *words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["7:1", "--length", "0.01"], "reaches a mean ratio of 0.3"),
        (["7:1", "--least-quality", "0.9"], "reaches a mean ratio of 0.9"),
        (["28:1", "--tris-per-block", "16"], "carries 0 blocks of side 4"),
    ],
)
def test_no_pattern_is_one_line_and_code_1(capsys, words, says):
    assert main(["patterns", *words]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert says in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("most", [1, 2, 3, 8])
def test_the_best_pattern_is_shown_however_few_are(capsys, most):
    assert main(["patterns", "7:1", "--length", "0.7", "--most", str(most)]) == 0
    rows = [line for line in capsys.readouterr().out.splitlines() if line.startswith("7:")]
    assert rows[0].split()[0] == "7:4:2:1"
    assert 1 <= len(rows) <= most
