# SPDX-License-Identifier: Apache-2.0
"""Recordings of runs as numpy arrays."""
from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from armature import _native
from armature._values import suggestion

Array = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class Samples:
    """What was recorded of a port or property; n samples, in the order of writing."""

    name: str  # `PID1.Out`
    type: str  # `double`, `vector<double>`, ...
    unit: str
    doc: str
    times: npt.NDArray[np.float64]  # [n], cycle times in s
    # [n]; [n, k] of lists; structured of structs; of texts and enumerations `str`; of lists whose sizes
    # differ, and of structs with such lists, objects. Numbers in structs are float64, int64 or uint64
    # where whole numbers are above 2**53.
    values: Array
    # How many writes between the first and the last sample are missing, by their numbers: what did not
    # fit into the Reporter's buffer, and what its `on_change` leaves out.
    dropped: int

    def __len__(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        unit = f" [{self.unit}]" if self.unit else ""
        lost = f", {self.dropped} dropped" if self.dropped else ""
        return f"<Samples {self.name}{unit}: {len(self)} of {self.type}{lost}>"


class Recording(Mapping[str, Samples]):
    """A recording: its channels by their names, `recording["PID1.Out"]`, in the order of the file."""

    def __init__(self, file: str) -> None:
        channels, complete = _native.load_recording(file)
        self._file = file
        self._complete = complete
        self._samples = {channel["name"]: _samples_of(channel) for channel in channels}

    @property
    def file(self) -> str:
        """The MCAP file that was read."""
        return self._file

    @property
    def complete(self) -> bool:
        """False: the file was cut off, and this is what is whole of it."""
        return self._complete

    def __getitem__(self, name: str) -> Samples:
        try:
            return self._samples[name]
        except KeyError:
            near = suggestion(name, list(self._samples))
            raise KeyError(f"'{name}' was not recorded{near}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._samples)

    def __len__(self) -> int:
        return len(self._samples)

    def __repr__(self) -> str:
        cut_off = "" if self._complete else ", cut off"
        return f"<Recording {self._file}: {len(self)} channels{cut_off}>"


def read_recording(path: str | os.PathLike[str]) -> Recording:
    """Reads the recording of a run: its folder, or an MCAP file. All of it has to fit into memory.

    Raises Error if there is none, if there are several to choose from, or if it is damaged.
    """
    place = Path(path)
    return Recording(str(_recording_in(place) if place.is_dir() else place))


def _recording_in(folder: Path) -> Path:
    files = sorted(folder.glob("*.mcap"))
    # Black boxes are recordings of faults, for who wants them by their names.
    recordings = [file for file in files if not file.name.startswith("blackbox-")] or files
    if not recordings:
        raise _native.Error(f"'{folder}' has no recording, a file `*.mcap`: give `application` a folder "
                            "by `record`, or the deployment a Reporter")
    if len(recordings) > 1:
        names = ", ".join(file.name for file in recordings)
        raise _native.Error(f"'{folder}' has several recordings: name one of {names}")
    return recordings[0]


def _samples_of(channel: Mapping[str, Any]) -> Samples:
    values = channel["values"]
    if channel["json"]:
        values = _from_json(values)
    elif isinstance(values, list):
        values = _objects(values)
    return Samples(channel["name"], channel["type"], channel["unit"], channel["doc"], channel["times"], values,
                   _missing(channel["numbers"]))


def _missing(numbers: npt.NDArray[np.uint32]) -> int:
    steps = np.diff(numbers.astype(np.int64))
    steps = steps[steps > 0]
    if not len(steps):
        return 0
    # A Reporter that records every n-th sample only has steps of n.
    return int(np.sum(steps // steps.min() - 1))


def _from_json(texts: list[str]) -> Array:
    # A struct is an object itself, anything else the member `value` of one.
    parsed = [json.loads(text) for text in texts]
    values = [one["value"] if set(one) == {"value"} else one for one in parsed]
    if not values:
        return np.array([])
    try:
        return _stacked(values)
    except TypeError:
        return _objects(values)


def _stacked(values: list[Any]) -> Array:
    """[n] of scalars and structs, [n, k] of lists; TypeError if they are not all of one form."""
    if all(isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.bool_)
    if all(value is None or isinstance(value, (int, float)) for value in values):
        return _numbers(values)
    if all(isinstance(value, str) for value in values):
        return _objects(values)
    if all(isinstance(value, list) for value in values):
        return _lists(values)
    if all(isinstance(value, dict) and value.keys() == values[0].keys() for value in values):
        return _structs(values)
    raise TypeError("values of several forms")


def _numbers(values: list[Any]) -> Array:
    if any(isinstance(value, bool) for value in values):
        raise TypeError("numbers and booleans")
    # JSON does not tell 1 from 1.0, and nan is null. Whole numbers that a float does not tell from
    # their neighbours stay what they are.
    whole = all(isinstance(value, int) for value in values)
    if whole and any(abs(value) > 2**53 for value in values):
        return np.array(values, dtype=_whole_type(min(values), max(values)))
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)


def _whole_type(least: int, most: int) -> Any:
    if -(2**63) <= least and most < 2**63:
        return np.int64
    return np.uint64 if 0 <= least and most < 2**64 else object


def _lists(values: list[Any]) -> Array:
    count = len(values[0])
    if any(len(value) != count for value in values):
        raise TypeError("lists of several sizes")
    if count == 0:
        return np.empty((len(values), 0))
    elements = _stacked([element for value in values for element in value])
    return elements.reshape((len(values), count) + elements.shape[1:])


def _structs(values: list[Any]) -> Array:
    fields = {name: _stacked([value[name] for value in values]) for name in values[0]}
    made = np.empty(len(values), dtype=[(name, one.dtype, one.shape[1:]) for name, one in fields.items()])
    for name, one in fields.items():
        made[name] = one
    return made


def _objects(values: list[Any]) -> Array:
    made = np.empty(len(values), dtype=object)
    for i, value in enumerate(values):  # numpy would take lists of equal sizes apart
        made[i] = value
    return made
