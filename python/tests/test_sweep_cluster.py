# SPDX-License-Identifier: Apache-2.0
"""Sweeps on Dask: a scheduler and workers as processes of this machine, as on a cluster of hosts."""
import os
import signal
import sys
import threading
import time

import pytest
import sweep_runs
from sweep_checks import bits

from armature.sweeps import each, points

pytest.importorskip("cloudpickle")
dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")
SQUARE = points.grid({"x": [-1.5, -0.3, 0.1, 1.0], "y": [0.2, 0.7, 1.0]})


@pytest.fixture(scope="module")
def cluster():
    """Of four workers, since tests kill three: Dask does not start each one again that dies early."""
    os.environ["PYTHONPATH"] = os.pathsep.join(sys.path)  # of its workers
    with dask.config.set({"distributed.scheduler.allowed-failures": 1}):
        with distributed.LocalCluster(
            n_workers=4, threads_per_worker=1, processes=True, dashboard_address=None
        ) as made:
            yield made


@pytest.fixture
def client(cluster):
    with distributed.Client(cluster) as made:
        yield made


def quiet(run_point, some, **options):
    return each(run_point, some, progress=False, **options)


def test_results_are_those_of_a_pool_to_the_bit_on_1_2_and_4_workers(cluster, client):
    here = quiet(sweep_runs.rosenbrock, SQUARE, workers=1)
    for workers in (1, 2, 4):
        cluster.scale(workers)
        client.wait_for_workers(workers)
        while len(client.scheduler_info()["workers"]) != workers:
            time.sleep(0.02)
        there = quiet(sweep_runs.rosenbrock, SQUARE, client=client)
        assert bits(there) == bits(here)
        assert there.effort.workers == workers


def test_runs_in_batches_are_the_same(client):
    one_by_one = quiet(sweep_runs.rosenbrock, SQUARE, client=client)
    assert bits(quiet(sweep_runs.rosenbrock, SQUARE, client=client, batch=5)) == bits(one_by_one)
    with pytest.raises(ValueError, match="runs of a batch must be 1 or more, found 0"):
        quiet(sweep_runs.rosenbrock, SQUARE, client=client, batch=0)


def test_runs_without_result_are_rows(client):
    results = quiet(sweep_runs.picky, [{"x": x} for x in (1, -1, 11, 2)], client=client)
    assert [run.outcome for run in results] == ["done", "refused", "failed", "done"]


def test_a_worker_killed_in_the_middle_has_its_runs_done_again_with_the_same_results(
    client, tmp_path
):
    some = [{"x": x, "marks": str(tmp_path)} for x in range(16)]
    killer = threading.Thread(target=kill_first_that_begins, args=(tmp_path,))
    killer.start()
    results = quiet(sweep_runs.slow, some, client=client)
    killer.join()
    assert results.outcomes == {"done": 16}
    begun = [mark.name.split("-")[0] for mark in tmp_path.iterdir() if "-" in mark.name]
    assert len(begun) > 16  # a run was done twice
    undisturbed = quiet(sweep_runs.slow, [dict(p, takes=0.0) for p in some], workers=1)
    assert [run.metrics for run in results] == [run.metrics for run in undisturbed]


def kill_first_that_begins(marks):
    while not (begun := list(marks.iterdir())):
        time.sleep(0.005)
    os.kill(int(begun[0].name.split("-")[1]), signal.SIGKILL)


def test_a_run_that_kills_every_worker_is_a_row_and_loses_no_other(client):
    results = quiet(sweep_runs.deadly, [{"x": x} for x in range(5)], client=client)
    assert [run.outcome for run in results] == ["done", "lost", "done", "done", "done"]
    assert "workers of the cluster died with it" in results[1].reason


