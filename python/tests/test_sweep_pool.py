# SPDX-License-Identifier: Apache-2.0
import csv
import os
import signal
import subprocess
import sys
import threading
import time
import types
from pathlib import Path

import numpy
import pytest
import sweep_runs
from sweep_checks import bits

from armature.sweeps import Interrupted, PointsError, Pool, PoolError, each, points

pytest.importorskip("cloudpickle")

SQUARE = points.grid({"x": [-1.5, -0.3, 0.1, 1.0], "y": [0.2, 0.7, 1.0]})


def quiet(run_point, some, **options):
    return each(run_point, some, progress=False, **options)


def test_results_are_the_same_to_the_bit_on_1_2_and_4_workers():
    one = quiet(sweep_runs.rosenbrock, SQUARE, workers=1)
    assert one.outcomes == {"done": 12}
    assert one.best.point == {"x": 1.0, "y": 1.0}
    for workers in (2, 4):
        assert bits(quiet(sweep_runs.rosenbrock, SQUARE, workers=workers)) == bits(one)


def test_the_order_of_points_changes_no_run():
    forth = quiet(sweep_runs.draws, [{"x": x} for x in range(6)], workers=1)
    back = quiet(sweep_runs.draws, [{"x": x} for x in reversed(range(6))], workers=2)
    assert {run.point["x"]: run.metrics for run in forth} == {
        run.point["x"]: run.metrics for run in back}  # fmt: skip
    assert [run.point["x"] for run in back] == [5, 4, 3, 2, 1, 0]


def test_a_run_that_cannot_be_is_a_row_with_its_reason():
    results = quiet(sweep_runs.picky, [{"x": x} for x in (1, -1, 11, 5, 2)], workers=2)
    assert [run.outcome for run in results] == ["done", "refused", "failed", "failed", "done"]
    assert results[1].reason == "x must be 0 or more, found -1"
    assert results[2].reason == "RuntimeError: Joint1: too far from its reference"
    assert results[3].reason == "TypeError: the metric 'cost' must be a number, found 'much'"
    assert results.best.point == {"x": 1}


def test_the_run_of_a_worker_that_dies_is_done_again_with_the_same_result(tmp_path):
    some = [{"x": x, "marks": str(tmp_path)} for x in range(8)]
    with_death = quiet(sweep_runs.deadly_once, some, workers=2)
    assert with_death[3].attempts == 2
    assert with_death[3].worker != f"{(tmp_path / 'begun-3').read_text()}"
    assert with_death.outcomes == {"done": 8}
    assert bits(quiet(sweep_runs.deadly_once, some, workers=1)) == bits(with_death)


def test_a_worker_killed_from_outside_in_the_middle_is_replaced(tmp_path):
    some = [{"x": x, "marks": str(tmp_path)} for x in range(10)]
    with Pool(2) as pool:
        killer = threading.Thread(target=kill_first_that_begins, args=(pool, tmp_path))
        killer.start()
        results = quiet(sweep_runs.slow, some, workers=pool)
        killer.join()
        assert max(run.attempts for run in results) == 2
        assert len(pool) == 2
    undisturbed = quiet(sweep_runs.slow, [dict(p, takes=0.0) for p in some], workers=1)
    assert [run.metrics for run in results] == [run.metrics for run in undisturbed]


def kill_first_that_begins(pool, marks):
    while not (begun := list(marks.iterdir())):
        time.sleep(0.01)
    os.kill(int(begun[0].name.split("-")[1]), signal.SIGKILL)


def test_a_run_that_kills_every_worker_is_a_row_and_loses_no_other():
    results = quiet(sweep_runs.deadly, [{"x": x} for x in range(5)], workers=2)
    assert [run.outcome for run in results] == ["done", "lost", "done", "done", "done"]
    assert results[1].reason == "3 workers died with it: signal 9, Killed"


def test_workers_are_kept_from_sweep_to_sweep():
    with Pool(2) as pool:
        first = quiet(sweep_runs.rosenbrock, SQUARE, workers=pool)
        processes = pool.processes
        second = quiet(sweep_runs.rosenbrock, SQUARE, workers=pool)
        quiet(sweep_runs.picky, [{"x": 1}], workers=pool)
        assert pool.processes == processes
    assert bits(first) == bits(second)


def test_the_start_of_a_worker_is_measured():
    with Pool(1) as pool:
        quiet(sweep_runs.rosenbrock, SQUARE, workers=pool)
        assert len(pool.start_seconds) == 1
        assert pool.start_seconds[0] > 0


def test_workers_end_with_their_pool():
    with Pool(2) as pool:
        processes = pool.processes
    for process in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)


def test_workers_end_with_a_parent_that_is_killed_in_the_middle_of_their_runs(tmp_path):
    script = (
        "import sweep_runs\n"
        "from armature.sweeps import each\n"
        f"each(sweep_runs.slow, [{{'x': 1, 'marks': {str(tmp_path)!r}, 'takes': 600}}], workers=1)"
    )
    parent = subprocess.Popen(
        [sys.executable, "-c", script],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    while not (begun := list(tmp_path.iterdir())):
        time.sleep(0.01)
    parent.kill()
    parent.wait()
    worker = int(begun[0].name.split("-")[1])
    while is_running(worker):  # as long as ctest lets it
        time.sleep(0.05)


def test_what_a_run_has_started_ends_with_its_pool(tmp_path):
    interrupt_when(lambda: any(tmp_path.iterdir()))
    with pytest.raises(Interrupted):
        quiet(sweep_runs.with_child, [{"marks": str(tmp_path)}], workers=1)
    child = int(next(tmp_path.iterdir()).name)
    while is_running(child):  # as long as ctest lets it
        time.sleep(0.05)


def test_what_a_killed_run_has_left_is_gone_with_its_pool(tmp_path):
    results = quiet(sweep_runs.leaves_and_dies, [{"marks": str(tmp_path)}], workers=1)
    assert results[0].outcome == "lost"
    assert not Path((tmp_path / "where").read_text()).exists()


def test_a_closed_pool_does_no_runs():
    pool = Pool(1)
    pool.close()
    with pytest.raises(PoolError, match="the pool is closed"):
        quiet(sweep_runs.rosenbrock, SQUARE, workers=pool)


def test_workers_import_what_the_parent_does(tmp_path):
    script, here = tmp_path / "script", tmp_path / "here"
    for folder in (script, here):
        folder.mkdir()
    (here / "json.py").write_text("raise ImportError('not this one')\n")
    (script / "it.py").write_text(
        "import sweep_runs\n"
        "from armature.sweeps import each\n"
        "print(each(sweep_runs.rosenbrock, [{'x': 1, 'y': 1}], workers=1, progress=False)[0].outcome)\n"
    )
    ran = subprocess.run(
        [sys.executable, script / "it.py"], cwd=here, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )  # fmt: skip
    assert (ran.stdout, ran.stderr) == ("done\n", "")


def is_running(process):
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


def test_a_pool_has_a_worker():
    with pytest.raises(PoolError, match="number of workers must be 1 or more, found 0"):
        Pool(0)


def test_what_does_not_fit_together_is_refused():
    with pytest.raises(ValueError, match="recordings need a folder"):
        quiet(sweep_runs.rosenbrock, SQUARE, workers=1, record=True)
    with pytest.raises(ValueError, match="workers or by those of this machine, not both"):
        quiet(sweep_runs.rosenbrock, SQUARE, workers=1, client=object())


def test_what_cannot_be_sent_is_said_before_anything_runs():
    lock = threading.Lock()
    with pytest.raises(TypeError, match="cannot be sent to another process.*use a function"):
        quiet(lambda point, folder: {"cost": float(lock.locked())}, [{"x": 1}], workers=1)


def test_what_workers_cannot_load_fails_each_run_with_the_reason(monkeypatch):
    module = types.ModuleType("only_here")
    exec("def measure(point, folder): return {'cost': 1.0}", module.__dict__)
    monkeypatch.setitem(sys.modules, "only_here", module)
    results = quiet(module.measure, [{"x": 1}, {"x": 2}], workers=1)
    assert [run.outcome for run in results] == ["failed", "failed"]
    assert results[0].reason == "ModuleNotFoundError: No module named 'only_here'"


def test_functions_of_a_script_need_no_module():
    scale = 3.0
    results = quiet(lambda point, folder: {"cost": scale * point["x"]}, [{"x": 2}], workers=1)
    assert results[0].metrics == {"cost": 6.0}


def test_ctrl_c_leaves_what_is_done(tmp_path):
    some = [{"x": x, "marks": str(tmp_path / "marks")} for x in range(24)]
    (tmp_path / "marks").mkdir()
    out = tmp_path / "out"
    interrupt_when(lambda: len(list((tmp_path / "marks").iterdir())) >= 4)
    with pytest.raises(Interrupted, match="interrupted after") as caught:
        quiet(sweep_runs.slow, some, workers=2, out=out)
    partial = caught.value.results
    assert 0 < len(partial) < 24
    assert partial.outcomes == {"done": len(partial)}
    assert len((out / "runs.csv").read_text().splitlines()) == 1 + len(partial)

    rest = [dict(point, takes=0.0) for point in some]  # other points: nothing is reused
    assert quiet(sweep_runs.slow, rest, workers=2, out=out).effort.runs == 24
    whole = quiet(sweep_runs.slow, some[:12], workers=2, out=out)
    assert whole.effort.runs == 12 - sum(run.number < 12 for run in partial)
    assert whole.outcomes == {"done": 12}


def interrupt_when(ready):
    """Ctrl-C, as the terminal sends it to this process; jobs in the background of a script ignore it from the start."""
    signal.signal(signal.SIGINT, signal.default_int_handler)

    def wait_and_send():
        while not ready():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=wait_and_send, daemon=True).start()


def test_a_recorded_run_that_was_interrupted_is_done_again(tmp_path):
    marks, out = tmp_path / "marks", tmp_path / "out"
    marks.mkdir()
    some = [{"x": 1, "marks": str(marks)}]
    quiet(sweep_runs.slow_with_folder, some, workers=1, out=out)
    interrupt_when((marks / "begun").exists)
    with pytest.raises(Interrupted):
        quiet(sweep_runs.slow_with_folder, some, workers=1, out=out, record=True)
    (marks / "again").touch()
    again = quiet(sweep_runs.slow_with_folder, some, workers=1, out=out, record=True)
    assert again.effort.runs == 1
    assert [folder.name for folder in (out / "runs").iterdir()] == ["000000"]
    assert (out / "runs/000000/left.txt").read_text() == "whole"
    assert quiet(sweep_runs.slow_with_folder, some, workers=1, out=out, record=True).effort.runs == 0


def test_a_run_that_was_refused_leaves_no_folder(tmp_path):
    for runs in (1, 0):
        refused = quiet(sweep_runs.picky, [{"x": -1}], workers=1, out=tmp_path, record=True)
        assert refused.effort.runs == runs
        assert refused.folder_of(refused[0]) is None and not any((tmp_path / "runs").iterdir())


@pytest.mark.parametrize("metric", ["metric", "number", "seconds"])
def test_a_metric_has_a_name_of_its_own(metric):
    results = quiet(sweep_runs.names_metric, [{"metric": metric}], workers=1)
    assert results[0].reason.startswith(f"ValueError: the metric '{metric}' has the name of a parameter")


def test_a_parameter_has_a_name_of_its_own():
    with pytest.raises(PointsError, match="cannot be called 'number'"):
        quiet(sweep_runs.rosenbrock, [{"number": 1}], workers=1)


def test_values_of_numpy_and_odd_ones_are_in_all_files(tmp_path):
    some = [{"x": 1, "kind": kind} for kind in (
        numpy.bool_(True), numpy.array([1, 2]), [numpy.float64(0.5)], "\ud800", 10**400, Path("a.yaml"),
    )]  # fmt: skip
    results = quiet(sweep_runs.draws, some, workers=1, out=tmp_path)
    assert results.outcomes == {"done": 6}
    rows = list(csv.DictReader((tmp_path / "runs.csv").open()))
    assert [row["kind"] for row in rows] == [
        "true", "[1, 2]", "[0.5]", "\\ud800", str(10**400), "a.yaml"]  # fmt: skip
    assert quiet(sweep_runs.draws, some, workers=1, out=tmp_path).effort.runs == 0
    assert "6 runs: 6 done" in results.table()
    assert results.array()["kind"].tolist()[0] == "true"
    with pytest.raises(PointsError, match="a value of 'kind' must be a number"):
        quiet(sweep_runs.draws, [{"x": 1, "kind": object()}], workers=1)
