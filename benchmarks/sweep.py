#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a sweep costs beside its runs: measured on this machine, and from that an estimate for many.

usage: sweep.py [--runs N] [--seconds S] [--workers W] [--dask] [--json FILE]

The runs are those of Janus with random gains, each so many seconds of simulated time. Overhead is
(wall time * workers - the runs' own time) / the runs' own time; a run's own time is measured around
it, in its worker: loading, simulating, measuring.
"""

import argparse
import contextlib
import json
import math
import os
import pickle
import statistics
import sys
import time
from pathlib import Path

import armature
from armature.sweeps import Following, Pool, each
from armature.sweeps.points import random

ROOT = Path(__file__).resolve().parents[1]
DEPLOYMENT = ROOT / "robots/janus/deployments/pid.yaml"
# Within what the check accepts.
GAINS = {f"PID{i}.{name}": ends for i in (1, 2)
         for name, ends in {"Kp": (100.0, 350.0), "Ki": (5.0, 20.0), "Kd": (100.0, 200.0)}.items()}
WORKERS_OF_A_HOST, HOSTS = 4, 100
BOUND = 0.05  # of overhead


class Motion:
    """Janus moves back and forth for `seconds`, sampled ten times a second."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __call__(self, app):
        wall, cpu = time.perf_counter(), time.process_time()
        app.run_for(0.1)
        app.Arming.arm()
        following = Following(app, [("PID1.Ref", "PID1.Sen"), ("PID2.Ref", "PID2.Sen")], period=0.1)
        for i in range(math.ceil(self.seconds / 6)):
            app.Generator.moveTo.begin([0.4 + i % 2, 0.4 + i % 2], 3.0)
            following.run_until(min(self.seconds, 6.0 * (i + 1)))
        return {"iae": sum(joint.iae for joint in following.joints),
                "wall_s": time.perf_counter() - wall, "cpu_s": time.process_time() - cpu}


def nothing(point, folder):
    """A run that takes no time: what is left is what each run costs."""
    return {"cost": point["x"]}


def say(entries, name, value, unit, note=""):
    entries.append({"name": name, "value": value, "unit": unit})
    print(f"{name:44} {value:12.5g} {unit:4} {note}", flush=True)


def measure(entries, label, runs, seconds, where):
    points = random(GAINS, runs, seed=1)
    results = armature.sweep(DEPLOYMENT, points, Motion(seconds), **where)
    if results.outcomes != {"done": runs}:
        sys.exit(f"{results.summary()}: {next(run.reason for run in results if run.reason)}")
    name = f"sweep/{label}/{runs}_runs_of_{seconds:g}_s"
    own = [run.seconds for run in results]
    say(entries, f"{name}/wall", results.effort.wall_s, "s", f"{results.effort.workers} workers")
    cpu_s = statistics.median(run.metrics["cpu_s"] for run in results)
    load_s = statistics.median(run.seconds - run.metrics["wall_s"] for run in results)
    say(entries, f"{name}/run/median", statistics.median(own), "s", "own time, of the wall's clock")
    say(entries, f"{name}/run/load", load_s, "s", "of it until the application has started")
    say(entries, f"{name}/run/cpu", cpu_s, "s",
        f"of the processor after that: {seconds / cpu_s:.0f} times as fast as real time")
    say(entries, f"{name}/overhead", 100 * results.effort.overhead, "%",
        f"at most {100 * BOUND:.0f}" if results.effort.overhead <= BOUND else "MORE THAN 5")
    return results, load_s + cpu_s


def measure_task(entries, label, where, count=1000):
    """Wall time, and processor time of this process: with Dask those of client and scheduler."""
    points = [{"x": x} for x in range(count)]
    each(nothing, points[:20], progress=False, **where)
    wall, cpu = time.perf_counter(), time.process_time()
    each(nothing, points, progress=False, **where)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    say(entries, f"sweep/{label}/task", 1e3 * wall / count, "ms", "wall time for each run")
    say(entries, f"sweep/{label}/task/cpu", 1e3 * cpu / count, "ms",
        "of which the sweep's own process computes")
    return cpu / count


def estimate(task_s, run_s, start_s, size):
    """Hosts whose processors are as fast as this one, and have nothing else to do."""
    workers = WORKERS_OF_A_HOST * HOSTS
    print(f"\nExtrapolated: {HOSTS} hosts, {WORKERS_OF_A_HOST} workers each; a run takes {run_s:.2f} s "
          f"of a processor, a task {1e3 * task_s:.2f} ms of the scheduler's")
    print(f"{'runs':>8} {'batch':>5} {'ideal':>9} {'estimated':>10} {'overhead':>9}   of which")
    for runs in (1000, 10_000, 100_000):
        for batch in (1, 5):
            ideal = runs * run_s / workers
            tasks = math.ceil(runs / batch)
            working = math.ceil(tasks / workers) * (batch * run_s + task_s)
            wall = start_s + max(working, tasks * task_s)
            print(f"{runs:8} {batch:5} {ideal:8.1f}s {wall:9.1f}s {100 * (wall - ideal) / ideal:8.1f}%   "
                  f"start {start_s:.1f} s, workers {working:.1f} s, scheduler {tasks * task_s:.1f} s, "
                  f"results {runs * size / 1e6:.1f} MB")
    print(f"One scheduler keeps {run_s / task_s:.0f} workers busy with such runs, "
          f"and {5 * run_s / task_s:.0f} with batch=5.")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--runs", type=int, default=200)
    arguments.add_argument("--seconds", type=float, default=60.0)
    arguments.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    arguments.add_argument("--dask", action="store_true", help="the same on Dask's LocalCluster")
    arguments.add_argument("--json", type=Path)
    given = arguments.parse_args()
    entries = []
    print(f"{os.cpu_count()} processors, load before: {os.getloadavg()[0]:.1f}")

    with Pool(given.workers) as pool:
        measure_task(entries, "pool", {"workers": pool})
        start_s = statistics.median(pool.start_seconds)
        say(entries, "sweep/pool/start_of_a_worker", start_s, "s")
        results, run_s = measure(entries, "pool", given.runs, given.seconds, {"workers": pool})
    size = len(pickle.dumps(results[0]))
    say(entries, "sweep/data_back", size, "B", "for each run")

    if given.dask:
        with contextlib.ExitStack() as stack:
            client, cluster_s = start_cluster(stack, given.workers)
            say(entries, "sweep/dask/start_of_a_cluster", cluster_s, "s", "scheduler and workers")
            start_s = max(start_s, cluster_s)
            task_s = measure_task(entries, "dask", {"client": client})
            measure(entries, "dask", given.runs, given.seconds, {"client": client})
        estimate(task_s, run_s, start_s, size)
    print(f"load after: {os.getloadavg()[0]:.1f}")
    if given.json:
        given.json.write_text(json.dumps(entries, indent=1) + "\n", encoding="utf-8")


def start_cluster(stack, workers):
    from distributed import Client, LocalCluster

    begin = time.perf_counter()
    os.environ["PYTHONPATH"] = os.pathsep.join(sys.path)
    cluster = stack.enter_context(LocalCluster(n_workers=workers, threads_per_worker=1,
                                               processes=True, dashboard_address=None))
    client = stack.enter_context(Client(cluster))
    client.wait_for_workers(workers)
    return client, time.perf_counter() - begin


if __name__ == "__main__":
    main()
