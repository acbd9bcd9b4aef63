# SPDX-License-Identifier: Apache-2.0
"""Values as text: that of deployments, and that of other processes."""
import numpy as np
import pytest

import armature
from armature._values import Fields, Struct, from_text, to_text, to_yaml

FIELDS = Fields(Pose={"x": "double", "q": "vector<double>", "name": "text"}, Way={"to": "Pose", "n": "int32"})


@pytest.mark.parametrize("text, type, value", [
    ("0.5", "double", 0.5), ("nan", "double", float("nan")), ("-3", "int64", -3), ("true", "bool", True),
    ("false", "bool", False), ("catch_up", "Overrun", "catch_up"), ("a, b", "text", "a, b")])
def test_scalars_are_read(text, type, value):
    np.testing.assert_equal(from_text(text, type, FIELDS), value)


def test_lists_and_structs_are_read():
    np.testing.assert_array_equal(from_text("[1, 2.5]", "vector<double>", FIELDS), [1.0, 2.5])
    assert from_text("[3, 4]", "array<uint8,2>", FIELDS).tolist() == [3, 4]
    assert from_text('["a, b", "c\\"d"]', "vector<text>", FIELDS) == ["a, b", 'c"d']
    way = from_text('{to: {x: 1, q: [2, 3], name: "n: {"}, n: 4}', "Way", FIELDS)
    assert isinstance(way, armature.Struct)
    assert (way.to.x, way.to.q.tolist(), way.to.name, way.n) == (1.0, [2.0, 3.0], "n: {", 4)
    assert [one.n for one in from_text("[{to: {x: 1, q: [], name: \"\"}, n: 1}]", "vector<Way>", FIELDS)] == [1]


@pytest.mark.parametrize("value, text", [
    (200, "200"), (0.1, "0.1"), (True, "true"), (np.float32(0.5), "0.5"), (np.int8(3), "3"), (np.bool_(False), "false"),
    ([1, 2.5], "[1, 2.5]"), (np.array([1.0, 2.0]), "[1.0, 2.0]"), ("12 V", "12 V"), (("a", 'b"c'), '["a", "b\\"c"]'),
    ({"x": 1, "q": [2]}, "{x: 1, q: [2]}")])
def test_values_are_written(value, text):
    assert to_text(value) == to_yaml(value) == text


def test_what_is_no_number_is_written_as_its_reader_has_it():
    assert to_text([float("nan"), float("-inf")]) == "[nan, -inf]"
    assert to_yaml([float("nan"), float("inf")]) == "[.nan, .inf]"


def test_structs_are_dicts_whose_fields_are_attributes():
    pose = Struct(x=1.0, y=2.0)
    pose.x = 3.0
    assert pose["x"] == pose.x == 3.0 and {"x", "y"} <= set(dir(pose))
    assert repr(pose) == "Struct(x=3.0, y=2.0)"
    with pytest.raises(AttributeError, match="x, y"):
        pose.z = 1.0
