"""The registry: every path leads to a function, names and suffixes are unique, sniffing agrees with it."""

from __future__ import annotations

import importlib
import json
import re

import pytest

from bsgplan.cli import main
from bsgplan.io.formats import BY_SUFFIX, FORMATS
from bsgplan.io.sniff import OTHER_FORMATS, SIGNATURES, SUFFIXES


def test_names_are_words_and_unique():
    names = [found.name for found in FORMATS]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[a-z][a-z0-9.]*|2dm", name) for name in names)


@pytest.mark.parametrize("found", FORMATS, ids=lambda found: found.name)
def test_every_import_path_leads_to_a_function(found):
    assert found.reader or found.writer
    for path in (found.reader, found.writer):
        if path is not None:
            module, function = path.split(":")
            assert callable(getattr(importlib.import_module(module, "bsgplan.io"), function))


def test_what_sniffing_finds_is_a_format_that_is_read_or_one_with_a_remedy():
    read = {found.name for found in FORMATS if found.reader}
    assert {name for _, name in SIGNATURES} <= read | set(OTHER_FORMATS)
    assert not read & set(OTHER_FORMATS)
    assert not set(SUFFIXES) & set(BY_SUFFIX)
    assert set(SUFFIXES.values()) <= set(OTHER_FORMATS)


def test_the_list_of_formats_is_the_registry(capsys):
    assert main(["info", "--formats", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "bsgplan.formats/1"
    assert [entry["name"] for entry in document["formats"]] == [found.name for found in FORMATS]
    assert main(["info", "--formats"]) == 0
    out = capsys.readouterr().out
    for found in FORMATS:
        assert re.search(rf"^{re.escape(found.name)} .*{re.escape(found.what)}", out, flags=re.M)


@pytest.mark.parametrize("words", [["info"], ["info", "x.msh", "--formats"]])
def test_info_takes_a_file_or_the_list(words, capsys):
    assert main(words) == 2
    assert "one of the two" in capsys.readouterr().err
