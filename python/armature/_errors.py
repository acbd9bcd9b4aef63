# SPDX-License-Identifier: Apache-2.0
"""Errors that have diagnostics."""
from __future__ import annotations

from collections.abc import Sequence

from armature import _native
from armature._native import Diagnostic


class DeploymentError(_native.Error):
    """A deployment that cannot be run; `diagnostics` tells each mistake with its place."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        super().__init__(_errors_in(diagnostics))
        self.diagnostics = list(diagnostics)


class RunError(_native.Error):
    """An application that did not stop in good order; `diagnostics` says why."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        super().__init__(_errors_in(diagnostics))
        self.diagnostics = list(diagnostics)


class StoodStill(_native.Error):
    """What was waited for cannot come: a fault, or a reaction to old data, has ended the application's time."""


def has_errors(diagnostics: Sequence[Diagnostic]) -> bool:
    return any(one.severity == "error" for one in diagnostics)


def _errors_in(diagnostics: Sequence[Diagnostic]) -> str:
    return "\n".join(str(one) for one in diagnostics if one.severity == "error")
