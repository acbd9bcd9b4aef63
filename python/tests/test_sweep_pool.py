# SPDX-License-Identifier: Apache-2.0
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
import sweep_runs
from sweep_checks import bits

from armature.sweeps import Interrupted, Pool, PoolError, each, points

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
    undisturbed = quiet(sweep_runs.slow, [dict(p, seconds=0.0) for p in some], workers=1)
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
        f"each(sweep_runs.slow, [{{'x': 1, 'marks': {str(tmp_path)!r}, 'seconds': 600}}], workers=1)"
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


def is_running(process):
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


def test_a_pool_has_a_worker():
    with pytest.raises(PoolError, match="number of workers must be 1 or more, found 0"):
        Pool(0)


def test_what_cannot_be_sent_is_said_before_anything_runs():
    lock = threading.Lock()
    with pytest.raises(TypeError, match="cannot be sent to another process.*use a function"):
        quiet(lambda point, folder: {"cost": float(lock.locked())}, [{"x": 1}], workers=1)


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

    rest = [dict(point, seconds=0.0) for point in some]  # other points: nothing is reused
    assert quiet(sweep_runs.slow, rest, workers=2, out=out).effort.runs == 24
    whole = quiet(sweep_runs.slow, some[:12], workers=2, out=out)
    assert whole.effort.runs == 12 - sum(run.number < 12 for run in partial)
    assert whole.outcomes == {"done": 12}


def interrupt_when(ready):
    """Ctrl-C, as the terminal sends it to this process."""

    def wait_and_send():
        while not ready():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=wait_and_send, daemon=True).start()
