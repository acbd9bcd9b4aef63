# SPDX-License-Identifier: Apache-2.0
"""Components in Python: declared, connected, updated; a crash of one faults it and nothing else."""
import threading

import numpy as np
import pytest

import armature
from armature.author import Component, Input, Output, Property

DEPLOYMENT = """application: ramps
components:
  Ramp: {model: Ramp, activity: {periodic: 10 ms}}
  Other: {model: Ramp, activity: {periodic: 20 ms}, properties: {slope: 3}}
  Twice: {model: Twice}
connections: [Ramp.out -> Twice.ramp]
"""


class Ramp(Component):
    """Rises without end."""

    slope = Property(1.0, unit="rad/s", doc="how fast", range=(0.0, 10.0), changeable_while_running=True)
    fails_at = Property(-1.0, unit="s", doc="when it raises an exception; below 0: never")
    note = Property("", doc="what it says as it starts")
    out = Output(float, unit="rad", doc="where it is")

    def __init__(self) -> None:
        self.cycles = 0

    def configure(self) -> None:
        if self.note == "impossible":
            raise ValueError("this cannot be")

    def start(self) -> None:
        self.log(f"begins: {self.note}", "warning")

    def update(self) -> None:
        self.cycles += 1
        if 0.0 <= self.fails_at <= self.time:
            raise RuntimeError(f"{self.name} has enough")
        self.out = self.slope * self.time

    def stop(self) -> None:
        self.log("stops")

    def cleanup(self) -> None:
        self.cycles = 0


class Twice(Component):
    """Doubles what it gets, as it comes."""

    ramp = Input(float, unit="rad", doc="what to double", triggers=True)
    spare = Input(list, doc="three numbers", size=3, may_stay_open=True)
    out = Output(float, unit="rad", doc="the double")
    both = Output(list, doc="it and its double", size=2)
    count = Output(int, doc="how many came")
    late = Output(bool, doc="whether time is beyond 0.1 s")

    def update(self) -> None:
        assert self.ramp is not None and self.spare is None
        self.out = 2.0 * self.ramp
        self.both = [self.ramp, 2.0 * self.ramp]
        self.count = self.count + 1
        self.late = self.time > 0.1


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "ramps.yaml"
    file.write_text(DEPLOYMENT)
    return file


def load(file, **options):
    return armature.load(file, components=[Ramp, Twice], **options)


def test_they_are_updated_and_read_what_others_write(file):
    with load(file).application() as app:
        app.run_for(0.2)
        assert app.Ramp.out.value == pytest.approx(0.2) and app.Twice.out.value == pytest.approx(0.4)
        np.testing.assert_allclose(app.Twice.both.value, [0.2, 0.4])
        assert app.Twice.count.value in (20, 21) and app.Twice.late.value is True
        assert app.Other.out.value == pytest.approx(0.6) and app.Other.slope == 3.0


def test_their_interface_is_described_like_that_of_any_other(file):
    with load(file).application() as app:
        assert app.Ramp.model == "Ramp" and app.Ramp.out.unit == "rad" and app.Ramp.out.doc == "where it is"
        slope = app.Ramp.properties["slope"]
        assert (slope.unit, slope.doc, slope.range) == ("rad/s", "how fast", (0.0, 10.0))
        app.Ramp.slope = 5
        app.run_for(0.1)
        assert app.Ramp.out.value == pytest.approx(0.5)
        with pytest.raises(armature.Refusal, match="slope"):
            app.Ramp.slope = 11
    assert "rad/s" in Ramp.slope.__doc__ and Ramp.out.__doc__ == "float [rad]: where it is"


def test_an_exception_faults_its_component_and_nothing_else(file):
    with load(file, set={"Ramp.fails_at": "100 ms"}).application() as app:
        app.run_for(0.5)
        assert app.faults == {"Ramp": "RuntimeError: Ramp has enough"}
        assert (app.Ramp.state, app.Other.state) == ("Exception", "Running")
        assert app.Other.out.value == pytest.approx(1.5)
        log = [line.text for line in app.log if line.component == "Ramp" and line.level == "error"]
        assert log[0].startswith("Traceback") and any("has enough" in line for line in log)
        assert any("test_author.py" in line for line in log)


def test_one_that_cannot_be_configured_is_not_started(file):
    deployment = load(file, set={"Ramp.note": "impossible"})
    with pytest.raises(armature.DeploymentError, match="ValueError: this cannot be"):
        deployment.application()


def test_its_log_lines_are_the_application_s(file):
    with load(file, set={"Other.note": "now"}).application() as app:
        app.run_for(0.1)
        line = next(one for one in app.log if one.component == "Other")
        assert (line.level, line.text) == ("warning", "begins: now")


@pytest.mark.parametrize("setting", [{"Ramp.activity.priority": 50}, {"Ramp.activity.scheduler": "realtime",
                                                                     "Ramp.activity.priority": 1}])
def test_the_check_refuses_them_in_a_real_time_thread(file, setting):
    found = armature.check(file, components=[Ramp, Twice], set=setting)
    refusals = [one for one in found if one.severity == "error"]
    # Twice runs in the thread of Ramp, which triggers it.
    assert {one.message.split("'")[1] for one in refusals} == {"Ramp", "Twice"}
    assert all("written in Python" in one.message and one.line > 0 and "priority" in one.hint for one in refusals)
    with pytest.raises(armature.DeploymentError, match="its thread is a real-time one"):
        load(file, set=setting)


def test_they_do_not_command_their_application_while_they_are_updated(file):
    applications = []

    class Meddler(Component):
        """Reaches around its ports."""

        def update(self) -> None:
            applications[0].Ramp.slope = 2.0

    file.write_text(DEPLOYMENT.replace("connections:", "  Meddler: {model: Meddler, activity: {periodic: 10 ms}}\n"
                                                       "connections:"))
    with armature.load(file, components=[Ramp, Twice, Meddler]).application() as app:
        applications.append(app)
        app.run_for(0.1)
        assert "cannot command its application" in app.faults["Meddler"]
        assert app.Ramp.state == "Running" and app.Ramp.slope == 1.0


def test_ctrl_c_in_an_update_is_the_user_s(file, ctrl_c):
    class Interrupted(Component):
        """Is interrupted."""

        def update(self) -> None:
            raise KeyboardInterrupt

    file.write_text("application: a\ncomponents: {One: {model: Interrupted, activity: {periodic: 10 ms}}}\n")
    with armature.load(file, components=[Interrupted]).application() as app:
        with pytest.raises(KeyboardInterrupt):
            app.run_for("1000000 s")
        assert app.One.state == "Exception"


def test_a_class_that_is_defined_anew_takes_its_elder_s_place(file):
    text = "application: a\ncomponents: {One: {model: Again, activity: {periodic: 10 ms}}}\n"
    file.write_text(text)
    for number in range(100):  # more than there is room for
        class Again(Component):
            """One of many."""

            out = Output(int, doc="which")
            mine = number

            def update(self) -> None:
                self.out = self.mine

        with armature.load(file, components=[Again]).application() as app:
            app.run_for(0.01)
            assert app.One.out.value == number


@pytest.mark.parametrize("in_a_thread", [True, False])
def test_a_load_has_its_own_classes_while_another_one_has_others_of_their_names(file, in_a_thread):
    file.write_text("application: a\ncomponents:\n  One: {model: First, activity: {periodic: 10 ms}}\n"
                    "  Two: {model: Same, activity: {periodic: 10 ms}}\n")
    inner = file.with_name("inner.yaml")
    inner.write_text("application: b\ncomponents: {Two: {model: Same, activity: {periodic: 10 ms}}}\n")

    def class_of(number):
        class Same(Component):
            """One of many."""

            out = Output(int, doc="which")

            def update(self) -> None:
                self.out = number

        return Same

    others = []

    class First(Component):
        """Is made while its deployment is loaded."""

        def __init__(self) -> None:
            def load_other():
                others.append(armature.load(inner, components=[class_of(2)]))

            if in_a_thread:
                thread = threading.Thread(target=load_other)
                thread.start()
                thread.join()
            else:
                load_other()

    outer = armature.load(file, components=[First, class_of(1)])
    for deployment, number in ((outer, 1), (others[0], 2)):
        with deployment.application() as app:
            app.run_for(0.01)
            assert app.Two.out.value == number


def test_a_deployment_has_64_classes_at_most(file):
    classes = [type(f"Class{i}", (Component,), {"__doc__": "One of many."}) for i in range(65)]
    file.write_text("application: a\ncomponents: {One: {model: Class63, activity: {periodic: 10 ms}}}\n")
    armature.load(file, components=classes[:64])
    with pytest.raises(armature.Refusal, match="at most 64 models in Python, found 65"):
        armature.load(file, components=classes)


def test_one_that_could_not_be_made_has_no_component(file):
    kept = []

    class Failing(Component):
        """Cannot be made."""

        out = Output(float, doc="what it would write")

        def __init__(self) -> None:
            kept.append(self)
            raise RuntimeError("not today")

    file.write_text("application: a\ncomponents: {One: {model: Failing, activity: {periodic: 10 ms}}}\n")
    with pytest.raises(armature.DeploymentError, match="not today"):
        armature.load(file, components=[Failing])
    with pytest.raises(ValueError, match="is gone"):
        kept[0].name
    with pytest.raises(armature.Refusal, match="in its hooks only"):
        kept[0].out


def test_texts_that_are_cut_within_a_letter_are_read(file):
    class Wordy(Component):
        """Says more than a line of the log has room for."""

        def update(self) -> None:
            for begin in ("", "a"):  # wherever the cut is, one of them is cut within a letter
                self.log(begin + "ö" * 2000)
            raise RuntimeError("ü" * 2000 if self.name == "One" else "a" + "ü" * 2000)

    file.write_text("application: a\ncomponents:\n  One: {model: Wordy, activity: {periodic: 10 ms}}\n"
                    "  Two: {model: Wordy, activity: {periodic: 10 ms}}\n")
    with armature.load(file, components=[Wordy]).application() as app:
        app.run_for(0.01)
        assert sum("öö" in line.text and "öö" in str(line) for line in app.log) == 4
        assert all("üü" in reason for reason in app.faults.values()) and len(app.faults) == 2
        assert "üü" in app.One.reason and "üü" in app.Two.reason


def test_an_exception_with_what_is_no_text_faults_its_component(file):
    class Odd(Component):
        """Raises half a letter."""

        def update(self) -> None:
            raise RuntimeError("\ud800")

    file.write_text("application: a\ncomponents: {One: {model: Odd, activity: {periodic: 10 ms}}}\n")
    with armature.load(file, components=[Odd]).application() as app:
        app.run_for(0.01)
        assert app.faults == {"One": "RuntimeError: \\ud800"}


def test_an_exception_in_a_stop_is_told_by_the_stop(file):
    class Clinging(Component):
        """Does not want to end."""

        def stop(self) -> None:
            raise RuntimeError("not yet")

    file.write_text("application: a\ncomponents: {One: {model: Clinging, activity: {periodic: 10 ms}}}\n")
    app = armature.load(file, components=[Clinging]).application()
    app.run_for(0.01)
    with pytest.raises(armature.RunError, match="'One'.*RuntimeError: not yet"):
        app.stop()
    assert app.faults == {"One": "RuntimeError: not yet"} and not app.running


def test_ports_are_written_in_hooks_only(file):
    told = []

    class Threaded(Component):
        """Has a thread of its own."""

        out = Output(float, doc="nothing")
        gain = Property(1.0, doc="none", changeable_while_running=True)

        def update(self) -> None:
            thread = threading.Thread(target=self.meddle)
            thread.start()
            thread.join()

        def meddle(self) -> None:
            for attempt in (lambda: setattr(self, "out", 1.0), lambda: self.gain, lambda: self.log("x"),
                            lambda: self.time):
                try:
                    attempt()
                except armature.Refusal as refusal:
                    told.append(str(refusal))

    file.write_text("application: a\ncomponents: {One: {model: Threaded, activity: {periodic: 10 ms}}}\n")
    with armature.load(file, components=[Threaded]).application() as app:
        app.run_for(0.01)
    assert len(told) >= 4 and all("in its hooks only" in one for one in told)


def test_a_command_is_not_cancelled_by_a_component(janus_file, tmp_path):
    commands = []

    class Canceller(Component):
        """Reaches around its ports."""

        def update(self) -> None:
            if commands:
                commands[0].cancel()

    file = tmp_path / "head.yaml"
    file.write_text(f"include: {janus_file}\n"
                    "components: {Canceller: {model: Canceller, activity: {periodic: 10 ms, scheduler: other}}}\n")
    with armature.load(file, components=[Canceller]).application() as app:
        app.run_for("100 ms")
        app.Arming.arm()
        commands.append(app.Generator.moveTo.begin([0.1, 0.1], 0.5))
        app.run_for("100 ms")
        assert "cannot command its application" in app.faults["Canceller"]
        assert commands[0].stage != "cancelled"


def test_an_initial_value_is_in_its_range():
    with pytest.raises(ValueError, match="5.0 is not in the range from 0 to 1"):
        Property(5.0, range=(0, 1))


def test_what_its_class_declares_wrongly_is_told_at_once():
    with pytest.raises(TypeError, match="never grows"):
        Output(str)
    with pytest.raises(TypeError, match="bool, int, float, str or list"):
        Input(dict)
    with pytest.raises(TypeError, match="`size`"):
        Output(list)


def test_a_value_of_the_wrong_kind_or_size_is_its_mistake(file):
    class Wrong(Component):
        """Writes what does not fit."""

        out = Output(list, size=2)

        def update(self) -> None:
            self.out = [1.0, 2.0, 3.0]

    file.write_text("application: a\ncomponents: {One: {model: Wrong, activity: {periodic: 10 ms}}}\n")
    with armature.load(file, components=[Wrong]).application() as app:
        app.run_for(0.1)
        assert "another size" in app.faults["One"]


def test_the_period_is_known(file):
    periods = []

    class Periodic(Component):
        """Tells its period."""

        def update(self) -> None:
            periods.append(self.period)

    file.write_text("application: a\ncomponents: {One: {model: Periodic, activity: {periodic: 10 ms}}}\n")
    with armature.load(file, components=[Periodic]).application() as app:
        app.run_for(0.02)
    assert set(periods) == {0.01}
