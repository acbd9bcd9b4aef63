# SPDX-License-Identifier: Apache-2.0
"""Deployments: files that say of which components an application consists, checked and loaded."""
from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from armature import _native
from armature._application import Application
from armature._errors import DeploymentError, has_errors
from armature._native import Diagnostic
from armature._values import to_yaml
from armature.author import Component

# Where component libraries are, in a build tree as in an installation: beside lib/python3.
_COMPONENTS = str(Path(_native.__file__).parents[3] / "armature")


class Deployment:
    """A deployment that passed its check. It makes any number of applications, each from the start."""

    def __init__(self, file: str | os.PathLike[str], set: Mapping[str, object] | None = None,
                 libraries: Iterable[str | os.PathLike[str]] | None = None,
                 components: Iterable[type[Component]] = ()) -> None:
        self._file = os.fspath(file)
        self._overrides = [f"{name}={to_yaml(value)}" for name, value in (set or {}).items()]
        self._folders = [*(os.fspath(folder) for folder in libraries or ()), *_folders_of_environment(), _COMPONENTS]
        self._models = [one._model() for one in components]
        self._loaded: _native.Deployed | None = self._load()
        self._name = self._loaded.name
        self._diagnostics = sorted(self._loaded.diagnostics, key=lambda one: (one.file, one.line, one.column))

    @property
    def file(self) -> str:
        """As it was given to `load`."""
        return self._file

    @property
    def name(self) -> str:
        """The application's name, as the file says it."""
        return self._name

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What the check found: warnings and notes, once it is loaded."""
        return list(self._diagnostics)

    def application(self, record: str | os.PathLike[str] | None = None, *,
                    what: Iterable[str] | None = None, grants: Iterable[str] = ()) -> Application:
        """A new application in simulated time, started and at time 0.

        record: a folder for its recordings, which is made; None: Reporters of the deployment write to
            the working directory.
        what: is recorded there, in `run.mcap`: names as a Reporter has them, `"PID*.Ref"`. None: all output
            ports, unless the deployment has a Reporter of its own. Empty: what its own Reporters record.
        grants: acts of the operator, such as `"Arming.arm"`, that this program may do in addition to
            those that the deployment grants to scripts.
        Raises DeploymentError if it does not start, Refusal if the folder is in use.
        """
        if what is not None and record is None:
            raise ValueError("what is recorded needs a folder: give `record`, too")
        loaded = self._loaded or self._load()
        self._loaded = None
        if what is None and not loaded.has_model("Reporter"):
            what = loaded.writers()
        recorded = list(what or ())
        if record is not None and recorded:
            loaded = self._load(_recorded(self._file, recorded))
        if not loaded.ok:  # its files may have changed
            raise DeploymentError(loaded.diagnostics)
        return Application(loaded, self._name, "" if record is None else os.fspath(record), list(grants))

    def _load(self, text: str = "") -> _native.Deployed:
        """text: in place of the file's, which it includes."""
        folder, name = os.path.split(self._file)
        file = os.path.join(folder, f"recorded {name}.yaml") if text else self._file
        return _native.Deployed(file, text, self._overrides, self._folders, self._models)

    def __repr__(self) -> str:
        return f"<Deployment '{self._name}' of {self._file}>"


def _folders_of_environment() -> list[str]:
    """They come before those of the installation, as for the program."""
    return [folder for folder in os.environ.get("ARMATURE_LIBRARY_PATH", "").split(":") if folder]


def _recorded(file: str, what: list[str]) -> str:
    """The text of a deployment that has a recorder of `what` beside all that is in `file`."""
    return json.dumps({
        "include": os.path.basename(file),
        "libraries": ["record"],
        "components": {"RecordedByPython": {
            "model": "Reporter",
            "activity": {"periodic": "50 ms", "scheduler": "other"},
            "properties": {"what": what, "file": "run.mcap"}}}})


def check(file: str | os.PathLike[str], *, set: Mapping[str, object] | None = None,
          libraries: Iterable[str | os.PathLike[str]] | None = None,
          components: Iterable[type[Component]] = ()) -> list[Diagnostic]:
    """Everything that can be known of a deployment before it starts, as `armature check` tells it.

    set: parameters, properties and activities in place of the file's, as `--set` has them:
        `{"joints": 7, "PID1.Kp": 200, "Joint1.activity.periodic": "5 ms"}`. A text is taken as it is
        written, so it may have a unit.
    libraries: folders that are searched for component libraries before all others.
    components: models of components that are written in Python, by their classes.
    """
    return Deployment(file, set, libraries, components).diagnostics


def load(file: str | os.PathLike[str], *, set: Mapping[str, object] | None = None,
         libraries: Iterable[str | os.PathLike[str]] | None = None,
         components: Iterable[type[Component]] = ()) -> Deployment:
    """Loads and checks a deployment; its arguments are those of `check`.

    Raises DeploymentError if there is any mistake in it.
    """
    deployment = Deployment(file, set, libraries, components)
    if has_errors(deployment.diagnostics):
        raise DeploymentError(deployment.diagnostics)
    return deployment
