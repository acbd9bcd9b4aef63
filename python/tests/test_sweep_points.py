# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from armature.sweeps.points import PointsError, grid, listed, random, sobol


def test_a_grid_has_all_combinations_and_its_last_axis_changes_fastest():
    points = grid({"a": [1, 2], "b": ["x", "y", "z"]})
    assert [tuple(point.values()) for point in points] == [
        (1, "x"), (1, "y"), (1, "z"), (2, "x"), (2, "y"), (2, "z")]  # fmt: skip


def test_an_axis_is_a_list_with_values():
    with pytest.raises(PointsError, match="axis 'a' has no values"):
        grid({"a": []})
    with pytest.raises(PointsError, match="axis 'a' must be a list of values, found 3"):
        grid({"a": 3})
    with pytest.raises(PointsError, match="axis 'a' must be a list of values, found 'text'"):
        grid({"a": "text"})


def test_an_axis_may_be_given_once_only():
    assert grid({"a": (x for x in (1, 2)), "b": iter("xy")}) == grid({"a": [1, 2], "b": ["x", "y"]})


def test_random_points_are_those_of_their_seed_and_within_their_ranges():
    ranges = {"a": (-1.0, 1.0), "b": (10.0, 20.0)}
    points = random(ranges, 50, seed=4)
    assert points == random(ranges, 50, seed=4)
    assert points != random(ranges, 50, seed=5)
    assert all(-1 <= point["a"] <= 1 and 10 <= point["b"] <= 20 for point in points)


def test_logarithmic_points_give_each_decade_its_share():
    points = random({"k": (1.0, 1000.0)}, 3000, seed=1, logarithmic=True)
    decades = [sum(int(math.log10(point["k"])) == decade for point in points) for decade in range(3)]
    assert all(850 < count < 1150 for count in decades)


def test_sobol_points_leave_no_half_of_a_range_out():
    pytest.importorskip("scipy")
    points = sobol({"a": (0.0, 1.0), "b": (0.0, 1.0)}, 16, seed=2)
    assert points == sobol({"a": (0.0, 1.0), "b": (0.0, 1.0)}, 16, seed=2)
    for a_half in (False, True):
        for b_half in (False, True):
            quarter = [p for p in points if (p["a"] >= 0.5) == a_half and (p["b"] >= 0.5) == b_half]
            assert len(quarter) == 4
    assert len(sobol({"a": (0.0, 1.0)}, 5, seed=2)) == 5
    assert sobol({"a": (0.0, 1.0)}, 0, seed=2) == []


@pytest.mark.parametrize("make", [random, sobol])
def test_ranges_are_two_numbers_in_order(make):
    pytest.importorskip("scipy")
    with pytest.raises(PointsError, match="'a' must be two finite numbers, the lower one first"):
        make({"a": (2.0, 1.0)}, 4, seed=0)
    with pytest.raises(PointsError, match="'a' must begin above 0 to be logarithmic, found 0"):
        make({"a": (0, 1.0)}, 4, seed=0, logarithmic=True)
    with pytest.raises(PointsError, match="number of points must be 0 or more, found -1"):
        make({"a": (0, 1.0)}, -1, seed=0)


def test_a_mapping_is_a_grid_and_anything_else_is_its_points():
    assert listed({"a": [1, 2]}) == [{"a": 1}, {"a": 2}]
    assert listed(iter([{"a": 1}])) == [{"a": 1}]
    assert listed([{"a": 1}, {"b": 2}]) == [{"a": 1}, {"b": 2}]
