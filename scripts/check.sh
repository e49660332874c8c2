#!/usr/bin/env bash
# Everything but the tests: style, types, import contract, doctests, docs, the main job, the wheel.
#   scripts/check.sh             with the tools of .venv
#   BIN=/some/venv/bin scripts/check.sh
# Needs the groups test, lint and docs: pip install --editable . --group test --group lint --group docs
set -euo pipefail
cd "$(dirname "$0")/.."
BIN=${BIN:-$PWD/.venv/bin}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

step() { printf '\n== %s\n' "$*"; }

step "style"
"$BIN/ruff" check .
"$BIN/ruff" format --check .

step "types"
"$BIN/mypy"

step "import contract"
"$BIN/lint-imports"

step "doctests"
"$BIN/pytest" --doctest-modules bsgplan

step "docs"
"$BIN/sphinx-build" -W --keep-going -q -b html docs "$scratch/html"

step "the main job"
"$BIN/bsgplan" info cases/shoreline/mesh.msh
"$BIN/bsgplan" estimate cases/shoreline/mesh.msh --tris-per-block 16

step "the wheel"
"$BIN/pip" wheel --quiet --no-deps --wheel-dir "$scratch/wheel" .
"$BIN/pip" install --quiet --no-deps --target "$scratch/site" "$scratch"/wheel/*.whl
export PYTHONPATH=$scratch/site # stands before the editable install
where=$(cd "$scratch" && "$BIN/python" -c 'import bsgplan; print(bsgplan.__file__)')
case $where in
  "$scratch"/site/*) ;;
  *) echo "the wheel is not what was imported: $where" >&2; exit 1 ;;
esac
"$BIN/pytest" tests/cli
