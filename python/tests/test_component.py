# SPDX-License-Identifier: Apache-2.0
"""Components of a running application: what they declare are attributes."""
import pydoc

import numpy as np
import pytest

import armature
from armature import Command, CommandError, Event, Input, Operation, Output, Port, Property, RunningComponent, author


def test_components_are_attributes_and_items_in_the_order_of_the_deployment(janus):
    assert isinstance(janus.PID1, RunningComponent)
    assert janus.PID1 is janus["PID1"] is janus.components["PID1"]
    assert list(janus.components)[:2] == ["Sampler", "Arming"] and len(janus.components) == 15
    assert (janus.PID1.name, janus.PID1.model, janus.PID1.state, janus.PID1.reason) == ("PID1", "PID", "Running", "")


def test_unknown_names_are_told_with_the_nearest(janus):
    with pytest.raises(AttributeError, match="did you mean 'PID1'"):
        janus.PID11
    with pytest.raises(KeyError, match="PID1"):
        janus["PID11"]
    with pytest.raises(AttributeError, match="'PID1' has no property.*did you mean 'Kp'"):
        janus.PID1.Kpp
    with pytest.raises(AttributeError, match="Kpp"):
        janus.PID1.Kpp = 1
    with pytest.raises(KeyError, match="Kpp"):
        janus.PID1["Kpp"]
    assert not hasattr(janus.PID1, "Kpp")


def test_a_property_is_its_value(janus):
    assert janus.PID1.Kp == 400.0
    janus.PID1.Kp = 200
    assert janus.PID1.Kp == 200.0
    kp = janus.PID1.properties["Kp"]
    assert isinstance(kp, Property) and kp is janus.PID1["Kp"]
    assert (kp.name, kp.value, kp.unit, kp.type, kp.doc) == ("PID1.Kp", 200.0, "V/rad", "double", "proportional gain")
    kp.value = 300
    assert repr(kp) == "<Property PID1.Kp = 300.0 V/rad>"
    assert kp.changeable_while_running
    assert janus.Joint1.properties["GearRatio"].range is None or len(janus.Joint1.properties["GearRatio"].range) == 2


def test_a_number_may_have_a_unit(janus):
    janus.PID1.Kp = "300 V/rad"
    assert janus.PID1.Kp == 300.0
    janus.PID1.Kp = "6 V/deg"
    assert janus.PID1.Kp == pytest.approx(6.0 * 180.0 / np.pi)
    with pytest.raises(ValueError, match="PID1.Kp"):
        janus.PID1.Kp = "3 m"


@pytest.mark.parametrize("wrong", [None, True, [1.0], {}, "fast"])
def test_a_value_of_another_kind_is_refused_with_what_was_expected(janus, wrong):
    with pytest.raises(ValueError, match="PID1.Kp"):
        janus.PID1.Kp = wrong
    assert janus.PID1.Kp == 400.0


def test_what_the_component_refuses_is_a_refusal(janus):
    with pytest.raises(armature.Refusal, match="PeerName"):
        janus.PID1.PeerName = "Joint1"


def test_what_has_no_value_is_not_set(janus):
    with pytest.raises(armature.Refusal, match="'Generator.moveTo' has no value: it is an operation"):
        janus.Generator.moveTo = 1
    with pytest.raises(armature.Refusal, match="'Arming.Stop' has no value: it is an event"):
        janus.Arming.Stop = 1
    with pytest.raises(AttributeError, match="did you mean 'PID2'"):
        janus.PIDD = 1
    with pytest.raises(AttributeError, match="'PID1' cannot be set"):
        janus.PID1 = 1


def test_enumerations_are_texts_and_lists_are_arrays(janus):
    assert janus.Cards.mode == "synchronous"
    with pytest.raises(ValueError, match="synchronous"):
        janus.Cards.mode = "sometimes"
    np.testing.assert_array_equal(janus.Generator.max_vel, [2.0])
    assert janus.Cards.cards.dtype.kind == "i" and list(janus.Cards.cards) == [1, 2]


def test_ports_have_values_units_and_ages(armed_janus):
    position = armed_janus.Joint1.Position
    assert isinstance(position, Output) and isinstance(position, Port)
    assert (position.name, position.unit, position.type) == ("Joint1.Position", "rad", "double")
    assert isinstance(position.value, float) and 0.0 <= position.age < 0.02
    assert position.peers == ["Sensor.Position1"] and position.doc
    assert isinstance(armed_janus.PID1.Ref, Input)
    assert armed_janus.Sensor.sensor.value.shape == (4,)
    assert repr(position).startswith("<Output Joint1.Position = ")
    assert set(armed_janus.PID1.ports) == {"Ref", "Sen", "Out"}
    with pytest.raises(armature.Refusal, match="only components write it"):
        armed_janus.PID1.Ref = 1.0


def test_a_port_that_nobody_wrote_has_no_value(janus_file):
    with armature.load(janus_file).application() as app:
        assert app.PID1.Out.value is None and app.PID1.Out.age is None


def test_structs_have_their_fields_as_attributes(armed_janus):
    effort = armed_janus.Joint1.VoltageActuator.value
    assert isinstance(effort, armature.Struct)
    assert effort.value == effort["value"]
    with pytest.raises(AttributeError, match="value"):
        effort.nothing


def test_commands_let_time_pass_until_they_have_ended(armed_janus):
    app = armed_janus
    move = app.Generator.moveTo
    assert isinstance(move, Operation) and move.is_command and move.name == "Generator.moveTo"
    assert "array" in move.signature or "vector" in move.signature
    begin = app.now
    assert move([0.5, 0.5], 1.0) is None
    assert app.now == pytest.approx(begin + 1.0, abs=0.05)
    assert app.Joint1.Position.value == pytest.approx(0.5, abs=0.05)


def test_a_command_can_be_begun_followed_and_cancelled(armed_janus):
    app = armed_janus
    command = app.Generator.moveTo.begin(np.array([1.0, 1.0]), 5.0)
    assert isinstance(command, Command) and not command.done and command.name == "Generator.moveTo"
    app.run_for(0.5)
    assert not command.done and 0.0 <= command.progress <= 1.0
    command.cancel()
    with pytest.raises(CommandError) as failed:
        command.wait()
    assert failed.value.command is command and command.done and not command.succeeded
    assert command.stage == "cancelled" and "cancelled" in repr(command) and isinstance(command.reason, str)


def test_a_command_that_does_not_end_in_time_is_an_error_and_goes_on(armed_janus):
    command = armed_janus.Generator.moveTo.begin([1.0, 1.0], 5.0)
    with pytest.raises(CommandError, match="has not ended within 0.5 s"):
        command.wait(limit=0.5)
    command.wait()
    assert command.succeeded and command.stage == "done"


def test_wrong_arguments_are_told_by_their_names(armed_janus):
    move = armed_janus.Generator.moveTo
    with pytest.raises(armature.Refusal, match="takes 2 arguments"):
        move([1.0, 1.0])
    with pytest.raises(ValueError, match="argument 1"):
        move("there", 1.0)
    with pytest.raises(TypeError, match="not a command"):
        armed_janus.PID1.operations["reset"].begin()


@pytest.mark.parametrize("wrong", [b"\x00\x01", bytearray(2), np.array([[1.0], [1.0]]), np.array(1.0), "\ud800"])
def test_what_is_no_list_of_numbers_is_refused(armed_janus, wrong):
    with pytest.raises(ValueError, match="argument 1"):
        armed_janus.Generator.moveTo.begin(wrong, 2)


def test_an_argument_may_have_a_unit(armed_janus):
    begin = armed_janus.now
    armed_janus.Generator.moveTo([0.1, 0.1], "500 ms")
    assert armed_janus.now == pytest.approx(begin + 0.5, abs=0.05)
    with pytest.raises(ValueError, match="argument 2"):
        armed_janus.Generator.moveTo([0.1, 0.1], "3 m")


def test_a_text_that_utf_8_cannot_say_is_refused(janus):
    with pytest.raises(ValueError, match="a text that UTF-8 can say"):
        janus.PID1.PeerName = "\ud800"


def test_operations_are_called(janus):
    reset = janus.PID1.operations["reset"]
    assert not reset.is_command and reset.doc
    assert reset() is None
    assert repr(reset) == "<Operation PID1.reset void()>"


def test_events_are_counted(armed_janus):
    arm, disarm = armed_janus.Arming.Arm, armed_janus.Arming.Disarm
    assert isinstance(arm, Event) and arm is armed_janus.Arming.events["Arm"]
    assert (arm.raised, disarm.raised) == (1, 0)
    assert (arm.name, arm.signature) == ("Arming.Arm", "void()") and arm.doc
    assert repr(arm) == "<Event Arming.Arm void()>"


def test_an_event_can_be_waited_for(armed_janus):
    app = armed_janus
    app.Arming.disarm()
    assert not app.Arming.Arm.wait(0.2)
    command = app.Arming.arm.begin()
    assert app.Arming.Arm.wait("2 s") and app.Arming.Arm.raised == 2
    command.wait()


def test_components_are_stopped_and_started(janus):
    janus.run_for(0.1)
    janus.BridgeRef.stop()
    assert janus.BridgeRef.state == "Stopped"
    janus.BridgeRef.start()
    assert janus.BridgeRef.state == "Running"
    janus.BridgeRef.stop()
    janus.BridgeRef.cleanup()
    for change in (janus.BridgeRef.reset, janus.BridgeRef.recover):
        with pytest.raises(armature.Refusal, match="BridgeRef"):
            change()


def test_completion_and_help_know_the_interface(janus):
    assert {"PID1", "Generator", "run_for"} <= set(dir(janus))
    assert {"Kp", "Out", "reset", "properties"} <= set(dir(janus.PID1))
    text = pydoc.plain(pydoc.render_doc(janus.PID1))
    assert "proportional gain" in janus.PID1.__doc__ and "[V/rad]" in janus.PID1.__doc__
    assert "PID" in text
    assert "moveTo" in janus.Generator.__doc__ and janus.Generator.moveTo.doc in janus.Generator.moveTo.__doc__
    assert repr(janus.PID1).startswith("<PID PID1: ")


class Wheel(author.Component):
    """Turns."""

    angle = author.Output(float, unit="rad", doc="where it is")

    def update(self) -> None:
        self.angle = self.time


def test_parts_of_composites_are_attributes_of_their_composite(tmp_path):
    file = tmp_path / "pair.yaml"
    file.write_text("""application: pair
composites:
  Pair:
    components:
      Left: {model: Wheel, activity: {periodic: 10 ms}}
      Right: {model: Wheel, activity: {periodic: 10 ms}}
components:
  Head: {model: Pair}
""")
    with armature.load(file, components=[Wheel]).application(record=tmp_path / "out") as app:
        app.run_for(0.1)
        assert app.Head.Left is app["Head.Left"]
        assert app.Head.Right.angle.value == pytest.approx(0.1)
        assert "Head" in dir(app) and {"Left", "Right"} <= set(dir(app.Head))
        assert repr(app.Head) == "<Group Head: Left, Right>"
        with pytest.raises(AttributeError, match="Head.Middle"):
            app.Head.Middle
    assert len(armature.read_recording(tmp_path / "out")["Head.Left.angle"]) > 5
