# SPDX-License-Identifier: Apache-2.0
"""`armature.sweep`: many runs of a deployment in simulated time, on this machine or on many."""
from __future__ import annotations

import contextlib
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from . import cluster
from .experiment import Measure, Simulated, describe
from .job import Job
from .journal import Journal, as_json, key_of
from .points import Point, PointsError, Value, listed
from .pool import Pool
from .progress import Progress
from .results import Effort, Results, run_folder
from .run import OWN_COLUMNS, PARTIAL, REFUSED, Run, RunPoint, Task

Parameters = Mapping[str, Sequence[Value]] | Iterable[Mapping[str, Value]]


class Interrupted(KeyboardInterrupt):
    """Ctrl-C in a sweep: `results` has the runs until then, and so has its folder."""

    def __init__(self, results: Results):
        super().__init__(f"interrupted after {results.summary()}")
        self.results = results


def sweep(
    deployment: str | Path,
    parameters: Parameters,
    metrics: Measure,
    *,
    client: Any = None,
    workers: int | Pool | None = None,
    set: Mapping[str, Value] | None = None,
    libraries: Iterable[str | Path] = (),
    grants: Iterable[str] = (),
    components: Iterable[type] = (),
    objective: str | None = None,
    out: str | Path | None = None,
    record: bool = False,
    batch: int = 1,
    progress: bool = True,
) -> Results:
    """Runs `deployment` once for each point of `parameters`, and has `metrics` measure each run.

    A result depends on its point only: it is the same to the bit on any worker, in any order. A run
    that does not load or that faults is a row with its reason. The runs of a worker that dies are
    done again.

    @param parameters  values of each property or parameter of the deployment, all combinations of
                       which are run; or the points themselves (see `armature.sweeps.points`)
    @param metrics     `metrics(application)` commands an application in simulated time, at time 0,
                       and returns numbers by name
    @param client      a Dask `Client`: runs are done by its workers. The files of the deployment are
                       at the same path on each host, and the same armature is installed there.
    @param workers     without a client: how many processes of this machine (None: one a core), or a
                       `Pool` that is open already
    @param set         as of `armature.load`: what is the same in all runs
    @param libraries, components  as of `armature.load`
    @param grants      as of `Deployment.application`
    @param objective   the metric by which a run is better the smaller it is; None: the first
    @param out         a folder for `runs.csv`, `sweep.html` and what was done so far: runs that it
                       has already are not done again
    @param record      each run leaves its recordings, `point.json` and a report in a folder of its
                       own, `out/runs/NUMBER`; runs without one are done again
    @param batch       runs that make one task for Dask: more than 1 if a run takes milliseconds
    @param progress    told on standard error
    @raises Interrupted on Ctrl-C, with the results so far
    @raises PointsError, JournalError, PoolError, TypeError, before anything is run
    """
    file = Path(deployment).resolve()
    return each(
        Simulated(
            str(file),
            metrics,
            dict(set or {}),
            tuple(map(str, libraries)),
            tuple(grants),
            tuple(components),
        ),
        listed(parameters),
        client=client,
        workers=workers,
        objective=objective,
        out=out,
        record=record,
        batch=batch,
        progress=progress,
        title=file.name,
    )


def each(
    run_point: RunPoint,
    points: Iterable[Mapping[str, Value]],
    *,
    client: Any = None,
    workers: int | Pool | None = None,
    objective: str | None = None,
    out: str | Path | None = None,
    record: bool = False,
    batch: int = 1,
    progress: bool = True,
    title: str = "",
) -> Results:
    """As `sweep`, for whatever a run is: `run_point(point, folder)` returns its metrics.

    `folder` is None unless `record`. It raises `Refusal` for a point that cannot be run.
    """
    if batch < 1:
        raise ValueError(f"the runs of a batch must be 1 or more, found {batch}")
    if client is not None and workers is not None:
        raise ValueError("runs are done by a client's workers or by those of this machine, not both")
    if record and out is None:
        raise ValueError("recordings need a folder (give out=FOLDER)")
    plan = _Plan(_checked(listed(points)), Job.of(run_point), objective, title)
    with contextlib.ExitStack() as stack:
        if out is not None:
            plan.journal = stack.enter_context(Journal(Path(out), describe(run_point, plan.points)))
        tasks = plan.tasks(record)
        begin = time.perf_counter()
        runs, count = _start(stack, plan.job, tasks, client, workers, batch)
        told = Progress(len(tasks), objective) if progress and tasks else None
        try:
            for run in runs:
                plan.take(run)
                if told:
                    told.add(run)
        except KeyboardInterrupt:
            raise Interrupted(plan.finish(time.perf_counter() - begin, count)) from None
        results = plan.finish(time.perf_counter() - begin, count)
    return results


def _checked(points: list[Point]) -> list[Point]:
    """Their values as files and other processes have them, too."""
    plain = [as_json(point) for point in points]
    for name in OWN_COLUMNS:
        if any(name in point for point in plain):
            raise PointsError(f"a parameter cannot be called '{name}', as a column of the results is")
    return plain


def _start(
    stack: contextlib.ExitStack,
    job: Job,
    tasks: list[Task],
    client: Any,
    workers: int | Pool | None,
    batch: int,
) -> tuple[Iterator[Run], int]:
    """The runs to come, and how many workers they come from."""
    if client is not None:
        runs = cluster.run_on(client, job, tasks, batch)
        stack.callback(runs.close)
        return runs, cluster.count_workers(client)
    if not tasks:
        return iter(()), 0
    pool = workers if isinstance(workers, Pool) else stack.enter_context(Pool(workers))
    return pool.run(job, tasks), len(pool)


class _Plan:
    """Which points are to be run, and what has come of them."""

    def __init__(self, points: list[Point], job: Job, objective: str | None, title: str):
        self.job = job
        self.journal: Journal | None = None
        self.points = points
        self._objective = objective
        self._title = title
        self._runs: dict[str, Run] = {}
        self._new: list[Run] = []

    def tasks(self, record: bool) -> list[Task]:
        """One for each point whose run is not there yet, or not recorded; equal points are one."""
        made: dict[str, Task] = {}
        new_number = self.journal.next_number if self.journal else 0
        for point in self.points:
            key = key_of(point)
            if key in made or key in self._runs:
                continue
            number = self.journal.number_of(point) if self.journal else None
            if number is None:
                number, new_number = new_number, new_number + 1
            folder = self._folder(number) if record else None
            known = self.journal.find(point) if self.journal else None
            left_all = folder is None or folder.is_dir() or (known and known.outcome == REFUSED)
            if known is not None and left_all:
                self._runs[key] = known
            else:
                made[key] = Task(number, point, None if folder is None else str(folder))
        return list(made.values())

    def take(self, run: Run) -> None:
        self._runs[key_of(run.point)] = run
        self._new.append(run)
        if self.journal:
            self.journal.add(run)

    def finish(self, wall_s: float, workers: int) -> Results:
        """The results of the points that were asked for; the folder shows all that it has."""
        effort = Effort(wall_s, workers, sum(run.seconds for run in self._new), len(self._new))
        if self.journal:
            with contextlib.suppress(OSError):  # it has runs that were cut off
                (self.journal.folder / run_folder(0)).with_name(PARTIAL).rmdir()
            whole = self._results(self.journal.runs, effort)
            whole.to_csv(self.journal.folder / "runs.csv")
            whole.page(self.journal.folder / "sweep.html")
        asked = (self._runs.get(key_of(point)) for point in self.points)
        return self._results([run for run in asked if run is not None], effort)

    def _results(self, runs: list[Run], effort: Effort) -> Results:
        folder = self.journal.folder if self.journal else None
        return Results(
            runs, objective=self._objective, effort=effort, folder=folder, title=self._title
        )

    def _folder(self, number: int) -> Path | None:
        return (self.journal.folder / run_folder(number)).resolve() if self.journal else None
