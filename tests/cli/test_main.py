"""`main`: exit codes, one-line errors, --debug, and what it costs to start."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from bsgplan import errors
from bsgplan.cli import app, main
from bsgplan.cli.errors import exit_code


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["info"], "--formats"),
        (["info", "a", "b"], "b"),
        (["info", "--no-such-option", "a"], "--no-such-option"),
        (["no-such-command"], "no-such-command"),
        (["--no-such-option"], "--no-such-option"),
    ],
)
def test_wrong_usage_is_one_line_and_code_two(words, message, capsys):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert message in err
    assert err.count("\n") == 1


def test_a_missing_file_is_one_line_and_code_three(capsys):
    assert main(["info", "no/such.msh"]) == 3
    assert capsys.readouterr() == ("", "error: no/such.msh: no such file; check the path\n")


def test_debug_adds_the_traceback(capsys):
    assert main(["info", "no/such.msh", "--debug"]) == 3
    err = capsys.readouterr().err
    assert err.startswith("Traceback")
    assert err.endswith("error: no/such.msh: no such file; check the path\n")


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (errors.NoPatternFits("x"), 1),
        (errors.InvalidOption("x"), 2),
        (errors.MeshReadError("x"), 3),
        (errors.InvalidMesh("x"), 3),
        (errors.InvalidSize("x"), 3),
        (errors.OutputError("x"), 3),
        (PermissionError(13, "denied", "f"), 3),
        (KeyboardInterrupt(), 130),
        (ZeroDivisionError("x"), 70),
    ],
)
def test_each_error_has_its_code_and_its_line(error, code, monkeypatch, capsys):
    def failing(*words, **options):
        raise error

    monkeypatch.setattr(app, "app", lambda: failing)
    assert exit_code(error) == code
    assert main([]) == code
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert ("internal error" in err) == (code == 70)


def test_a_closed_pipe_is_quiet(tmp_path):
    path = tmp_path / "t.14"
    path.write_text("t\n1 3\n1 0 0 1\n2 1 0 1\n3 1 1 1\n1 3 1 2 3\n")
    reader, writer = os.pipe()
    os.close(reader)
    run = subprocess.run(
        [sys.executable, "-m", "bsgplan", "info", str(path), "--json"],
        stdout=writer, stderr=subprocess.PIPE, check=False,
    )  # fmt: skip
    os.close(writer)
    assert run.stderr.decode().count("\n") <= 1  # the warning about degrees, no traceback
    assert run.returncode == 0


def test_importing_the_command_line_loads_no_numpy():
    heavy = ("numpy", "scipy", "meshio", "rich.markdown")
    code = f"import sys, bsgplan.cli; sys.exit(any(m in sys.modules for m in {heavy}))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_help_is_cheap_and_loads_no_command():
    code = (
        "import sys, time; from bsgplan.cli import main; code = main(['--help']);"
        "print(code, 'numpy' in sys.modules, time.process_time(), file=sys.stderr)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    code_text, has_numpy, seconds = run.stderr.split()
    assert (code_text, has_numpy) == ("0", "False")
    assert float(seconds) < 0.6  # 0.2 alone; twice the promise, for a busy machine
    assert "estimate" in run.stdout
    assert "info" in run.stdout


def test_version_is_the_package_version(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip()[0].isdigit()
