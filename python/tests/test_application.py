# SPDX-License-Identifier: Apache-2.0
"""Applications in simulated time: how it passes, who may drive it, how it ends."""
import _thread
import ctypes
import subprocess
import sys
import threading
import time
import weakref

import pytest

import armature
from armature import RunEnd, author


def test_time_passes_as_it_is_told(janus):
    assert janus.now == 0.0
    assert janus.run_for("250 ms") is RunEnd.TIME_UP
    assert janus.now == 0.25
    janus.run_for(0.75)
    assert janus.now == 1.0
    assert "at 1 s" in repr(janus) and janus.name in repr(janus)


@pytest.mark.parametrize("wrong", ["60 m", "soon", "-1 s", -1.0, float("nan")])
def test_a_duration_is_a_time(janus, wrong):
    with pytest.raises(ValueError, match="duration"):
        janus.run_for(wrong)


def test_a_step_goes_to_the_next_instant_at_which_something_is_due(janus):
    janus.run_for("100 ms")
    times = [janus.step() for _ in range(3)]
    assert times == sorted(times) and 0.1 < times[-1] <= 0.13
    assert janus.step(at_most="1 us") == pytest.approx(times[-1], abs=1.1e-6)


def test_it_runs_until_a_condition_is_true(armed_janus):
    app = armed_janus
    app.Generator.moveTo.begin([1.0, 1.0], 2.0)
    assert app.run_until(lambda: app.Joint1.Position.value > 0.5, "5 s") is RunEnd.CONDITION_MET
    assert 0.5 < app.Joint1.Position.value < 0.6
    assert app.run_until(lambda: False, 0.1) is RunEnd.TIME_UP


def test_a_mistake_in_a_condition_ends_the_run_with_it(janus):
    with pytest.raises(ZeroDivisionError):
        janus.run_until(lambda: 1 / 0 > 0, 1)
    assert janus.run_for(0.1) is RunEnd.TIME_UP


def test_a_condition_does_not_let_time_pass(janus):
    with pytest.raises(armature.Refusal, match="time passes already"):
        janus.run_until(lambda: janus.run_for(1) is RunEnd.TIME_UP, 1)


def test_two_runs_are_equal_to_the_bit(janus_file):
    def positions():
        with armature.load(janus_file).application() as app:
            app.run_for(0.1)
            app.Arming.arm()
            app.Generator.moveTo([1.0, -0.3], 1.0)
            return app.Joint1.Position.value, app.Joint2.Position.value, app.now

    assert positions() == positions()


def progress_of_another_thread(call):
    """How far another thread counts between the begin and the end of `call`.

    The interpreter asks nobody for its lock meanwhile: only a call that lets go of it lets the other one run."""
    counts = {"of": 0}
    running = threading.Event()
    ended = threading.Event()

    def run():
        running.set()
        while not ended.is_set():
            counts["of"] += 1
            time.sleep(0)  # lets go of the lock, for whoever waits for it

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    other = threading.Thread(target=run)
    other.start()
    try:
        running.wait()
        before = counts["of"]
        call()
        return counts["of"] - before
    finally:
        ended.set()
        other.join()
        sys.setswitchinterval(interval)


def test_other_threads_of_python_run_while_time_is_simulated(janus):
    assert progress_of_another_thread(lambda: janus.run_for("20 s")) > 100


def test_other_threads_would_stand_still_during_a_call_that_holds_the_lock():
    """What the test above relies on."""
    holds_it = ctypes.PyDLL(None).usleep
    lets_go_of_it = ctypes.CDLL(None).usleep
    assert progress_of_another_thread(lambda: holds_it(100_000)) == 0
    assert progress_of_another_thread(lambda: lets_go_of_it(100_000)) > 100


def test_ctrl_c_ends_a_run_and_the_application_can_go_on(janus, ctrl_c):
    def interrupt():
        while janus.now < 0.5:
            pass
        _thread.interrupt_main()

    other = threading.Thread(target=interrupt)
    other.start()
    with pytest.raises(KeyboardInterrupt):
        janus.run_for("1000000 s")
    other.join()
    now = janus.now
    assert now >= 0.5
    janus.run_for("1 s")
    assert janus.now == pytest.approx(now + 1.0)


def test_one_thread_at_a_time_drives_it(janus):
    refused = []

    def look():
        try:
            janus.PID1.state
        except armature.Refusal as refusal:
            refused.append(str(refusal))

    def condition():
        other = threading.Thread(target=look)
        other.start()
        other.join()
        return True

    assert janus.run_until(condition, 1) is RunEnd.CONDITION_MET
    assert "driven by another thread" in refused[0]


def test_log_lines_have_their_time_and_component(armed_janus):
    line = armed_janus.log[-1]
    assert isinstance(line, armature.LogLine) and isinstance(armed_janus, armature.Application)
    assert (line.component, line.level, line.text) == ("Joint2", "info", "armed")
    assert 0.1 < line.time < 1.0 and line.number >= 1
    assert "Joint2" in str(line) and "armed" in repr(line)


def test_faults_are_told_with_their_reasons(janus):
    assert janus.faults == {}
    assert janus.running


def test_it_stops_at_the_end_and_only_once(janus_file):
    app = armature.load(janus_file).application()
    app.run_for(0.1)
    app.stop()
    app.stop()
    assert not app.running and "stopped" in repr(app)


def test_an_exception_of_the_user_stops_it_and_goes_on(janus_file):
    with pytest.raises(KeyError):
        with armature.load(janus_file).application() as app:
            raise KeyError("mine")
    assert not app.running


def test_what_does_not_stop_in_good_order_is_an_error(janus, monkeypatch, tmp_path):
    file = tmp_path / "empty.yaml"
    file.write_text("application: 3\ncomponents: {A: {model: B}}\n")
    problems = armature.check(file)
    with monkeypatch.context() as patch:
        patch.setattr(janus, "_simulation", type("Hanging", (), {"stop": lambda self, in_order: problems})())
        with pytest.raises(armature.RunError) as raised:
            janus.stop()
    assert raised.value.diagnostics == problems and "error" in str(raised.value)


def test_a_deployment_with_components_elsewhere_does_not_run_alone(janus_file):
    with pytest.raises(armature.Refusal, match="lives in another process"):
        armature.load(janus_file.with_name("operator.yaml")).application()


def test_one_that_nobody_stopped_stops_with_its_process(janus_file):
    program = ("import armature\n"
               f"app = armature.load({str(janus_file)!r}).application()\n"
               "app.run_for(0.5)\nprint(app.now)\n")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (0, "0.5\n", "")


def test_one_that_nobody_refers_to_is_gone_at_once(tmp_path, janus_file):
    import gc
    gc.disable()
    try:
        deployment = armature.load(janus_file)
        app = deployment.application(record=tmp_path)
        app.run_for(0.1)
        app.PID1.Out.value
        gone = weakref.ref(app)
        del app
        assert gone() is None
        with deployment.application(record=tmp_path):  # the folder is free
            pass
    finally:
        gc.enable()


PROGRAM = """
import armature
from armature.author import Component, Output

def main():
    class Knowing(Component):
        "Knows its application, so that both keep each other."
        out = Output(float, doc="the time")
        applications = []

        def update(self):
            self.out = self.time

    app = armature.load("knowing.yaml", components=[Knowing]).application(record="out")
    Knowing.applications.append(app)
    app.run_for(0.5)

main()
"""


def test_a_program_that_ends_without_a_stop_leaves_a_whole_recording(tmp_path):
    (tmp_path / "knowing.yaml").write_text("application: a\n"
                                           "components: {One: {model: Knowing, activity: {periodic: 10 ms}}}\n")
    run = subprocess.run([sys.executable, "-c", PROGRAM], cwd=tmp_path, capture_output=True, text=True)
    assert (run.returncode, run.stderr) == (0, "")
    recording = armature.read_recording(tmp_path / "out")
    assert recording.complete and recording["One.out"].times[-1] == pytest.approx(0.5, abs=0.02)


FAULTING = """application: faulting
on_fault: stop_all
components:
  Failing: {model: Failing, activity: {periodic: 10 ms}}
"""


class Failing(author.Component):
    """Faults at 0.8 s."""

    out = author.Output(float, doc="the time")

    def update(self) -> None:
        if self.time > 0.795:
            raise RuntimeError("it is enough")
        self.out = self.time


def test_what_a_fault_ends_is_not_waited_for(janus_file, tmp_path):
    file = tmp_path / "head.yaml"
    file.write_text(f"include: {janus_file}\non_fault: stop_all\n"
                    "components: {Failing: {model: Failing, activity: {periodic: 10 ms, scheduler: other}}}\n")
    with armature.load(file, components=[Failing]).application() as app:
        app.run_for("100 ms")
        app.Arming.arm()
        assert app.last_end is RunEnd.CONDITION_MET
        move = app.Generator.moveTo.begin([0.5, 0.5], 5.0)
        with pytest.raises(armature.CommandError, match="has not ended: .* at 0.79 s, Failing: RuntimeError: it is"):
            move.wait()
        assert app.last_end is RunEnd.FAULTED and app.now < 1.0
        with pytest.raises(armature.Error, match="Failing: RuntimeError"):
            app.Arming.Disarm.wait("5 s")


def test_one_that_has_stopped_goes_on_in_no_way(tmp_path):
    file = tmp_path / "faulting.yaml"
    file.write_text(FAULTING)
    with armature.load(file, components=[Failing]).application() as app:
        assert app.run_for("2 s") is RunEnd.FAULTED
    assert app.faults == {"Failing": "RuntimeError: it is enough"}
    for attempt in (lambda: app.run_for(1), app.step, app.Failing.start, app.Failing.reset):
        with pytest.raises(armature.Refusal, match="has stopped"):
            attempt()
    assert app.Failing.out.value == pytest.approx(0.79)


def test_a_folder_of_recordings_is_one_run_s(tmp_path, janus_file):
    deployment = armature.load(janus_file)
    with deployment.application(record=tmp_path):
        with pytest.raises(armature.Refusal, match=str(tmp_path)):
            deployment.application(record=tmp_path)
