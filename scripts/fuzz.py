"""Fuzz our own readers with coverage feedback; not part of CI.

    pip install --editable . --group fuzz --group test
    python scripts/fuzz.py                       # every reader of ours, a minute each
    python scripts/fuzz.py su2 mfem --seconds 300

Each reader runs in a process of its own with 2 GB of memory at most, starts from tests/seeds.py and may raise
only BsgplanError. What breaks it stands afterwards in the folder --keep (fuzz-findings), one file a finding.
"""

from __future__ import annotations

import argparse
import logging
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]


def main() -> int:
    """Fuzz the formats that were asked for, one after the other; return 1 where one broke."""
    from seeds import OWN

    logging.disable(logging.WARNING)  # writers tell what a seed has no place for
    names = [own.name for own in OWN]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("format", nargs="*", default=names, help=", ".join(names))
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--keep", type=Path, default=Path("fuzz-findings"))
    parser.add_argument("--only", help=argparse.SUPPRESS)
    options, rest = parser.parse_known_args()
    if options.only:
        fuzz(options.only, [*options.format, *rest])
        return 0
    unknown = set(options.format) - set(names)
    if unknown:
        parser.error(f"no reader of ours: {', '.join(sorted(unknown))}; take of {', '.join(names)}")
    options.keep.mkdir(parents=True, exist_ok=True)
    broken = [name for name in options.format if not survives(name, options.seconds, options.keep)]
    print("broken: " + ", ".join(broken) if broken else f"{', '.join(options.format)}: nothing found")
    return int(bool(broken))


def survives(name: str, seconds: int, keep: Path) -> bool:
    """Fuzz one reader in a process of its own; return whether it raised nothing but errors of ours."""
    from seeds import seeds

    with tempfile.TemporaryDirectory() as corpus:
        for number, seed in enumerate(seed for seed in seeds() if seed.format.name == name):
            names = sorted(seed.files)
            for k, file in enumerate(names):
                which = bytes([k]) if len(names) > 1 else b""
                (Path(corpus) / f"{number}-{file}").write_bytes(which + seed.files[file])
        command = [sys.executable, __file__, "--only", name, corpus, f"-max_total_time={seconds}"]
        command += ["-max_len=4096", "-timeout=20", "-rss_limit_mb=2048"]
        command += [f"-artifact_prefix={keep}/{name}-", "-print_final_stats=1"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    told = [line for line in done.stderr.splitlines() if "stat::number_of_executed_units" in line]
    print(f"{name}: {told[-1].split()[-1] if told else '?'} files, exit code {done.returncode}")
    if done.returncode:
        print(done.stderr[-4000:])
    return done.returncode == 0


def fuzz(name: str, arguments: list[str]) -> None:
    """Give atheris's inputs to one reader and to what follows it, until the time is over."""
    import atheris

    with atheris.instrument_imports(include=["bsgplan"]):
        from seeds import seeds

        from bsgplan.errors import BsgplanError
        from bsgplan.io.file import assemble

        folder = tempfile.TemporaryDirectory()
        seed = next(seed for seed in seeds() if seed.format.name == name)
        seed.format.read(seed.written(Path(folder.name)))  # imports the reader
    names = sorted(seed.files)

    def one_input(content: bytes) -> None:
        # a format of several files: the first byte says which one is damaged
        damaged = names[content[0] % len(names)] if content and len(names) > 1 else names[0]
        path = seed.written(Path(folder.name), damaged, content[len(names) > 1 :])
        try:
            mesh = assemble(path.name, name, seed.format.read(path)).mesh
        except (BsgplanError, OSError):
            return
        assert mesh.triangles.min() >= 0
        assert mesh.triangles.max() < mesh.n_points
        assert (mesh.areas > 0).all()

    with folder:
        atheris.Setup([sys.argv[0], *arguments], one_input)
        atheris.Fuzz()


if __name__ == "__main__":
    sys.exit(main())
