# SPDX-License-Identifier: Apache-2.0
"""A run of a deployment in simulated time."""
from __future__ import annotations

import contextlib
import dataclasses
import json
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .identity import digest_of, files_named_by, source_of
from .journal import as_json
from .points import Point, Value
from .run import Metrics, Refusal, RunPoint

#: Commands an application in simulated time, and returns what it measured.
Measure = Callable[[Any], Metrics]


class Faulted(Exception):
    """A component went out of service in a run."""


@dataclasses.dataclass(frozen=True)
class Simulated:
    """Loads the deployment with a point's values, and has `measure` run it."""

    deployment: str  #: its file, an absolute path
    measure: Measure
    set: Mapping[str, Value]
    libraries: tuple[str, ...] = ()
    grants: tuple[str, ...] = ()
    components: tuple[type, ...] = ()

    def __call__(self, point: Point, folder: Path | None) -> Metrics:
        with contextlib.ExitStack() as stack:
            where = folder or Path(stack.enter_context(_scratch_folder()))
            metrics = self._run(point, where, record=folder is not None)
        if folder is not None:
            _leave_report(folder, point, metrics)
        return metrics

    def _run(self, point: Point, folder: Path, record: bool) -> Metrics:
        import armature

        try:
            loaded = armature.load(
                self.deployment,
                set={**self.set, **point},
                libraries=self.libraries,
                components=self.components,
            )
            # A deployment's own recorder records in any case.
            what = None if record else ()
            application = loaded.application(record=folder, what=what, grants=self.grants)
        except armature.DeploymentError as error:
            raise Refusal(self._first_mistake(error)) from error
        with application:
            try:
                metrics = self.measure(application)
            except Exception as error:
                _raise_faults(application, error)
                raise
            _raise_faults(application)
        return metrics

    def _first_mistake(self, error: Exception) -> str:
        """Files are told as seen from the deployment's folder, wherever that is on each host."""
        return str(error).split("\n", 1)[0].replace(f"{Path(self.deployment).parent}/", "")

    @property
    def folders(self) -> list[Path]:
        """From which files are seen that values name."""
        return [Path(self.deployment).parent, Path.cwd()]

    def describe(self) -> dict[str, str]:
        file = Path(self.deployment)
        return {
            "deployment": self.deployment,
            "files of the deployment": digest_of(file, _library_folders(file, self.libraries)),
            "values set": repr(sorted(self.set.items())),
            "grants": repr(sorted(self.grants)),
            "components in Python": repr([source_of(one) for one in self.components]),
            "metrics": source_of(self.measure),
        }


def _scratch_folder() -> tempfile.TemporaryDirectory[str]:
    """Without recordings a deployment's own recorder has to write somewhere, too."""
    return tempfile.TemporaryDirectory(prefix="armature-sweep-")


def _raise_faults(application: Any, error: Exception | None = None) -> None:
    """Whatever else went wrong, faults are why, and so is what ended the application's time."""
    faults = "; ".join(f"{name}: {reason}" for name, reason in application.faults.items())
    if faults or application.end_reason:
        raise Faulted(faults or application.end_reason) from error


def _leave_report(folder: Path, point: Point, metrics: Metrics) -> None:
    """`point.json`, and the report of the recording, if the program `armature` is installed."""
    import armature

    left = {"parameters": as_json(point), "metrics": dict(metrics)}
    (folder / "point.json").write_text(json.dumps(left, indent=2) + "\n", encoding="utf-8")
    program = Path(armature.__file__).parents[4] / "bin/armature"  # in a build as installed
    if program.exists():
        subprocess.run([program, "report", folder], capture_output=True, check=False)


def describe(run_point: RunPoint, points: Sequence[Point]) -> dict[str, str]:
    """What runs depend on beside their points, as text by name: folders compare it."""
    if isinstance(run_point, Simulated):
        return {**run_point.describe(), **files_named_by([run_point.set, *points], run_point.folders)}
    return {"run": source_of(run_point), **files_named_by(points, [Path.cwd()])}


def _library_folders(deployment: Path, first: Sequence[str]) -> list[str]:
    """All that a load searches."""
    from armature._deployment import _COMPONENTS, _folders_of_environment

    return [*first, *_folders_of_environment(), _COMPONENTS, str(deployment.parent)]
