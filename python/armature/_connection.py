# SPDX-License-Identifier: Apache-2.0
"""An application that runs elsewhere: in another process, or on another host."""
from __future__ import annotations

import os
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any

from armature import _native
from armature._component import Components, Face
from armature._native import LogLine
from armature._values import Fields, from_text, to_text


class Connection(Face):
    """An application at an address, with the same components as an `Application` has.

    What may be done is what its policy allows to others; time is the application's own. Several
    threads may use it. Every function raises NoAnswer where nobody answers, Refusal where it is refused.
    """

    def __init__(self, address: str, connection: _native.Connection) -> None:
        self._address = address
        self._connection: _native.Connection | None = connection
        super().__init__(Components(_Elsewhere(self._ask), _wait))

    def _ask(self) -> _native.Connection:
        if self._connection is None:
            raise _native.NoAnswer(f"the connection to {self._address} was closed")
        return self._connection

    @property
    def address(self) -> str:
        """As it was given to `connect`."""
        return self._address

    @property
    def connected(self) -> bool:
        """A connection that is lost comes back by itself."""
        return self._connection is not None and self._connection.connected

    @property
    def name(self) -> str:
        """The application's, as its deployment says it."""
        return self._ask().status()[0]

    @property
    def now(self) -> float:
        """How far the application's time is [s]."""
        return self._ask().status()[1]

    @property
    def simulated(self) -> bool:
        """Whether its time is simulated."""
        return self._ask().status()[2]

    @property
    def log(self) -> list[LogLine]:
        """The lines of its log that are kept, and may be seen."""
        lines: list[LogLine] = []
        while more := self._ask().log(lines[-1].number if lines else 0):
            lines += more
        return lines

    @property
    def faults(self) -> dict[str, str]:
        """The components that are out of service, with their reasons."""
        return {one.name: one.reason for one in self._ask().components() if one.state == "Exception"}

    def close(self) -> None:
        """The application goes on. Nothing can be asked then."""
        self._connection = None

    def __enter__(self) -> Connection:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 where: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "connected" if self.connected else "not connected"
        return f"<Connection {self._address} ({state}), {len(self.components)} components>"


class _Elsewhere:
    """The source of a connection's components: values are texts on their way."""

    def __init__(self, ask: Callable[[], _native.Connection]) -> None:
        self._ask = ask
        self._fields: dict[str, Fields] = {}

    def component_names(self) -> list[str]:
        return self._ask().component_names()

    def describe(self, component: str, with_values: bool) -> _native.ComponentDescription:
        return self._ask().describe(component, with_values)

    def change(self, component: str, change: str) -> None:
        self._ask().change(component, change)

    def raised(self, component: str, event: str) -> int:
        raise _native.NoAnswer(f"how often {component}.{event} was raised is known in its own process only")

    def read(self, component: str, member: str) -> tuple[Any, float]:
        text, type, age = self._ask().read(f"{component}.{member}")
        return (None if text is None else from_text(text, type, self._fields_of(component))), age

    def write(self, component: str, member: str, value: object) -> None:
        self._ask().write(f"{component}.{member}", to_text(value))

    def call(self, component: str, operation: str, arguments: tuple[object, ...]) -> Any:
        result = self._ask().call(component, operation, [to_text(one) for one in arguments])
        return None if result is None else from_text(result[0], result[1], self._fields_of(component))

    def begin(self, component: str, command: str, arguments: tuple[object, ...]) -> _Followed:
        begun = self._ask().begin(component, command, [to_text(one) for one in arguments])
        return _Followed(self._ask, begun)

    def _fields_of(self, component: str) -> Fields:
        if component not in self._fields:
            fields = Fields()
            for one in self.describe(component, False).fields:
                fields.setdefault(one.structure, {})[one.name] = one.type
            self._fields[component] = fields
        return self._fields[component]


class _Followed:
    """A command that was begun elsewhere: asked for until it has ended."""

    def __init__(self, ask: Callable[[], _native.Connection], status: _native.CommandStatus) -> None:
        self._ask = ask
        self._status = status

    def _now(self) -> _native.CommandStatus:
        if not self._status.ended:
            self._status = self._ask().follow(self._status.handle)
        return self._status

    @property
    def ended(self) -> bool:
        return self._now().ended

    @property
    def succeeded(self) -> bool:
        return self._now().succeeded

    @property
    def progress(self) -> float:
        return self._now().progress

    @property
    def stage(self) -> str:
        return self._now().stage

    @property
    def reason(self) -> str:
        return self._now().reason

    def cancel(self) -> None:
        self._status = self._ask().cancel(self._status.handle)


def _wait(condition: Callable[[], bool], limit: float) -> bool:
    end = time.monotonic() + limit
    while not condition():
        if time.monotonic() >= end:
            return False
        time.sleep(0.01)
    return True


def connect(address: str, *, certificate: str | os.PathLike[str] = "", key: str | os.PathLike[str] = "",
            authority: str | os.PathLike[str] = "", tokens: str | os.PathLike[str] = "",
            limit: float = 3.0) -> Connection:
    """Connects to a running application, at most for `limit` [s].

    address: `tcp://127.0.0.1:4242`, `unix:/run/robot.sock`, `tls://robot:4243`, `ws://127.0.0.1:8080`, ...
    certificate, key, authority: files in PEM form, for `tls://` and `wss://`.
    tokens: a file, for `ws://` and `wss://`.
    Raises ValueError for an address that is none, NoAnswer if no application answers there.
    """
    connection = _native.Connection(address, os.fspath(certificate), os.fspath(key), os.fspath(authority),
                                    os.fspath(tokens), limit)
    return Connection(address, connection)
