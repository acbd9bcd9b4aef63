# SPDX-License-Identifier: Apache-2.0
"""Values of described types in Python, and as the text that files and other processes have."""
from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np


class Struct(dict[str, Any]):
    """A value with fields, which are items and attributes: `value["x"]` is `value.x`."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no field '{name}': it has {', '.join(self)}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self:
            raise AttributeError(f"there is no field '{name}': it has {', '.join(self)}")
        self[name] = value

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __repr__(self) -> str:
        return "Struct(" + ", ".join(f"{name}={value!r}" for name, value in self.items()) + ")"


def to_yaml(value: object) -> str:
    """`value` as a deployment file has it; a `str` is taken as it is written: `"12 V"`, `"[1, 2]"`."""
    return value if isinstance(value, str) else _nested(value, {"nan": ".nan", "inf": ".inf", "-inf": "-.inf"})


def to_text(value: object) -> str:
    """`value` as other processes have it; a `str` is taken as it is written."""
    return value if isinstance(value, str) else _nested(value, {})


def _nested(value: object, special: Mapping[str, str]) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        text = repr(float(value))
        return special.get(text, text)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{name}: {_nested(part, special)}" for name, part in value.items()) + "}"
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_nested(part, special) for part in value) + "]"
    raise ValueError(f"a value is a number, a text, a list or a mapping, found {value!r}")


# A list, a struct, a text in quotes, or anything else: a number, a name.
_TOKENS = re.compile(r'\s*([\[\]{}:,]|"(?:[^"\\]|\\.)*"|[^\[\]{}:,"]+)')
_LIST = re.compile(r"(?:vector|array)<(.*?)(?:,\d+)?>")
_WHOLE = re.compile(r"u?int(8|16|32|64)")


class Fields(dict[str, dict[str, str]]):
    """The types of the fields of structs, by the names of the structs."""


def from_text(text: str, type: str, fields: Fields) -> Any:
    """What another process wrote of a value, by the name of its type."""
    is_list = _LIST.fullmatch(type)
    if not is_list and type not in fields:
        return _scalar(text, type)
    return _Reader(text, fields).read(type)


class _Reader:
    def __init__(self, text: str, fields: Fields) -> None:
        self._tokens = [match[1].strip() for match in _TOKENS.finditer(text)]
        self._at = 0
        self._fields = fields

    def read(self, type: str) -> Any:
        if is_list := _LIST.fullmatch(type):
            return self._list(is_list[1])
        if type in self._fields:
            return self._struct(self._fields[type])
        token = self._take()
        return json.loads(token) if token.startswith('"') else _scalar(token, type)

    def _list(self, element: str) -> Any:
        values = [self.read(element) for _ in self._items("[", "]")]
        return np.array(values) if _is_number(element) else values

    def _struct(self, types: Mapping[str, str]) -> Struct:
        made = Struct()
        for _ in self._items("{", "}"):
            name = self._take()
            self._take()  # the colon
            made.update({name: self.read(types[name])})
        return made

    def _items(self, begin: str, end: str) -> Iterator[None]:
        self._expect(begin)
        while self._tokens[self._at] != end:
            yield
            if self._tokens[self._at] == ",":
                self._at += 1
        self._expect(end)

    def _expect(self, token: str) -> None:
        if self._take() != token:
            raise ValueError(f"expected {token}")

    def _take(self) -> str:
        self._at += 1
        return self._tokens[self._at - 1]


def _is_number(type: str) -> bool:
    return type in ("bool", "float", "double") or _WHOLE.fullmatch(type) is not None


def _scalar(text: str, type: str) -> Any:
    if type == "bool":
        return text == "true"
    if type in ("float", "double"):
        return float(text)
    return int(text) if _WHOLE.fullmatch(type) else text


def suggestion(name: str, known: list[str]) -> str:
    """` (did you mean 'Kp'?)`, or nothing."""
    near = difflib.get_close_matches(name, known, 1)
    return f" (did you mean '{near[0]}'?)" if near else ""
