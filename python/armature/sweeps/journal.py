# SPDX-License-Identifier: Apache-2.0
"""The folder of a sweep: its runs as they end, so that what was done is not done again."""
from __future__ import annotations

import dataclasses
import fcntl
import json
from collections.abc import Mapping
from pathlib import Path, PurePath
from types import TracebackType
from typing import Any

from .identity import FILE
from .points import Point, PointsError
from .run import LOST, Run

EXPERIMENT = "sweep.json"
RUNS = "runs.jsonl"


class JournalError(ValueError):
    """The folder cannot be that of this sweep; the text says what is in its way."""


class Journal:
    """Opens `folder` for a sweep, and locks it until closed; it is created if it is missing.

    @param experiment  what the runs depend on beside their points: text by name
    @raises JournalError if it is in use, or its runs are those of another experiment
    """

    def __init__(self, folder: Path, experiment: Mapping[str, str]):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self._file = open(folder / RUNS, "a+b")
        try:
            self._lock()
            self._expect(dict(experiment))
            self._runs = self._read()
        except BaseException:
            self._file.close()
            raise

    @property
    def runs(self) -> list[Run]:
        """All of them, by their number."""
        return sorted(self._runs.values(), key=lambda run: run.number)

    def find(self, point: Point) -> Run | None:
        """The run of this very point, unless it was lost with its workers."""
        run = self._runs.get(key_of(point))
        return None if run is None or run.outcome == LOST else run

    def number_of(self, point: Point) -> int | None:
        """Of a point that was run before, with or without result."""
        run = self._runs.get(key_of(point))
        return None if run is None else run.number

    @property
    def next_number(self) -> int:
        return 1 + max((run.number for run in self._runs.values()), default=-1)

    def add(self, run: Run) -> None:
        """It is in the file when this returns."""
        line = json.dumps({**dataclasses.asdict(run), "point": as_json(run.point)})
        self._file.write(line.encode() + b"\n")
        self._file.flush()
        self._runs[key_of(run.point)] = run

    def close(self) -> None:
        self._file.close()

    def __enter__(self) -> Journal:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _lock(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise JournalError(
                f"{self.folder} is in use by another sweep (give another folder)"
            ) from None

    def _expect(self, experiment: dict[str, str]) -> None:
        file = self.folder / EXPERIMENT
        if not file.exists():
            self._write_experiment(experiment)
            return
        found = json.loads(file.read_text(encoding="utf-8"))
        # Files that points name are compared where both name them: points are added to a folder.
        names = {
            name for name in found.keys() | experiment.keys()
            if not name.startswith(FILE) or (name in found and name in experiment)
        }  # fmt: skip
        other = sorted(name for name in names if found.get(name) != experiment.get(name))
        if other:
            raise JournalError(
                f"{self.folder} has runs of another experiment: {', '.join(other)} "
                "changed since (give another folder, or remove this one)"
            )
        self._write_experiment({**found, **experiment})

    def _write_experiment(self, experiment: dict[str, str]) -> None:
        partial = self.folder / (EXPERIMENT + ".partial")
        partial.write_text(json.dumps(experiment, indent=2) + "\n", encoding="utf-8")
        partial.replace(self.folder / EXPERIMENT)

    def _read(self) -> dict[str, Run]:
        """What a crash has left of a last line is cut off."""
        self._file.seek(0)
        text = self._file.read()
        whole = text.rfind(b"\n") + 1
        if whole < len(text):
            self._file.truncate(whole)
        runs = [Run(**json.loads(line)) for line in text[:whole].splitlines()]
        return {key_of(run.point): run for run in runs}


def key_of(point: Point) -> str:
    """Equal for equal points: those with the same bits."""
    return json.dumps(as_json(point), sort_keys=True)


def as_json(point: Point) -> dict[str, Any]:
    """Numbers and arrays of numpy are numbers and lists.

    @raises PointsError if a value is none that a deployment takes
    """
    return {name: _plain(value, name) for name, value in point.items()}


def _plain(value: Any, name: str) -> Any:
    if hasattr(value, "tolist"):
        value = value.tolist()
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, (list, tuple)):
        return [_plain(part, name) for part in value]
    if isinstance(value, Mapping):
        return {str(key): _plain(part, name) for key, part in value.items()}
    if isinstance(value, PurePath):
        return str(value)
    raise PointsError(
        f"a value of '{name}' must be a number, a text, a list or a mapping of them, found {value!r}"
    )
