# SPDX-License-Identifier: Apache-2.0
"""How well joints follow their references in a run, measured while it goes on."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from armature._errors import StoodStill
from armature._native import ErrorFigures, ErrorMetrics


class Following:
    """Lets an application's time pass, and takes the error of each joint once in each period.

    @param joints  the ports of each joint's reference and measurement, `("PID1.Ref", "PID1.Sen")`
    @param period  [s] between two samples: the controller's, or a multiple of it
    """

    def __init__(self, application: Any, joints: Sequence[tuple[str, str]], period: float):
        self._application = application
        self._period = period
        self._ports = [
            (_port(application, reference), _port(application, measured))
            for reference, measured in joints
        ]
        self._metrics = ErrorMetrics(len(joints), period)

    @property
    def joints(self) -> list[ErrorFigures]:
        """Of each joint `iae`, `itae`, `ise`, `itse`, `largest`, `last` (control::ErrorMetrics)."""
        return self._metrics.joints

    @property
    def seconds(self) -> float:
        """For which it has measured."""
        return self._metrics.samples * self._period

    def run_until(self, seconds: float) -> None:
        """Until it has measured for so long; nothing if it has already.

        @raises armature.Error if a fault, or a reaction to old data, ends the application before
        """
        wanted = round(seconds / self._period)
        while self._metrics.samples < wanted:
            self._application.run_for(self._period)
            if self._application.end_reason:
                raise StoodStill(self._application.end_reason)
            self._metrics.step([a.value - b.value for a, b in self._ports])


def _port(application: Any, name: str) -> Any:
    component, _, port = name.rpartition(".")
    return getattr(application.components[component], port)
