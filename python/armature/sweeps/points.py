# SPDX-License-Identifier: Apache-2.0
"""Which points of a parameter space are run: grids, random points, low-discrepancy points, lists.

A point is a mapping of names to values, as `armature.load(..., set=point)` takes it. The same call
gives the same points on every machine.
"""
from __future__ import annotations

import itertools
import math
import random as _random
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

Value = Any  # a number, a bool, a text, or a list of them: what a property takes
Point = dict[str, Value]


class PointsError(ValueError):
    """Parameters that describe no points; the text names the parameter and what it needs."""


def grid(axes: Mapping[str, Sequence[Value]]) -> list[Point]:
    """All combinations of the values of each axis; the last axis changes fastest.

    `grid({"PID1.Kp": [200, 400], "PID1.Kd": [100, 200]})` has four points.
    """
    lists = {name: _values_of(name, values) for name, values in axes.items()}
    return [dict(zip(lists, values)) for values in itertools.product(*lists.values())]


def _values_of(name: str, values: Any) -> list[Value]:
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise PointsError(f"axis '{name}' must be a list of values, found {values!r}")
    listed_values = list(values)  # of an iterator all at once: it gives them but once
    if not listed_values:
        raise PointsError(f"axis '{name}' has no values (give it at least one)")
    return listed_values


def random(
    ranges: Mapping[str, tuple[float, float]],
    count: int,
    *,
    seed: int,
    logarithmic: bool = False,
) -> list[Point]:
    """`count` points, each value drawn evenly from its range [low, high].

    With `logarithmic`, each decade of a range has the same share: for gains, whose range spans
    decades.
    """
    _check_ranges(ranges, count, logarithmic)
    draw = _random.Random(seed)
    return [
        {name: _between(ends, draw.random(), logarithmic) for name, ends in ranges.items()}
        for _ in range(count)
    ]


def sobol(
    ranges: Mapping[str, tuple[float, float]],
    count: int,
    *,
    seed: int,
    logarithmic: bool = False,
) -> list[Point]:
    """As `random`, from scipy's scrambled Sobol sequence, which leaves no large gaps.

    A `count` that is a power of two covers the ranges evenly.
    """
    from scipy.stats import qmc  # type: ignore[import]

    _check_ranges(ranges, count, logarithmic)
    if count == 0:
        return []
    sampler = qmc.Sobol(len(ranges), seed=seed)
    shares = sampler.random_base2(math.ceil(math.log2(count)))[:count]
    return [
        {
            name: _between(ends, float(share), logarithmic)
            for (name, ends), share in zip(ranges.items(), row)
        }
        for row in shares
    ]


def listed(parameters: Mapping[str, Sequence[Value]] | Iterable[Mapping[str, Value]]) -> list[Point]:
    """The points of what `armature.sweep` is given: the axes of a grid, or the points themselves.

    Points may name different parameters: what one does not name is as the deployment has it.
    """
    if isinstance(parameters, Mapping):
        return grid(parameters)
    return [dict(point) for point in parameters]


def _check_ranges(
    ranges: Mapping[str, tuple[float, float]], count: int, logarithmic: bool
) -> None:
    if count < 0:
        raise PointsError(f"the number of points must be 0 or more, found {count}")
    for name, (low, high) in ranges.items():
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise PointsError(
                f"the range of '{name}' must be two finite numbers, the lower one first, "
                f"found {low}, {high}"
            )
        if logarithmic and low <= 0:
            raise PointsError(
                f"the range of '{name}' must begin above 0 to be logarithmic, found {low}"
            )


def _between(ends: tuple[float, float], share: float, logarithmic: bool) -> float:
    low, high = ends
    if logarithmic:
        return float(low * (high / low) ** share)
    return low + (high - low) * share
