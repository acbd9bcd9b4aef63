# SPDX-License-Identifier: Apache-2.0
"""One run of a sweep: a point in, metrics or a reason out."""
from __future__ import annotations

import contextlib
import dataclasses
import math
import numbers
import os
import random
import shutil
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from .points import Point

#: The run did what it was to do; its metrics are there.
DONE = "done"
#: The deployment does not load with this point; the reason is its first mistake.
REFUSED = "refused"
#: The run ended by a fault or an exception.
FAILED = "failed"
#: Every worker that had it died: the only outcome that another attempt may change.
LOST = "lost"

#: What results say of a run beside its parameters and metrics, which have other names.
OWN_COLUMNS = ("run", "number", "outcome", "reason", "seconds", "worker")

#: Beside the folders of runs: those of runs that are under way, or were cut off.
PARTIAL = "partial"

Metrics = Mapping[str, float]
#: Runs one point: the point, and the folder for what it leaves (None: it leaves nothing).
RunPoint = Callable[[Point, Path | None], Metrics]


class Refusal(Exception):
    """Raised by a `RunPoint` whose point cannot be run at all."""


@dataclasses.dataclass(frozen=True)
class Run:
    """What one run gave. Everything above `seconds` is the same wherever and whenever it runs."""

    number: int  #: of its point in the sweep, from 0
    point: Point
    outcome: str  #: DONE, REFUSED, FAILED or LOST
    metrics: dict[str, float]  #: empty unless DONE
    reason: str  #: empty if DONE
    seconds: float = 0.0  #: of wall time, measured around the run, in its worker
    worker: str = ""  #: `host:process`
    attempts: int = 1  #: one more for each worker that died with it

    @property
    def done(self) -> bool:
        """Whether it has its metrics."""
        return self.outcome == DONE


@dataclasses.dataclass(frozen=True)
class Task:
    """A point that is to be run."""

    number: int
    point: Point
    folder: str | None = None


# Whatever uses threads in this process, one run at a time: what runs share is not theirs then.
_one_at_a_time = threading.Lock()


def run_task(run_point: RunPoint, task: Task) -> Run:
    """Runs `task`; mistakes and faults become the outcome, and nothing is raised for them."""
    with _one_at_a_time:
        _forget_chance()
        begin = time.perf_counter()
        outcome, metrics, reason = _outcome_of(run_point, task)
        seconds = time.perf_counter() - begin
    return Run(task.number, task.point, outcome, metrics, reason, seconds, _this_worker())


def _outcome_of(run_point: RunPoint, task: Task) -> tuple[str, dict[str, float], str]:
    try:
        with _folder_of(task) as folder:
            return DONE, _checked(run_point(dict(task.point), folder), task.point), ""
    except Refusal as refusal:
        return REFUSED, {}, str(refusal)
    except Exception as error:  # of the run alone; Ctrl-C and exits go on
        return FAILED, {}, f"{type(error).__name__}: {error}"


@contextlib.contextmanager
def _folder_of(task: Task) -> Iterator[Path | None]:
    """For what the run leaves. It gets to its place when the run has ended: what was cut off has none.
    A run that was refused leaves nothing."""
    if task.folder is None:
        yield None
        return
    folder = Path(task.folder)
    partial = folder.parent / PARTIAL / folder.name  # by whose name reports are called
    shutil.rmtree(partial, ignore_errors=True)
    partial.mkdir(parents=True)
    try:
        yield partial
    except Refusal:
        shutil.rmtree(partial)
        raise
    except Exception:
        _move(partial, folder)
        raise
    _move(partial, folder)


def _move(partial: Path, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    partial.rename(folder)


def _checked(metrics: Any, point: Point) -> dict[str, float]:
    if not isinstance(metrics, Mapping) or not metrics:
        raise TypeError(
            f"the metrics must be a mapping of names to numbers with at least one, found {metrics!r}"
        )
    for name, value in metrics.items():
        if not isinstance(value, numbers.Real):
            raise TypeError(f"the metric '{name}' must be a number, found {value!r}")
        if name in point or name in OWN_COLUMNS:
            raise ValueError(f"the metric '{name}' has the name of a parameter or of a column: rename it")
    return {str(name): float(value) for name, value in metrics.items()}


def _forget_chance() -> None:
    """Random numbers that a run draws are not those that the run before has left."""
    random.seed(0)
    if "numpy" in sys.modules:
        sys.modules["numpy"].random.seed(0)


def _this_worker() -> str:
    return f"{socket.gethostname()}:{os.getpid()}"


def lost(task: Task, attempts: int, how: str) -> Run:
    """The run that ended its worker `attempts` times."""
    return Run(task.number, task.point, LOST, {}, how, attempts=attempts)


def is_number(value: Any) -> bool:
    """Whether a parameter's value belongs on a numeric axis."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number that no float is near to
        return False
