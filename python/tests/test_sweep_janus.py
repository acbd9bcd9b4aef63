# SPDX-License-Identifier: Apache-2.0
"""Sweeps of a real deployment: the head of Janus, simulated."""
import os
import re
import signal
import sys
import threading
import time
from pathlib import Path

import pytest
from sweep_checks import bits

import armature
from armature.sweeps import Following, JournalError, Pool
from armature.sweeps.experiment import Simulated, digest_of
from armature.sweeps.run import Task, run_task

pytest.importorskip("cloudpickle")

JANUS = Path(__file__).resolve().parents[2] / "robots/janus"
PID = JANUS / "deployments/pid.yaml"


def short_motion(app):
    """A second of motion: enough that gains, and every bit of them, tell."""
    app.run_for("100 ms")
    app.Arming.arm()
    following = Following(app, [("PID1.Ref", "PID1.Sen"), ("PID2.Ref", "PID2.Sen")], period=0.01)
    app.Generator.moveTo.begin([0.3, 0.3], 1.0)
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


def test_results_are_the_same_to_the_bit_on_a_cluster(by_one_worker, monkeypatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster) as client:
            results = sweep(GAINS, client=client)
    assert len({run.worker for run in results}) == 2
    assert bits(results) == bits(by_one_worker)


def test_results_are_the_same_to_the_bit_in_another_order(by_one_worker):
    backwards = sweep([run.point for run in reversed(by_one_worker)], workers=1)
    assert [run.metrics for run in reversed(backwards)] == [run.metrics for run in by_one_worker]


def test_a_worker_killed_in_the_middle_changes_no_result(by_one_worker):
    with Pool(2) as pool:
        threading.Thread(target=kill_soon, args=(pool.processes[0],)).start()
        results = sweep(GAINS, workers=pool)
    assert bits(results) == bits(by_one_worker)


def kill_soon(process):
    time.sleep(0.6)
    os.kill(process, signal.SIGKILL)


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


def test_the_digest_covers_included_files_and_component_libraries(tmp_path):
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf/x.urdf").write_text("<robot/>")
    (tmp_path / "base.yaml").write_text('libraries: [mine]\nfile: "${here}/urdf/x.urdf"\n')
    (tmp_path / "a.yaml").write_text("include: [base.yaml]\n")
    (tmp_path / "libmine.so").write_bytes(b"1")
    (tmp_path / "libother.so").write_bytes(b"1")
    digests = [digest_of(tmp_path / "a.yaml", [str(tmp_path)])]
    for file, text in {"urdf/x.urdf": "<robot />", "libmine.so": "2", "libother.so": "2"}.items():
        (tmp_path / file).write_text(text)
        digests.append(digest_of(tmp_path / "a.yaml", [str(tmp_path)]))
    assert digests[0] != digests[1] != digests[2] == digests[3]


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
        assert '"report":"runs/000000/report.html"' in (tmp_path / "sweep.html").read_text()


class Faulty:
    """An application whose joint goes out of service while it is measured."""

    faults = {"Joint1": "the cards are silent"}

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        pass


@pytest.mark.parametrize("measure", [lambda app: {"cost": 1.0}, lambda app: 1 / 0])
def test_a_fault_is_the_reason_whatever_is_measured(monkeypatch, measure):
    class Deployment:
        def application(self, record, grants):
            return Faulty()

    monkeypatch.setattr(armature, "load", lambda *arguments, **options: Deployment())
    run = run_task(Simulated("any.yaml", measure, {}), Task(0, {}))
    assert run.outcome == "failed"
    assert run.reason == "Faulted: Joint1: the cards are silent"
