# SPDX-License-Identifier: Apache-2.0
"""Values of described types in Python, and as the text that files and other processes have."""
from __future__ import annotations

import math
from collections.abc import Mapping
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


def to_text(value: object) -> str:
    """`value` as a deployment file has it; a `str` is taken as it is written: `"12 V"`, `"[1, 2]"`."""
    if isinstance(value, str):
        return value
    return _nested_text(value)


def _nested_text(value: object) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return _number_text(float(value))
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{name}: {_nested_text(part)}" for name, part in value.items()) + "}"
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_nested_text(part) for part in value) + "]"
    raise ValueError(f"a value is a number, a text, a list or a mapping, found {value!r}")


def _number_text(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    return repr(value)
