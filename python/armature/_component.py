# SPDX-License-Identifier: Apache-2.0
"""Components of an application as Python sees them: what they declare are attributes."""
from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from armature import _native
from armature._members import (Event, Input, Operation, Output, Port, Property, Source, Wait, member_doc)
from armature._values import suggestion


class RunningComponent:
    """A component of a running application.

    A property is an attribute with its value, which can be set; ports, operations and events are
    attributes that have a value, are called, or count. Of a name that is a method of this class too,
    `component["state"]` is the component's own.
    """

    _source: Source
    _name: str
    _wait: Wait
    _members: Mapping[str, Property | Port | Operation | Event]

    def __init__(self, source: Source, name: str, wait: Wait) -> None:
        set_own = super().__setattr__
        set_own("_source", source)
        set_own("_name", name)
        set_own("_wait", wait)
        about = source.describe(name, False)
        set_own("_model", about.model)
        members: dict[str, Property | Port | Operation | Event] = {}
        for event in about.events:
            members[event.name] = Event(source, name, event, wait)
        for operation in about.operations:
            members[operation.name] = Operation(source, name, operation, wait)
        for output in about.outputs:
            members[output.name] = Output(source, name, output)
        for input_port in about.inputs:
            members[input_port.name] = Input(source, name, input_port)
        for one in about.properties:
            members[one.name] = Property(source, name, one)
        set_own("_members", members)
        set_own("__doc__", _component_doc(about))

    _model: str

    @property
    def name(self) -> str:
        """As its deployment says."""
        return self._name

    @property
    def model(self) -> str:
        """The model that it is of."""
        return self._model

    @property
    def state(self) -> str:
        """`Running`, `Stopped`, `Exception`, ..."""
        return self._source.describe(self._name, True).state

    @property
    def reason(self) -> str:
        """Why it does not run; may be empty."""
        return self._source.describe(self._name, True).reason

    @property
    def properties(self) -> Mapping[str, Property]:
        """By name."""
        return {name: one for name, one in self._members.items() if isinstance(one, Property)}

    @property
    def ports(self) -> Mapping[str, Port]:
        """By name: inputs and outputs."""
        return {name: one for name, one in self._members.items() if isinstance(one, Port)}

    @property
    def operations(self) -> Mapping[str, Operation]:
        """Its operations and commands."""
        return {name: one for name, one in self._members.items() if isinstance(one, Operation)}

    @property
    def events(self) -> Mapping[str, Event]:
        """By name."""
        return {name: one for name, one in self._members.items() if isinstance(one, Event)}

    def start(self) -> None:
        """Raises Refusal, as do the functions below."""
        self._source.change(self._name, "start")

    def stop(self) -> None:
        """One that holds something may be on its way to the stop then."""
        self._source.change(self._name, "stop")

    def reset(self) -> None:
        """From `Exception` to `Stopped`."""
        self._source.change(self._name, "reset")

    def recover(self) -> None:
        """From a run-time error back to `Running`."""
        self._source.change(self._name, "recover")

    def cleanup(self) -> None:
        """The next start configures it anew."""
        self._source.change(self._name, "cleanup")

    def __getitem__(self, name: str) -> Property | Port | Operation | Event:
        try:
            return self._members[name]
        except KeyError:
            raise KeyError(self._unknown(name)) from None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._members:
            raise AttributeError(self._unknown(name), name=name, obj=self)
        member = self._members[name]
        return member.value if isinstance(member, Property) else member

    def __setattr__(self, name: str, value: object) -> None:
        if name not in self._members:
            raise AttributeError(self._unknown(name), name=name, obj=self)
        self._source.write(self._name, name, value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._members]

    def _unknown(self, name: str) -> str:
        return f"'{self._name}' has no property, port, operation or event '{name}'" + suggestion(
            name, list(self._members))

    def __repr__(self) -> str:
        return f"<{self._model} {self._name}: {', '.join(self._members)}>"


class Components(Mapping[str, RunningComponent]):
    """The components of an application by their names, in the order of the deployment."""

    def __init__(self, source: Source, wait: Wait) -> None:
        self._source = source
        self._wait = wait
        self._names = source.component_names()
        self._known: dict[str, RunningComponent] = {}

    def __getitem__(self, name: str) -> RunningComponent:
        if name not in self._known:
            if name not in self._names:
                raise KeyError(f"there is no component '{name}'" + suggestion(name, self._names))
            self._known[name] = RunningComponent(self._source, name, self._wait)
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<Components {', '.join(self._names)}>"


class Group:
    """The parts of a composite: `app.Head.Left` is the component `Head.Left`."""

    def __init__(self, components: Components, prefix: str) -> None:
        self._components = components
        self._prefix = prefix

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return find(self._components, f"{self._prefix}.{name}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_next_parts(self._components, self._prefix + ".")]

    def __repr__(self) -> str:
        return f"<Group {self._prefix}: {', '.join(_next_parts(self._components, self._prefix + '.'))}>"


class Face:
    """What has components as attributes and items."""

    def __init__(self, components: Components) -> None:
        self._components = components

    @property
    def components(self) -> Mapping[str, RunningComponent]:
        return self._components

    def __getitem__(self, name: str) -> RunningComponent:
        return self._components[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return find(self._components, name)

    def __setattr__(self, name: str, value: object) -> None:
        if not name.startswith("_") and not hasattr(type(self), name):
            find(self._components, name)  # or says which name is near
            raise AttributeError(f"the component '{name}' cannot be set: set a property of it", name=name, obj=self)
        super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_next_parts(self._components, "")]


def find(components: Components, name: str) -> RunningComponent | Group:
    """The component or composite of that name; AttributeError."""
    if any(one.startswith(name + ".") for one in components):
        return Group(components, name)
    try:
        return components[name]
    except KeyError as missing:
        raise AttributeError(missing.args[0]) from None


def _next_parts(components: Components, prefix: str) -> list[str]:
    rests = (name[len(prefix):] for name in components if name.startswith(prefix))
    return list(dict.fromkeys(rest.split(".")[0] for rest in rests))


def _component_doc(about: _native.ComponentDescription) -> str:
    lines = [f"{about.name}, a {about.model}"]
    lines += _section("Properties", {one.name: member_doc(one) for one in about.properties})
    lines += _section("Inputs", {one.name: member_doc(one) for one in about.inputs})
    lines += _section("Outputs", {one.name: member_doc(one) for one in about.outputs})
    lines += _section("Operations", {one.name: f"{one.signature}: {one.doc}" for one in about.operations})
    lines += _section("Events", {one.name: f"{one.signature}: {one.doc}" for one in about.events})
    return "\n".join(lines)


def _section(title: str, members: Mapping[str, str]) -> list[str]:
    if not members:
        return []
    return ["", title, *(f"    {name}  {doc}" for name, doc in members.items())]
