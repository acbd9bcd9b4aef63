# SPDX-License-Identifier: Apache-2.0
"""Sweeps of a real deployment: the head of Janus, simulated."""
import importlib.util
import os
import re
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

import pytest
from sweep_checks import bits

import armature
from armature import author
from armature.sweeps import Following, JournalError, Results, Run
from armature.sweeps.experiment import Simulated
from armature.sweeps.run import Task, run_task

pytest.importorskip("cloudpickle")

JANUS = Path(__file__).resolve().parents[2] / "robots/janus"
PID = JANUS / "deployments/pid.yaml"


def short_motion(app, in_the_middle=lambda: None):
    """A second of motion: enough that gains, and every bit of them, tell."""
    app.run_for("100 ms")
    app.Arming.arm()
    following = Following(app, [("PID1.Ref", "PID1.Sen"), ("PID2.Ref", "PID2.Sen")], period=0.01)
    app.Generator.moveTo.begin([0.3, 0.3], 1.0)
    following.run_until(0.5)
    in_the_middle()
    following.run_until(1.0)
    return {"iae": sum(joint.iae for joint in following.joints), "end": app.Joint1.Position.value}


def sweep(parameters, measure=short_motion, **options):
    return armature.sweep(PID, parameters, measure, progress=False, **options)


GAINS = {
    "PID1.Kp": [100.0, 200.0, 300.0],
    "mode": ["synchronous", "sequential"],
}


@pytest.fixture(scope="module")
def by_one_worker():
    results = sweep(GAINS, workers=1)
    assert results.outcomes == {"done": 6}, results[0].reason
    return results


def test_every_run_has_its_own_result(by_one_worker):
    assert len({run.metrics["iae"] for run in by_one_worker}) == 6
    assert 0 < by_one_worker.best.metrics["iae"] < 0.01


def test_results_are_the_same_to_the_bit_on_2_and_4_workers(by_one_worker):
    for workers in (2, 4):
        assert bits(sweep(GAINS, workers=workers)) == bits(by_one_worker)


def test_results_are_the_same_to_the_bit_on_a_cluster_of_1_2_and_4_workers(by_one_worker, monkeypatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster) as client:
            for workers in (1, 2, 4):
                cluster.scale(workers)
                client.wait_for_workers(workers)
                results = sweep(GAINS, client=client)
                assert results.effort.workers == workers
                assert workers == 1 or len({run.worker for run in results}) > 1
                assert bits(results) == bits(by_one_worker)


def test_results_are_the_same_to_the_bit_in_another_order(by_one_worker):
    backwards = sweep([run.point for run in reversed(by_one_worker)], workers=1)
    assert [run.metrics for run in reversed(backwards)] == [run.metrics for run in by_one_worker]


def test_a_worker_killed_in_the_middle_changes_no_result(by_one_worker, tmp_path):
    mark = tmp_path / "under way"

    def wait_to_be_killed():
        try:
            mark.open("x").close()
        except FileExistsError:
            return  # another run was, or this one in its first attempt
        (tmp_path / "by").write_text(str(os.getpid()))
        (tmp_path / "by").rename(tmp_path / "process")
        time.sleep(60)

    threading.Thread(target=kill_once_it_is_there, args=(tmp_path / "process",), daemon=True).start()
    results = sweep(GAINS, lambda app: short_motion(app, wait_to_be_killed), workers=2)
    assert sorted(run.attempts for run in results) == [1, 1, 1, 1, 1, 2]
    assert bits(results) == bits(by_one_worker)


def kill_once_it_is_there(process):
    while not process.exists():
        time.sleep(0.01)
    os.kill(int(process.read_text()), signal.SIGKILL)


def test_what_does_not_load_and_what_cannot_be_armed_are_rows_with_their_reasons(tmp_path):
    heavy = tmp_path / "heavy.urdf"
    heavy.write_text((JANUS / "janus.urdf").read_text().replace('mass value="1.1"', 'mass value="13"'))
    results = sweep(
        [
            {"PID1.Kp": 4000.0},
            {"PID1.Kp": 400.0},
            {"PID9.Kp": 400.0},
            {"Cards.robot_description": str(heavy)},
        ],
        workers=1,
    )
    assert [run.outcome for run in results] == ["refused", "done", "refused", "failed"]
    assert re.match(r"control.yaml:.*'PID1': Joint1: shakes at .* give", results[0].reason)
    assert "PID9" in results[2].reason
    assert "Arming.arm failed: Joint2 is not armed: it moved by" in results[3].reason


def test_no_sweep_reaches_a_real_robot():
    on_can = armature.sweep(
        JANUS / "deployments/on_can.yaml", {"bus": ["can0"]}, short_motion, workers=1,
        grants=["Arming.arm"], progress=False,
    )  # fmt: skip
    assert [run.outcome for run in on_can] == ["refused"]
    assert "'Cards' drives a real robot by can0" in on_can[0].reason


def test_a_sweep_goes_on_where_it_was_until_a_file_of_its_deployment_changes(tmp_path):
    deployment = tmp_path / "head.yaml"
    deployment.write_text(f"include: {PID}\n")

    def again(points):
        return armature.sweep(
            deployment, points, short_motion, workers=1, out=tmp_path / "out", progress=False
        )

    first = again([{"PID1.Kp": 200.0}])
    assert first.effort.runs == 1
    both = again([{"PID1.Kp": 200.0}, {"PID1.Kp": 300.0}])
    assert both.effort.runs == 1 and both[0] == first[0]
    deployment.write_text(f"include: {PID}\ncomponents: {{PID2: {{override: true}}}}\n")
    with pytest.raises(JournalError, match="another experiment: files of the deployment changed"):
        again([{"PID1.Kp": 200.0}])


def test_a_file_that_a_point_names_is_the_one_it_was(tmp_path):
    head = tmp_path / "head.urdf"
    head.write_text((JANUS / "janus.urdf").read_text())

    def again():
        return sweep([{"Cards.robot_description": str(head)}], workers=1, out=tmp_path / "out")

    assert again().effort.runs == 1 and again().effort.runs == 0
    head.write_text(head.read_text().replace('mass value="1.1"', 'mass value="1.2"'))
    with pytest.raises(JournalError, match="another experiment: file .*head.urdf changed since"):
        again()


def test_a_recorded_run_leaves_its_recording_its_point_and_a_report(tmp_path):
    results = armature.sweep(
        JANUS / "demo/pid.yaml", [{"PID1.Kp": 200.0}], short_motion, workers=1, out=tmp_path,
        record=True, progress=False,
    )  # fmt: skip
    assert results.outcomes == {"done": 1}
    folder = tmp_path / "runs/000000"
    assert results.folder_of(results.best) == folder
    assert {"janus.mcap", "point.json"} <= {file.name for file in folder.iterdir()}
    assert '"PID1.Kp": 200.0' in (folder / "point.json").read_text()
    if (Path(armature.__file__).parents[4] / "bin/armature").exists():
        assert '"title":"000000"' in (folder / "report.html").read_text()
        assert '"report":"runs/000000/report.html"' in (tmp_path / "sweep.html").read_text()


SILENT = """
include: INCLUDED
on_fault: stop_all
components:
  Quiet: {model: Quiet, activity: {periodic: 10 ms, scheduler: other}}
  Ear: {model: Ear, activity: {periodic: 10 ms, scheduler: other}}
connections:
  - {from: Quiet.out, to: Ear.heard, max_age: 100 ms, on_old: stop}
"""


class Quiet(author.Component):
    """Falls silent at 0.5 s."""

    out = author.Output(float, doc="the time")

    def update(self) -> None:
        if self.time < 0.5:
            self.out = self.time


class Ear(author.Component):
    """Is stopped when nothing comes any more."""

    heard = author.Input(float, doc="what comes")


def forgets_to_look(app):
    app.run_for("2 s")
    return {"cost": 1.0}


@pytest.mark.parametrize("measure", [short_motion, forgets_to_look])
def test_a_reaction_that_ends_the_application_is_the_reason(tmp_path, measure):
    (tmp_path / "silent.yaml").write_text(SILENT.replace("INCLUDED", str(PID)))
    results = armature.sweep(
        tmp_path / "silent.yaml", [{}], measure, workers=1, progress=False, components=[Quiet, Ear],
    )  # fmt: skip
    assert results[0].outcome == "failed"
    assert re.match("Faulted: the application ended at 0.59 s, Ear: input 'heard'", results[0].reason)


def test_following_measures_no_time_that_has_not_passed(tmp_path):
    (tmp_path / "silent.yaml").write_text(SILENT.replace("INCLUDED", str(PID)))
    with armature.load(tmp_path / "silent.yaml", components=[Quiet, Ear]).application() as app:
        app.run_for("100 ms")
        following = Following(app, [("PID1.Ref", "PID1.Sen")], period=0.01)
        assert app.end_reason == ""
        with pytest.raises(armature.Error, match="ended at 0.59 s, Ear"):
            following.run_until(5.0)
        assert following.seconds == pytest.approx(0.49)


def test_a_run_without_recordings_records_nothing_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))

    def measure(app):
        app.run_for("100 ms")
        return {"files": len(list(tmp_path.glob("*/*.mcap"))), "components": len(app.components)}

    metrics = Simulated(str(PID), measure, {})({}, None)
    assert metrics == {"files": 0, "components": 15}
    assert list(tmp_path.iterdir()) == []


def test_a_deployment_without_outputs_is_recorded_as_far_as_it_goes(tmp_path):
    (tmp_path / "ear.yaml").write_text(
        "application: a\ncomponents: {Nobody: {model: Nobody, activity: {periodic: 10 ms}}}\n")
    results = armature.sweep(
        tmp_path / "ear.yaml", [{}], forgets_to_look, workers=1, progress=False, components=[Nobody],
        out=tmp_path / "out", record=True,
    )  # fmt: skip
    assert results.outcomes == {"done": 1}, results[0].reason


class Nobody(author.Component):
    """Has no ports."""


class Faulty:
    """An application whose joint goes out of service while it is measured."""

    faults = {"Joint1": "the cards are silent"}
    end_reason = "the application ended at 1 s"

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        pass


@pytest.mark.parametrize("measure", [lambda app: {"cost": 1.0}, lambda app: 1 / 0])
def test_a_fault_is_the_reason_whatever_is_measured(monkeypatch, measure):
    class Deployment:
        def application(self, record, what, grants):
            return Faulty()

    monkeypatch.setattr(armature, "load", lambda *arguments, **options: Deployment())
    run = run_task(Simulated("any.yaml", measure, {}), Task(0, {}))
    assert run.outcome == "failed"
    assert run.reason == "Faulted: Joint1: the cards are silent"


def test_what_the_page_of_sweeps_begins_with_runs(tmp_path, monkeypatch, capsys):
    root = JANUS.parents[1]
    (tmp_path / "robots").symlink_to(root / "robots")
    monkeypatch.chdir(tmp_path)
    block = re.search(r"```python\n(.*?)```", (root / "docs/sweeps.md").read_text(), re.DOTALL)[1]
    exec(compile(block, "docs/sweeps.md", "exec"), {"__name__": "page"})
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["run", "PID1.Kp", "PID1.Kd", "iae"]
    assert lines[-1] == "6 runs: 6 done"
    assert (tmp_path / "sweep/sweep.html").exists()


def test_tuning_compares_gains_on_heads_whose_runs_are_done(tmp_path, monkeypatch, capsys):
    pytest.importorskip("scipy")
    path = JANUS.parents[1] / "python/examples/tune_janus.py"
    spec = importlib.util.spec_from_file_location("tune_janus", path)
    tune_janus = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tune_janus)
    good = {"iae": 0.5, "iae_1": 0.25, "iae_2": 0.25, "largest": 0.1}
    runs = [Run(i, {}, "done", {**good, "iae": 1.0 - 0.1 * i}, "") for i in range(5)]
    runs.append(Run(5, {}, "failed", {}, "Faulted: Joint1"))
    monkeypatch.setattr(armature, "sweep", lambda *arguments, **options: Results(runs))
    share = tune_janus.robustness(tune_janus.DEPLOYMENTS_GAINS, tmp_path, {})
    assert share == [pytest.approx(0.9 / 1.0), pytest.approx(0.7 / 0.8)]
    assert "failed: Faulted: Joint1" in capsys.readouterr().out
