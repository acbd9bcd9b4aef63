# SPDX-License-Identifier: Apache-2.0
"""Components in Python, for simulations and tools.

    from armature.author import Component, Input, Output, Property

    class Ramp(Component):
        "Rises without end."
        slope = Property(1.0, unit="rad/s", doc="how fast", changeable_while_running=True)
        out = Output(float, unit="rad", doc="where it is")

        def update(self) -> None:
            self.out = self.slope * self.time

    armature.load("ramp.yaml", components=[Ramp])

In the deployment the model has the name of its class. Such a component never runs in a real-time
thread: the check refuses it, and applications here are simulated.
"""
from __future__ import annotations

import inspect
from typing import Any, Generic, TypeVar, overload

from armature import _native

T = TypeVar("T")
_TYPES: dict[Any, str] = {bool: "bool", int: "int", float: "float", str: "str", list: "list"}


class _Declared(Generic[T]):
    """A member of a component's class, whose value is its component's."""

    def __init__(self, type: Any, unit: str, doc: str) -> None:
        if type not in _TYPES:
            raise TypeError(f"a property or port is a bool, int, float, str or list, found {type!r}")
        self._type = _TYPES[type]
        self._unit = unit
        self._doc = doc
        self.__doc__ = f"{self._type}{f' [{unit}]' if unit else ''}: {doc}"

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def _declare(self, model: _native.Model) -> None:
        raise NotImplementedError


class Property(_Declared[T]):
    """A configuration value: `gain = Property(1.0, unit="V/rad", doc="proportional gain")`.

    initial: says its type: bool, int, float, str, or a list of floats.
    """

    def __init__(self, initial: T, *, unit: str = "", doc: str = "", range: tuple[float, float] | None = None,
                 changeable_while_running: bool = False) -> None:
        super().__init__(type(initial), unit, doc)
        if range is not None and not range[0] <= initial <= range[1]:  # type: ignore[operator]  # numbers have ranges
            raise ValueError(f"the initial value {initial!r} is not in the range from {range[0]!r} to {range[1]!r}")
        self._initial = initial
        self._range = range
        self._changeable = changeable_while_running

    @overload
    def __get__(self, instance: None, owner: type) -> Property[T]: ...
    @overload
    def __get__(self, instance: Component, owner: type) -> T: ...
    def __get__(self, instance: Component | None, owner: type) -> Property[T] | T:
        if instance is None:
            return self
        value: T = instance._host.get(self._name)
        return value

    def __set__(self, instance: Component, value: T) -> None:
        instance._host.set(self._name, value)

    def _declare(self, model: _native.Model) -> None:
        model.add_property(self._name, self._type, self._unit, self._doc, self._initial, self._range,
                           self._changeable)


class _DeclaredPort(_Declared[T]):
    def __init__(self, type: type[T], unit: str, doc: str, size: int) -> None:
        super().__init__(type, unit, doc)
        if self._type == "str":
            raise TypeError("data on ports never grows: a port is a bool, int, float or list")
        if (self._type == "list") != (size > 0):
            raise TypeError("a port that is a list, and no other, says its `size`")
        self._size = size


class Input(_DeclaredPort[T]):
    """What others write: `reference = Input(float, unit="rad", doc="wanted position")`.

    Its value is the newest one, None as long as there is none. A list arrives as a numpy array.
    triggers: what arrives runs `update`, in the thread of who wrote it.
    size: of a list: how many elements it has.
    """

    def __init__(self, type: type[T], *, unit: str = "", doc: str = "", size: int = 0, triggers: bool = False,
                 may_stay_open: bool = False) -> None:
        super().__init__(type, unit, doc, size)
        self._triggers = triggers
        self._may_stay_open = may_stay_open

    @overload
    def __get__(self, instance: None, owner: type) -> Input[T]: ...
    @overload
    def __get__(self, instance: Component, owner: type) -> T | None: ...
    def __get__(self, instance: Component | None, owner: type) -> Input[T] | T | None:
        if instance is None:
            return self
        value: T | None = instance._host.get(self._name)
        return value

    def _declare(self, model: _native.Model) -> None:
        model.add_port("input", self._name, self._type, self._unit, self._doc, self._size, self._triggers,
                       self._may_stay_open)


class Output(_DeclaredPort[T]):
    """What it writes: an assignment, `self.out = 0.5`, tells the readers.

    size: of a list: how many elements it has.
    """

    def __init__(self, type: type[T], *, unit: str = "", doc: str = "", size: int = 0) -> None:
        super().__init__(type, unit, doc, size)

    @overload
    def __get__(self, instance: None, owner: type) -> Output[T]: ...
    @overload
    def __get__(self, instance: Component, owner: type) -> T: ...
    def __get__(self, instance: Component | None, owner: type) -> Output[T] | T:
        if instance is None:
            return self
        value: T = instance._host.get(self._name)
        return value

    def __set__(self, instance: Component, value: T) -> None:
        instance._host.set(self._name, value)

    def _declare(self, model: _native.Model) -> None:
        model.add_port("output", self._name, self._type, self._unit, self._doc, self._size, False, False)


class Component:
    """The base of components in Python. Hooks are overridden as needed; one that raises an exception
    faults its component, with the traceback in the log, and nothing else. From `configure` and `start`
    it is a refusal. Properties and ports are there in `__init__` and in hooks; in a thread that it begins they are
    refused."""

    _host: _native.Host

    @property
    def name(self) -> str:
        """Its name in the application."""
        return self._host.name

    @property
    def time(self) -> float:
        """The time of the cycle [s]."""
        return self._host.time

    @property
    def period(self) -> float:
        """With which it is updated [s]; 0 if that is not known."""
        return self._host.period

    def log(self, text: str, level: str = "info") -> None:
        """A line of the application's log: `debug`, `info`, `warning` or `error`."""
        self._host.log(level, text)

    def configure(self) -> None:
        """Properties have their values."""

    def start(self) -> None:
        """Just before the first update."""

    def update(self) -> None:
        """Once in each cycle, or whenever an input triggers it."""

    def stop(self) -> None:
        """After the last update."""

    def cleanup(self) -> None:
        """The next start configures it anew."""

    @classmethod
    def _model(cls) -> _native.Model:
        """The class as a model, with its members in the order of declaration, bases first."""
        model = _native.Model(cls.__name__, inspect.getdoc(cls) or "", cls._made)
        members = {name: one for base in reversed(cls.__mro__) for name, one in vars(base).items()}
        for one in members.values():
            if isinstance(one, _Declared):
                one._declare(model)
        return model

    @classmethod
    def _made(cls, host: _native.Host) -> Component:
        made = cls.__new__(cls)
        made._host = host
        made.__init__()  # type: ignore[misc]  # it may use its properties
        return made
