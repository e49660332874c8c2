"""What a piece of work costs: CPU seconds of a call, CPU seconds and peak memory of a whole process."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

T = TypeVar("T")


STARTER = """
import os, subprocess, sys
process = subprocess.Popen([sys.executable, *sys.argv[1:]], stdout=subprocess.DEVNULL)
_, status, used = os.wait4(process.pid, 0)
print(used.ru_utime + used.ru_stime, used.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status) and 1)
"""
"""Runs a Python process and prints its CPU seconds and the largest resident set, as the system says it."""


@dataclass(frozen=True)
class Cost:
    """What the operating system says a process used."""

    cpu: float
    """User and system time of all its threads, seconds."""
    peak: float
    """Largest resident set, bytes."""


def cpu_of(call: Callable[[], T]) -> tuple[T, float]:
    """Return the result of a call and the CPU seconds of this process that it took."""
    start = time.process_time()
    result = call()
    return result, time.process_time() - start


def cost_of(words: Sequence[str]) -> Cost:
    """Return the cost of a command of `python -m bsgplan`; raise SystemExit where it fails."""
    return cost_of_python(["-m", "bsgplan", *words])


def cost_of_python(words: Sequence[str]) -> Cost:
    """Return the cost of a Python process with these arguments, its output thrown away.

    Started by a small process of its own: a child begins with the peak memory of its parent.
    """
    told = subprocess.run([sys.executable, "-c", STARTER, *words], stdout=subprocess.PIPE, check=False)
    if told.returncode:
        raise SystemExit(f"{' '.join(words)}: exit code {told.returncode}")
    cpu, peak = told.stdout.split()
    return Cost(float(cpu), float(peak) * (1 if sys.platform == "darwin" else 1024))
