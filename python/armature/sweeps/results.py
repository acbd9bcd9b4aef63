# SPDX-License-Identifier: Apache-2.0
"""What a sweep gave: its runs as rows, as CSV, as a numpy array, as text."""
from __future__ import annotations

import csv
import dataclasses
import json
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .points import Value
from .run import Run, is_number

if TYPE_CHECKING:
    import numpy


@dataclasses.dataclass(frozen=True)
class Effort:
    """What a sweep cost. Runs that were taken from its folder cost nothing."""

    wall_s: float = 0.0  #: from the call to its last run
    workers: int = 0
    own_s: float = 0.0  #: the runs' own time, each measured around itself, in its worker
    runs: int = 0

    @property
    def overhead(self) -> float:
        """What workers did beside runs, over the runs' own time: 0.05 are 5 %. NaN without runs."""
        return (self.wall_s * self.workers - self.own_s) / self.own_s if self.own_s else math.nan


class Results(Sequence[Run]):
    """The runs of a sweep in the order of its points; fewer than those if it was interrupted."""

    def __init__(
        self,
        runs: Sequence[Run],
        *,
        objective: str | None = None,
        effort: Effort = Effort(),
        folder: Path | None = None,
        title: str = "",
    ):
        self._runs = tuple(runs)
        self._objective = objective
        self.effort = effort
        self.folder = folder  #: of the sweep, if it has one
        self.title = title  #: of its page

    def __len__(self) -> int:
        return len(self._runs)

    def __getitem__(self, index: Any) -> Any:
        return self._runs[index]

    def __iter__(self) -> Iterator[Run]:
        return iter(self._runs)

    @property
    def parameters(self) -> list[str]:
        """Names of what the points set."""
        return _names(run.point for run in self._runs)

    @property
    def metrics(self) -> list[str]:
        """Names of what the runs gave."""
        return _names(run.metrics for run in self._runs)

    @property
    def objective(self) -> str | None:
        """The metric by which runs are better the smaller it is: the first one if none was named."""
        return self._objective or next(iter(self.metrics), None)

    @property
    def outcomes(self) -> dict[str, int]:
        """How many runs ended how."""
        return dict(Counter(run.outcome for run in self._runs))

    def folder_of(self, run: Run) -> Path | None:
        """Where the run is recorded; None if it is not."""
        folder = None if self.folder is None else self.folder / run_folder(run.number)
        return folder if folder is not None and folder.is_dir() else None

    def ranked(self) -> list[Run]:
        """Runs that have the objective, best first; equal ones by their number."""
        name = self.objective or ""
        having = [run for run in self._runs if not math.isnan(run.metrics.get(name, math.nan))]
        return sorted(having, key=lambda run: (run.metrics[name], run.number))

    @property
    def best(self) -> Run:
        """@raises LookupError if no run has the objective; the text has the first reason."""
        ranked = self.ranked()
        if ranked:
            return ranked[0]
        if self.metrics and self.objective not in self.metrics:
            names = ", ".join(self.metrics)
            raise LookupError(f"no run has the metric '{self.objective}': there are {names}")
        reasons = [f": run {run.number}, {run.reason}" for run in self._runs if run.reason]
        raise LookupError(f"no run of {len(self)} is done{(reasons or [''])[0]}")

    def array(self) -> numpy.ndarray[Any, Any]:
        """A structured array, a row for each run: `number`, `outcome`, parameters, metrics.

        Parameters are float64 if all their values are numbers, else text. What a run does not have
        is NaN or an empty text.
        """
        import numpy

        numeric = {
            name: all(is_number(run.point.get(name, 0.0)) for run in self._runs)
            for name in self.parameters
        }
        texts = {
            name: [text_of(run.point.get(name)) for run in self._runs] for name in self.parameters
        }
        width = {name: max((len(text) for text in texts[name]), default=1) for name in texts}
        fields: list[tuple[str, str]] = [("number", "i8"), ("outcome", "U8")]
        fields += [(n, "f8" if numeric[n] else f"U{max(1, width[n])}") for n in self.parameters]
        fields += [(name, "f8") for name in self.metrics]
        made = numpy.zeros(len(self), dtype=fields)
        made["number"] = [run.number for run in self._runs]
        made["outcome"] = [run.outcome for run in self._runs]
        for name in self.parameters:
            numbers = [run.point.get(name, math.nan) for run in self._runs]
            made[name] = numbers if numeric[name] else texts[name]
        for name in self.metrics:
            made[name] = [run.metrics.get(name, math.nan) for run in self._runs]
        return made

    def to_csv(self, path: str | Path) -> None:
        """A line for each run. Numbers have all their digits: reading gives the same bits.

        Columns: `run`, the parameters, the metrics, `outcome`, `reason`, `seconds`, `worker`.
        """
        with open(path, "w", newline="", encoding="utf-8", errors="backslashreplace") as file:
            writer = csv.writer(file)
            names = [*self.parameters, *self.metrics]
            writer.writerow(["run", *names, "outcome", "reason", "seconds", "worker"])
            for run in self._runs:
                writer.writerow(
                    [
                        run.number,
                        *(text_of(run.point.get(name)) for name in self.parameters),
                        *(repr(run.metrics[n]) if n in run.metrics else "" for n in self.metrics),
                        run.outcome,
                        run.reason,
                        f"{run.seconds:.4f}",
                        run.worker,
                    ]
                )

    def table(self, count: int = 10) -> str:
        """The best `count` runs as text, with a line that says how all of them ended."""
        names = [*self.parameters, *self.metrics]
        rows = [["run", *names]]
        for run in self.ranked()[:count]:
            values = {**run.point, **run.metrics}
            rows.append([str(run.number), *(_short(values.get(name)) for name in names)])
        widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
        lines = ["  ".join(text.rjust(width) for text, width in zip(row, widths)) for row in rows]
        return "\n".join([*lines, self.summary()])

    def summary(self) -> str:
        """`200 runs: 180 done, 20 refused`"""
        counts = ", ".join(f"{count} {outcome}" for outcome, count in self.outcomes.items())
        return f"{len(self)} runs: {counts}" if counts else "no runs"

    def page(self, path: str | Path) -> None:
        """One HTML file that loads nothing from elsewhere: see page.py."""
        from .page import write_page

        write_page(self, Path(path))

    def __repr__(self) -> str:
        return f"<Results: {self.summary()}>"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.table())}</pre>"


def run_folder(number: int) -> str:
    """Of a recorded run, below the folder of the sweep."""
    return f"runs/{number:06d}"


def text_of(value: Value) -> str:
    """A parameter's value as `armature run --set` takes it."""
    value = value.tolist() if hasattr(value, "tolist") else value  # numpy's
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if value is None:
        return ""
    if is_number(value):
        return repr(value)
    return json.dumps(value)


def _names(mappings: Any) -> list[str]:
    """All names, in the order in which they come first."""
    return list(dict.fromkeys(name for mapping in mappings for name in mapping))


def _short(value: Any) -> str:
    return f"{value:.6g}" if is_number(value) else text_of(value)
