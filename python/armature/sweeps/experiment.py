# SPDX-License-Identifier: Apache-2.0
"""A run of a deployment in simulated time, and what tells one experiment from another."""
from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import inspect
import json
import re
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

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

    def __call__(self, point: Point, folder: Path | None) -> Metrics:
        with contextlib.ExitStack() as stack:
            where = folder or Path(stack.enter_context(_scratch_folder()))
            metrics = self._run(point, where)
        if folder is not None:
            _leave_report(folder, point, metrics)
        return metrics

    def _run(self, point: Point, folder: Path) -> Metrics:
        import armature

        try:
            loaded = armature.load(
                self.deployment, set={**self.set, **point}, libraries=self.libraries
            )
            application = loaded.application(record=folder, grants=self.grants)
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

    def describe(self) -> dict[str, str]:
        return {
            "deployment": self.deployment,
            "files of the deployment": digest_of(Path(self.deployment), self.libraries),
            "values set": repr(sorted(self.set.items())),
            "grants": repr(sorted(self.grants)),
            "metrics": _source_of(self.measure),
        }


def _scratch_folder() -> tempfile.TemporaryDirectory[str]:
    """Without recordings a deployment's own recorder has to write somewhere, too."""
    return tempfile.TemporaryDirectory(prefix="armature-sweep-")


def _raise_faults(application: Any, error: Exception | None = None) -> None:
    """Whatever else went wrong, faults are why."""
    faults = "; ".join(f"{name}: {reason}" for name, reason in application.faults.items())
    if faults:
        raise Faulted(faults) from error


def _leave_report(folder: Path, point: Point, metrics: Metrics) -> None:
    """`point.json`, and the report of the recording, if the program `armature` is installed."""
    import armature

    left = {"parameters": as_json(point), "metrics": dict(metrics)}
    (folder / "point.json").write_text(json.dumps(left, indent=2) + "\n", encoding="utf-8")
    program = Path(armature.__file__).parents[4] / "bin/armature"  # in a build as installed
    if program.exists():
        subprocess.run([program, "report", folder], capture_output=True, check=False)


def describe(run_point: RunPoint) -> dict[str, str]:
    """What runs depend on beside their points, as text by name: folders compare it."""
    if isinstance(run_point, Simulated):
        return run_point.describe()
    return {"run": _source_of(run_point)}


def _source_of(function: Any) -> str:
    """Its name and a digest of its text, as far as there is one; of a partial, its values too."""
    inner = getattr(function, "func", None)
    if inner is not None:
        return f"{_source_of(inner)} {function.args!r} {sorted(function.keywords.items())!r}"
    subject = function if hasattr(function, "__qualname__") else type(function)
    name = f"{subject.__module__}.{subject.__qualname__}"
    try:
        return f"{name} {hashlib.sha256(inspect.getsource(subject).encode()).hexdigest()[:16]}"
    except (OSError, TypeError):
        return name


_FILE_NAME = re.compile(r"[\w./${}~+-]+\.(?:yaml|yml|xml|cpf|urdf|json|csv|lua|policy)\b")


def digest_of(deployment: Path, library_folders: Sequence[str] = ()) -> str:
    """Of a deployment, of all files that it and they name, and of its component libraries.

    What looks like a file's name and is one counts, in comments, too: too much rather than too
    little. The libraries of the runtime itself are left out.
    """
    digest = hashlib.sha256()
    words: set[str] = set()
    waiting, seen = [deployment], {deployment}
    while waiting:
        file = waiting.pop()
        content = file.read_bytes()
        digest.update(content)
        text = content.decode("utf-8", "replace")
        words.update(re.findall(r"\w+", text))
        for name in sorted(set(_FILE_NAME.findall(text))):
            named = (file.parent / name.replace("${here}", ".")).resolve()
            if named not in seen and named.is_file():
                seen.add(named)
                waiting.append(named)
    for library in _libraries_in(library_folders):
        if library.stem.removeprefix("lib") in words:
            digest.update(library.read_bytes())
    return digest.hexdigest()[:16]


def _libraries_in(folders: Sequence[str]) -> list[Path]:
    from armature._deployment import _COMPONENTS

    return [file for folder in (*folders, _COMPONENTS) for file in sorted(Path(folder).glob("lib*.so"))]
