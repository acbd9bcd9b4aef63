# SPDX-License-Identifier: Apache-2.0
"""A run of a deployment in simulated time, and what tells one experiment from another."""
from __future__ import annotations

import dataclasses
import hashlib
import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from .points import Point, Value
from .run import Metrics, Refusal, RunPoint

#: Commands an application in simulated time, and returns what it measured.
Measure = Callable[[Any], Metrics]


@dataclasses.dataclass(frozen=True)
class Simulated:
    """Loads the deployment with a point's values, and has `measure` run it."""

    deployment: str  #: its file, an absolute path
    measure: Measure
    set: Mapping[str, Value]
    libraries: Any = None

    def __call__(self, point: Point, folder: Path | None) -> Metrics:
        import armature

        try:
            loaded = armature.load(
                self.deployment, set={**self.set, **point}, libraries=self.libraries
            )
            application = loaded.application(record=None if folder is None else str(folder))
        except armature.DeploymentError as error:
            raise Refusal(str(error)) from error
        try:
            return self.measure(application)
        finally:
            application.stop()

    def describe(self) -> dict[str, str]:
        return {
            "deployment": self.deployment,
            "deployment's files": _digest(self.deployment),
            "values set": repr(sorted(self.set.items())),
            "libraries": repr(self.libraries),
            "metrics": _source_of(self.measure),
        }


def describe(run_point: RunPoint) -> dict[str, str]:
    """What runs depend on beside their points, as text by name: folders compare it."""
    own = getattr(run_point, "describe", None)
    return own() if own is not None else {"run": _source_of(run_point)}


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


def _digest(file: str) -> str:
    """Of a deployment and of what it includes, wherever that is."""
    raise NotImplementedError
