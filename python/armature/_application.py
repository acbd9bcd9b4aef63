# SPDX-License-Identifier: Apache-2.0
"""A running application in simulated time."""
from __future__ import annotations

import atexit
import contextlib
import enum
import weakref
from collections.abc import Callable
from types import TracebackType

from armature import _native
from armature._component import Components, Face
from armature._errors import DeploymentError, RunError, StoodStill, has_errors
from armature._members import Wait
from armature._native import LogLine


class RunEnd(enum.Enum):
    """Why a stretch of time has ended."""

    TIME_UP = "time_up"
    CONDITION_MET = "condition_met"
    FAULTED = "faulted"  # and the deployment stops everything after a fault
    STOPPED_BY_REACTION = "stopped_by_reaction"


class Application(Face):
    """An application in simulated time, which passes only while a function here lets it.

    Its components are attributes and items: `app.PID1`, `app["PID1"]`; a name that is a method of
    this class too is an item only. One thread at a time may use it; `now` is for all. As a context
    manager it stops at the end.
    """

    def __init__(self, loaded: _native.Deployed, name: str, record: str, grants: list[str]) -> None:
        self._name = name
        self._simulation = _native.Simulation(loaded, record, grants)
        diagnostics = self._simulation.start()
        if has_errors(diagnostics):
            raise DeploymentError(diagnostics)
        # Components know the simulation, not this object: without a cycle it ends when the last
        # reference is gone, and with it its recordings and the lock of their folder.
        super().__init__(Components(self._simulation, _waiting_in(self._simulation)))
        _unstopped.add(self)

    @property
    def name(self) -> str:
        """Of the application, as its deployment says."""
        return self._name

    @property
    def now(self) -> float:
        """How far time is [s], from 0. Any thread may ask."""
        return self._simulation.now

    @property
    def running(self) -> bool:
        """From its start to its stop."""
        return self._simulation.running

    @property
    def last_end(self) -> RunEnd:
        """Why the last stretch of time has ended; TIME_UP before the first one."""
        return RunEnd(self._simulation.last_end)

    @property
    def end_reason(self) -> str:
        """Who has ended time before it was up, by a fault or a reaction, and when; empty: nobody."""
        return _what_ended(self._simulation) if self.last_end in _ENDS_OF_TIME else ""

    def run_for(self, duration: float | str) -> RunEnd:
        """Lets so much time pass: seconds, or a text with a unit, `"60 s"`. Other threads of Python
        run meanwhile, and Ctrl-C ends it with a KeyboardInterrupt between two instants."""
        return RunEnd(self._simulation.run_for(duration, None))

    def run_until(self, condition: Callable[[], bool], limit: float | str) -> RunEnd:
        """Lets time pass until `condition` is true, and no longer than `limit`. It is asked whenever
        all that is due at an instant is done; it may look at the application, set properties and call
        operations."""
        return RunEnd(self._simulation.run_for(limit, condition))

    def step(self, at_most: float | str = 1.0) -> float:
        """Goes on to the next instant at which something is due, no further than `at_most`, and does
        all of it. Returns what `now` is then."""
        self._simulation.step(at_most)
        return self._simulation.now

    @property
    def log(self) -> list[LogLine]:
        """The newest lines of the log, at most 200."""
        return self._simulation.log(0)

    @property
    def faults(self) -> dict[str, str]:
        """The components that are out of service, with their reasons; once it has stopped, those that were
        by then."""
        return self._simulation.faults()

    def stop(self) -> None:
        """Does what the deployment wants done before a stop, and stops; nothing if it has stopped.

        Raises RunError if that did not go in good order.
        """
        self._stop(in_order=True)

    def _stop(self, in_order: bool) -> None:
        diagnostics = self._simulation.stop(in_order)
        if in_order and has_errors(diagnostics):
            raise RunError(diagnostics)

    def __enter__(self) -> Application:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 where: TracebackType | None) -> None:
        self._stop(in_order=error is None)

    def __repr__(self) -> str:
        state = f"at {self.now:.6g} s" if self.running else "stopped"
        return f"<Application '{self._name}' {state}, {len(self.components)} components>"


def _waiting_in(simulation: _native.Simulation) -> Wait:
    def wait(condition: Callable[[], bool], limit: float) -> bool:
        end = RunEnd(simulation.run_for(limit, condition))
        if end in _ENDS_OF_TIME:
            raise StoodStill(_what_ended(simulation))
        return end is RunEnd.CONDITION_MET
    return wait


# No more of it passes then.
_ENDS_OF_TIME = (RunEnd.FAULTED, RunEnd.STOPPED_BY_REACTION)


def _what_ended(simulation: _native.Simulation) -> str:
    """Of an application that faulted or was stopped by a reaction: when, and who is why."""
    # Whoever a reaction has stopped is in no fault, and has a reason.
    reasons = simulation.faults() or {one.name: one.reason for one in simulation.components() if one.reason}
    told = "; ".join(f"{name}: {reason}" for name, reason in reasons.items())
    return f"the application ended at {simulation.now:.6g} s, {told}"


# Of this process. A recording that nobody stopped would not be complete.
_unstopped: weakref.WeakSet[Application] = weakref.WeakSet()


@atexit.register
def _stop_all() -> None:
    for application in list(_unstopped):
        # One that another thread drives until the end of the process cannot be stopped.
        with contextlib.suppress(_native.Error):
            application._stop(in_order=False)
