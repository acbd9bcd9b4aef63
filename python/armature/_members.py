# SPDX-License-Identifier: Apache-2.0
"""Properties, ports, operations and events of a component as Python sees them."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from armature import _native
from armature._errors import StoodStill


class Handle(Protocol):
    """A command that was begun, here or elsewhere."""

    @property
    def ended(self) -> bool: ...
    @property
    def succeeded(self) -> bool: ...
    @property
    def progress(self) -> float: ...
    @property
    def stage(self) -> str: ...
    @property
    def reason(self) -> str: ...
    def cancel(self) -> None: ...


class Source(Protocol):
    """Where components live: an application of this process, or one at an address."""

    def component_names(self) -> list[str]: ...
    def describe(self, component: str, with_values: bool) -> _native.ComponentDescription: ...
    def change(self, component: str, change: str) -> None: ...
    def raised(self, component: str, event: str) -> int: ...
    def read(self, component: str, member: str) -> tuple[Any, float]: ...
    def write(self, component: str, member: str, value: object) -> None: ...
    def call(self, component: str, operation: str, arguments: tuple[object, ...]) -> Any: ...
    def begin(self, component: str, command: str, arguments: tuple[object, ...]) -> Handle: ...


# Lets time pass until the condition is true; False if it is not within so many seconds. Raises
# StoodStill if time has ended before.
Wait = Callable[[Callable[[], bool], float], bool]


class CommandError(_native.Error):
    """A command that failed, was cancelled or did not end in time; `command` is it."""

    def __init__(self, message: str, command: Command) -> None:
        super().__init__(message)
        self.command = command


class Command:
    """A command that was begun."""

    def __init__(self, name: str, handle: Handle, wait: Wait) -> None:
        self._name = name
        self._handle = handle
        self._wait = wait

    @property
    def name(self) -> str:
        """Of the command, as `Generator.moveTo`."""
        return self._name

    @property
    def done(self) -> bool:
        """It has ended, in whatever way."""
        return self._handle.ended

    @property
    def succeeded(self) -> bool:
        """Whether it has ended, and as it was to."""
        return self._handle.succeeded

    @property
    def progress(self) -> float:
        """From 0 to 1, as far as its component reports it."""
        return self._handle.progress

    @property
    def stage(self) -> str:
        """`under way`, `done`, `failed`, `cancelled`, ..."""
        return self._handle.stage

    @property
    def reason(self) -> str:
        """Why it failed or was cancelled."""
        return self._handle.reason

    def cancel(self) -> None:
        """Asks the component to end it; it is over when `done` says so."""
        self._handle.cancel()

    def wait(self, limit: float | str = 3600.0) -> None:
        """Lets time pass until it has ended, no longer than `limit`.

        Raises CommandError if it failed or did not end; it is under way then still.
        """
        self._wait_for_end(_native.seconds_of(limit))
        if not self._handle.succeeded:
            raise CommandError(f"{self._name} {self.stage}: {self.reason}", self)

    def _wait_for_end(self, seconds: float) -> None:
        if self._handle.ended:
            return
        try:
            ended = self._wait(lambda: self._handle.ended, seconds)
        except StoodStill as end:
            ended = self._handle.ended
            if not ended:
                raise CommandError(f"{self._name} has not ended: {end}", self) from None
        if not ended:
            raise CommandError(f"{self._name} has not ended within {seconds:g} s", self)

    def __repr__(self) -> str:
        return f"<Command {self._name} ({self.stage})>"


class _Member:
    """What properties and ports have in common."""

    def __init__(self, source: Source, component: str,
                 about: _native.PropertyDescription | _native.PortDescription) -> None:
        self._source = source
        self._component = component
        self._about = about
        self.__doc__ = member_doc(about)

    @property
    def name(self) -> str:
        """With its component: `PID1.Kp`."""
        return f"{self._component}.{self._about.name}"

    @property
    def doc(self) -> str:
        return self._about.doc

    @property
    def unit(self) -> str:
        """Empty for a plain number."""
        return self._about.unit

    @property
    def type(self) -> str:
        """`double`, `vector<double>`, ..."""
        return self._about.type

    @property
    def value(self) -> Any:
        """A copy of what it is now; None for a port that nobody wrote yet."""
        return self._source.read(self._component, self._about.name)[0]

    def __repr__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        return f"<{type(self).__name__} {self.name} = {self.value!r}{unit}>"


class Property(_Member):
    """A property or attribute of a component."""

    _about: _native.PropertyDescription

    @property
    def value(self) -> Any:
        """A copy of what it is now. It is set by a value of its type, or by a text with a unit."""
        return self._source.read(self._component, self._about.name)[0]

    @value.setter
    def value(self, value: object) -> None:
        self._source.write(self._component, self._about.name, value)

    @property
    def range(self) -> tuple[float, float] | None:
        """The smallest and the largest value, if the model says them."""
        return self._about.range

    @property
    def changeable_while_running(self) -> bool:
        """Whether it may be set while its component runs."""
        return self._about.changeable_while_running


class Port(_Member):
    """A port of a component."""

    _about: _native.PortDescription

    @property
    def age(self) -> float | None:
        """How long ago it was written [s]; None: never."""
        value, age = self._source.read(self._component, self._about.name)
        return None if value is None else age

    @property
    def peers(self) -> list[str]:
        """The ports at the other end of its connections."""
        return self._about.peers


class Input(Port):
    """An input port: its value is what its component has taken of it."""


class Output(Port):
    """An output port: its value is what was written last."""


class Operation:
    """An operation or a command of a component, which is called like a function.

    A command goes on after it was accepted: a call lets time pass until it has ended. `begin` does
    not wait.
    """

    def __init__(self, source: Source, component: str, about: _native.OperationDescription,
                 wait: Wait) -> None:
        self._source = source
        self._component = component
        self._about = about
        self._wait = wait
        self.__doc__ = f"{self.signature}\n\n{about.doc}"

    @property
    def name(self) -> str:
        """With its component, as `Arming.arm`."""
        return f"{self._component}.{self._about.name}"

    @property
    def doc(self) -> str:
        """What it does."""
        return self._about.doc

    @property
    def signature(self) -> str:
        """`double(double position [rad])`."""
        return self._about.signature

    @property
    def is_command(self) -> bool:
        """Whether it takes its time, and can be cancelled."""
        return self._about.command

    def __call__(self, *arguments: object) -> Any:
        """Calls it and returns its result. Raises Refusal, of a command also CommandError."""
        if not self._about.command:
            return self._source.call(self._component, self._about.name, arguments)
        self.begin(*arguments).wait()
        return None

    def begin(self, *arguments: object) -> Command:
        """Begins a command, and does not wait for its end. Raises Refusal."""
        if not self._about.command:
            raise TypeError(f"{self.name} is an operation, not a command: call it")
        handle = self._source.begin(self._component, self._about.name, arguments)
        return Command(self.name, handle, self._wait)

    def __repr__(self) -> str:
        return f"<{'Command' if self._about.command else 'Operation'} {self.name} {self.signature}>"


class Event:
    """An event of a component."""

    def __init__(self, source: Source, component: str, about: _native.EventDescription, wait: Wait) -> None:
        self._source = source
        self._component = component
        self._about = about
        self._wait = wait
        self.__doc__ = about.doc

    @property
    def name(self) -> str:
        """With its component, as `Arming.Stop`."""
        return f"{self._component}.{self._about.name}"

    @property
    def doc(self) -> str:
        """What it tells."""
        return self._about.doc

    @property
    def signature(self) -> str:
        """What it carries, as its interface says it."""
        return self._about.signature

    @property
    def raised(self) -> int:
        """How often it was raised since the start."""
        return self._source.raised(self._component, self._about.name)

    def wait(self, limit: float | str) -> bool:
        """Lets time pass until it is raised; False if it is not within `limit`. Raises Error if a fault ends
        the application before."""
        before = self.raised
        return self._wait(lambda: self.raised > before, _native.seconds_of(limit))

    def __repr__(self) -> str:
        return f"<Event {self.name} {self.signature}>"


def member_doc(about: _native.PropertyDescription | _native.PortDescription) -> str:
    unit = f" [{about.unit}]" if about.unit else ""
    values = f" ({', '.join(about.values)})" if about.values else ""
    return f"{about.type}{unit}: {about.doc}{values}"
