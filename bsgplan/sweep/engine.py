"""Where the jobs of a sweep run: in processes of this machine, or on the workers of a Dask cluster.

Both give each job back with its rows as soon as it is done. A worker that dies (out of memory, killed, a
machine lost) costs its jobs one more try, and then a row with the error; the other jobs go on.
"""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

from ..errors import InvalidOption, MeshReadError
from .job import Job, Row
from .table import DIED
from .work import plan_rows

CONNECTING = 10.0
"""Seconds to wait for a Dask scheduler."""


def local(jobs: Sequence[Job], n_workers: int) -> Generator[list[Row]]:
    """Give the rows of each job, run in so many processes of this machine."""
    if not jobs:
        return
    left = dict(enumerate(jobs))
    with _pool(min(n_workers, len(jobs))) as pool:
        futures = {pool.submit(plan_rows, job): k for k, job in left.items()}
        for future in as_completed(futures):
            if not isinstance(future.exception(), BrokenProcessPool):
                del left[futures[future]]
                yield future.result()
    for job in left.values():  # a dead worker takes its pool with it: each alone now, to find the culprit
        yield _alone(job)


def _alone(job: Job) -> list[Row]:
    with _pool(1) as pool:
        try:
            return pool.submit(plan_rows, job).result()
        except BrokenProcessPool:
            return job.failed(f"{DIED} on this mesh, twice or alone; is there enough memory?")


@contextmanager
def _pool(n_workers: int) -> Iterator[ProcessPoolExecutor]:
    """A pool whose workers end at once when this process is interrupted: what they are at is not lost."""
    others = set(multiprocessing.active_children())
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(n_workers, mp_context=context, initializer=_ignore_interrupts)
    try:
        yield pool
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            worker.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _ignore_interrupts() -> None:
    """Leave Ctrl-C, which a terminal sends to every process, to the one that started the workers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def on_cluster(jobs: Sequence[Job], address: str) -> Generator[list[Row]]:
    """Give the rows of each job, run by the workers of the Dask scheduler at this address.

    Files are read by the workers, under the same absolute paths. Raises InvalidOption where no scheduler
    answers, MeshReadError where the extra is missing.
    """
    try:
        import distributed
    except ModuleNotFoundError:
        raise MeshReadError("--scheduler needs Dask; pip install 'bsgplan[dask]'") from None
    try:
        client = distributed.Client(address, timeout=CONNECTING)
    except (OSError, ValueError, TypeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InvalidOption(
            f"--scheduler {address}: no scheduler answers there ({reason}); start one"
        ) from None
    with client:
        futures = {client.submit(plan_rows, job, pure=False, retries=1): job for job in jobs}
        for future in distributed.as_completed(list(futures)):
            failure = future.exception()
            job = futures[future]
            if failure is None:
                yield future.result()
            elif type(failure).__name__ == "KilledWorker":
                yield job.failed(f"{DIED} on this mesh, again and again; is there enough memory?")
            else:
                yield job.failed(f"{DIED} or lost the mesh: {type(failure).__name__}: {failure}")
