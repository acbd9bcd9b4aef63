# SPDX-License-Identifier: Apache-2.0
"""Recordings become arrays, with units and what was lost."""
import json
import shutil

import numpy as np
import pytest

import armature


@pytest.fixture(scope="module")
def folder(tmp_path_factory, janus_file):
    folder = tmp_path_factory.mktemp("run")
    with armature.load(janus_file).application(record=folder) as app:
        app.run_for(0.1)
        app.Arming.arm()
        app.Generator.moveTo([1.0, 0.5], 1.0)
    return folder


def test_without_a_reporter_all_outputs_are_recorded(folder):
    recording = armature.read_recording(folder)
    assert isinstance(recording, armature.Recording)
    assert recording.complete and recording.file == str(folder / "run.mcap")
    assert {"PID1.Out", "Sensor.sensor", "Joint1.VoltageActuator"} <= set(recording)
    assert repr(recording) == f"<Recording {folder}/run.mcap: {len(recording)} channels>"


def test_what_is_recorded_may_be_said(tmp_path, janus_file):
    deployment = armature.load(janus_file)
    with deployment.application(record=tmp_path, what=["PID*.Ref", "PID1.Kp"]) as app:
        app.run_for(0.1)
    assert sorted(armature.read_recording(tmp_path)) == ["PID1.Kp", "PID1.Ref", "PID2.Ref"]
    with pytest.raises(armature.DeploymentError, match="PIDD"):
        deployment.application(record=tmp_path, what=["PIDD.Out"])
    with pytest.raises(ValueError, match="needs a folder"):
        deployment.application(what=["PID1.Out"])


def test_numbers_are_arrays_over_time(folder):
    out = armature.read_recording(folder / "run.mcap")["PID1.Out"]
    assert isinstance(out, armature.Samples)
    assert (out.name, out.unit, out.type, out.dropped) == ("PID1.Out", "V", "double", 0)
    assert out.times.dtype == out.values.dtype == np.float64 and out.times.shape == out.values.shape == (len(out),)
    np.testing.assert_allclose(np.diff(out.times), 0.01, atol=1e-6)
    assert np.abs(out.values).max() > 0.1
    assert out.doc and repr(out) == f"<Samples PID1.Out [V]: {len(out)} of double>"


def test_lists_have_a_column_for_each_element(folder):
    recording = armature.read_recording(folder)
    sensor = recording["Sensor.sensor"].values
    assert sensor.shape[1:] == (4,)
    np.testing.assert_allclose(sensor[-1, :2], [1.0, 0.5], atol=0.02)
    np.testing.assert_allclose(sensor[-1, 0], recording["Joint1.Position"].values[-1], atol=0.02)
    assert recording["Joint1.Armed"].values.dtype == np.bool_


def test_an_unknown_channel_is_told_with_the_nearest(folder):
    recording = armature.read_recording(folder)
    with pytest.raises(KeyError, match="did you mean 'PID1.Out'"):
        recording["PID1.Ou"]
    assert "PID1.Ou" not in recording and recording.get("PID1.Ou") is None


def test_a_deployment_s_own_reporter_stands(tmp_path, janus_file):
    demo = janus_file.parents[1] / "demo/pid.yaml"
    with armature.load(demo).application(record=tmp_path) as app:
        app.run_for(0.2)
    recording = armature.read_recording(tmp_path)
    assert recording.file.endswith("janus.mcap")
    assert list(recording["Joint1.PeerName"].values) == ["AIC1"]
    assert recording["AIC1.CountsPerTurn"].values[0] == 2000


def test_what_is_missing_between_two_samples_is_counted():
    from armature._recording import _missing
    assert _missing(np.array([1, 2, 3], np.uint32)) == 0
    assert _missing(np.array([1, 2, 5, 6], np.uint32)) == 2
    assert _missing(np.array([1, 11, 21, 41], np.uint32)) == 1  # every tenth is recorded
    assert _missing(np.array([7], np.uint32)) == _missing(np.array([], np.uint32)) == 0


def test_structs_become_structured_arrays():
    from armature._recording import _from_json
    pose = {"x": 1.5, "q": [1, 2], "at": {"ok": True}}
    values = _from_json([json.dumps(pose), json.dumps({**pose, "x": None})])
    assert values.dtype.names == ("x", "q", "at") and values["q"].shape == (2, 2)
    assert values["x"][0] == 1.5 and np.isnan(values["x"][1]) and values["at"]["ok"].all()
    uneven = _from_json(['{"q": [1]}', '{"q": [1, 2]}'])
    assert uneven.dtype == object and uneven[1] == {"q": [1, 2]}
    assert list(_from_json(['{"value": "idle"}'])) == ["idle"]
    assert len(_from_json([])) == 0


def test_lists_of_what_json_tells_are_arrays_with_a_column_for_each_element():
    from armature._recording import _from_json

    def read(*values):
        return _from_json([json.dumps({"value": value}) for value in values])

    np.testing.assert_array_equal(read([1.5, 2, 3], [4, None, 6]), [[1.5, 2, 3], [4, np.nan, 6]])
    np.testing.assert_array_equal(read([True, False], [False, False]), [[True, False], [False, False]])
    texts = read(["a", "b"], ["c", "d"])
    assert texts.dtype == object and texts.tolist() == [["a", "b"], ["c", "d"]]
    poses = read([{"x": 1}, {"x": 2}], [{"x": 3}, {"x": 4}])
    assert poses.shape == (2, 2) and poses["x"].tolist() == [[1, 2], [3, 4]]
    assert read([], []).shape == (2, 0)
    uneven = read(["a"], ["a", "b"], [])
    assert uneven.dtype == object and uneven.tolist() == [["a"], ["a", "b"], []]
    deep = read([[1], [1, 2]], [[1], [3, 4]])
    assert deep.shape == (2,) and deep[1] == [[1], [3, 4]]


def test_lists_in_structs_are_neither_spread_nor_cut():
    from armature._recording import _from_json
    uneven = _from_json(['{"q": [1, 2, 3], "n": "a"}', '{"q": [5], "n": "b"}'])
    assert uneven.dtype == object and uneven[1] == {"q": [5], "n": "b"}
    even = _from_json(['{"names": ["a", "b"], "q": [1, 2]}', '{"names": ["c", "d"], "q": [3, 4]}'])
    assert even["names"].tolist() == [["a", "b"], ["c", "d"]] and even["q"].tolist() == [[1, 2], [3, 4]]


def test_large_whole_numbers_in_structs_keep_their_digits():
    from armature._recording import _from_json
    for large in (2**53 + 1, -(2**63), 2**64 - 1):
        values = _from_json([json.dumps({"time": large, "x": 1}), json.dumps({"time": 1, "x": 2.5})])
        assert values["time"].tolist() == [large, 1] and values["x"].tolist() == [1.0, 2.5]
    assert _from_json(['{"a": 18446744073709551615}', '{"a": -1}'])["a"].tolist() == [2**64 - 1, -1]


def test_an_array_port_of_a_robot_is_recorded_as_it_was(tmp_path, janus_file):
    wam = janus_file.parents[2] / "wam/deployments/computed_torque4.yaml"
    with armature.load(wam).application(record=tmp_path, what=["WAM.gravity"]) as app:
        app.run_for(0.02)
    gravity = armature.read_recording(tmp_path)["WAM.gravity"]
    assert gravity.type == "array<double,3>" and gravity.values.dtype == np.float64
    np.testing.assert_allclose(gravity.values, np.tile([0.0, 0.0, -9.81], (len(gravity), 1)), atol=0.01)


def test_a_recording_that_was_cut_off_is_read_as_far_as_it_is_whole(folder, tmp_path):
    content = (folder / "run.mcap").read_bytes()
    (tmp_path / "run.mcap").write_bytes(content[:len(content) // 2])
    recording = armature.read_recording(tmp_path)
    assert not recording.complete and "cut off" in repr(recording)
    assert 0 < len(recording["PID1.Out"]) < len(armature.read_recording(folder)["PID1.Out"])


def test_where_there_is_no_recording_or_too_many_an_error_says_so(folder, tmp_path):
    with pytest.raises(armature.Error, match="has no recording"):
        armature.read_recording(tmp_path)
    (tmp_path / "wrong.mcap").write_bytes(b"this is none")
    with pytest.raises(armature.Error, match="wrong.mcap"):
        armature.read_recording(tmp_path)
    shutil.copy(folder / "run.mcap", tmp_path)
    with pytest.raises(armature.Error, match="run.mcap, wrong.mcap"):
        armature.read_recording(tmp_path)
