# SPDX-License-Identifier: Apache-2.0
"""Workers on many machines: runs as tasks of a Dask `Client`. Dask schedules; nothing here does."""
from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import Any

from .job import Job
from .run import Run, Task, lost, run_task


def run_batch(tasks: Sequence[Task], job: Job) -> list[Run]:
    """One task of Dask's: some runs, one after the other. Runs in a worker."""
    run_point = job.load()
    return [run_task(run_point, task) for task in tasks]


def run_on(client: Any, job: Job, tasks: Sequence[Task], batch: int = 1) -> Generator[Run, None, None]:
    """Yields each task's run as its batch ends, in whatever order that is.

    Dask gives the batches of a worker that died to others, until it has lost as many workers with
    one as its setting `distributed.scheduler.allowed-failures` says; then its runs are lost.
    A caller that leaves the iteration early takes back what has not begun.
    """
    import distributed

    as_completed: Any = distributed.as_completed  # which has no types
    batches = [tasks[i : i + batch] for i in range(0, len(tasks), batch)]
    futures = client.map(run_batch, batches, job=job, pure=False, key="armature-run")
    tasks_of = dict(zip((future.key for future in futures), batches))
    try:
        for future in as_completed(futures):
            yield from _runs_of(future, tasks_of[future.key])
            future.release()
    finally:
        client.cancel([future for future in futures if not future.done()])


def count_workers(client: Any) -> int:
    """Processes that do runs, each one run at a time."""
    return len(client.scheduler_info()["workers"])


def _runs_of(future: Any, tasks: Sequence[Task]) -> list[Run]:
    if future.status == "finished":
        runs: list[Run] = future.result()
        return runs
    if future.status == "cancelled":
        raise RuntimeError("the cluster has cancelled runs of this sweep (start it again)")
    error = future.exception()
    if type(error).__name__ != "KilledWorker":
        raise RuntimeError(
            f"a worker of the cluster cannot do runs: {error} "
            "(install the same version of armature on every host)"
        ) from error
    attempts = error.allowed_failures
    return [lost(task, attempts, f"{attempts} workers of the cluster died with it") for task in tasks]
