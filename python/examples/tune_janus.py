#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tunes the PIDs of Janus, and compares them with the gains of its deployment.

    python3 python/examples/tune_janus.py --out build/tune_janus

scipy's differential evolution asks for gains whose IAE over paper 1's experiment is least. Each of
its generations is a sweep: all its runs at once, on the cores of this machine or, with --scheduler,
on those of a cluster. Gains that would shake a joint are refused by the deployment's check, and
cost more than any other. The best ones and those of the deployment are then run on heads that are
20 % off, which the check does not know of.
"""
from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy
from scipy.optimize import differential_evolution

import armature
from armature.sweeps import Following, Pool, Results

ROOT = Path(__file__).resolve().parents[2]
DEPLOYMENT = ROOT / "robots/janus/deployments/pid.yaml"
URDF = ROOT / "robots/janus/janus.urdf"

#: Of robots/janus/deployments: with them the head is below the figures of the papers, which print no gains.
DEPLOYMENTS_GAINS = {"Kp": 400.0, "Ki": 20.0, "Kd": 200.0}
#: Where gains are looked for, by their logarithm.
RANGES = {"Kp": (50.0, 800.0), "Ki": (5.0, 200.0), "Kd": (20.0, 400.0)}

#: Paper 1, table 2: after so many seconds to these positions, in so many seconds.
MOTIONS = [
    (5, [1.0, 1.0], 10.0),
    (17, [2.0, 2.0], 9.0),
    (28, [3.0, 1.0], 8.0),
    (38, [1.0, 3.0], 7.0),
    (47, [4.0, 4.0], 5.0),
    (54, [0.0, 0.0], 5.0),
]
SECONDS = 60


def experiment(app):
    """The experiment of paper 1 on the head `app`: IAE of each joint, and of both."""
    app.run_for("100 ms")  # the cards answer
    app.Arming.arm()
    following = Following(app, [("PID1.Ref", "PID1.Sen"), ("PID2.Ref", "PID2.Sen")], period=0.01)
    for begin, positions, duration in MOTIONS:
        following.run_until(begin)
        app.Generator.moveTo.begin(positions, duration)
    following.run_until(SECONDS)
    one, two = following.joints
    return {
        "iae": one.iae + two.iae,
        "iae_1": one.iae,
        "iae_2": two.iae,
        "largest": max(one.largest, two.largest),
    }


def of_both(gains):
    """The same gains for both joints, as in the deployment."""
    return {f"PID{joint}.{name}": float(gains[name]) for joint in (1, 2) for name in gains}


def head(factor, folder):
    """A head whose masses, inertias and frictions are those of Janus times `factor`."""
    import re

    scaled = re.sub(
        r'(mass value|ixx|iyy|izz|damping|friction)="([^"]+)"',
        lambda found: f'{found[1]}="{float(found[2]) * factor!r}"',
        URDF.read_text(encoding="utf-8"),
    )
    file = folder / f"janus_{factor}.urdf"
    file.write_text(scaled, encoding="utf-8")
    return str(file.resolve())


class Tuning:
    """What differential evolution asks for, as sweeps in one folder."""

    def __init__(self, out: Path, **where):
        self.out = out
        self.where = where
        self.asked = 0

    def run(self, points) -> Results:
        return armature.sweep(DEPLOYMENT, points, experiment, out=self.out, **self.where)

    def costs(self, population: numpy.ndarray) -> numpy.ndarray:
        """@param population  logarithms of gains: a row for each gain, a column for each candidate"""
        gains = [dict(zip(RANGES, numpy.exp(column))) for column in numpy.atleast_2d(population.T)]
        self.asked += len(gains)
        results = self.run([of_both(each) for each in gains])
        return numpy.array([run.metrics.get("iae", math.inf) for run in results])

    def best(self, generations: int, candidates: int, seed: int) -> dict[str, float]:
        bounds = [(math.log(low), math.log(high)) for low, high in RANGES.values()]
        found = differential_evolution(
            self.costs, bounds, init="sobol", maxiter=generations, popsize=candidates, seed=seed,
            updating="deferred", vectorized=True, polish=False, tol=1e-3,
        )  # fmt: skip
        return dict(zip(RANGES, map(float, numpy.exp(found.x))))


def robustness(tuned, out, where):
    """Both sets of gains on heads that are as described and 20 % off."""
    out.mkdir(parents=True, exist_ok=True)
    points = [
        {**of_both(gains), "Cards.robot_description": head(factor, out)}
        for factor in (1.0, 0.8, 1.2)
        for gains in (DEPLOYMENTS_GAINS, tuned)
    ]
    results = armature.sweep(DEPLOYMENT, points, experiment, out=out, **where)
    print(f"\n{'head':>6}  {'gains':>10}  {'IAE 1':>9}  {'IAE 2':>9}  {'both':>9}  {'largest':>9}")
    share = {}
    for i, factor in enumerate((1.0, 0.8, 1.2)):
        for name, run in zip(("deployment", "tuned"), results[2 * i : 2 * i + 2]):
            m = run.metrics
            print(f"{factor:6.1f}  {name:>10}  " + (
                f"{m['iae_1']:9.5f}  {m['iae_2']:9.5f}  {m['iae']:9.5f}  {m['largest']:9.5f}"
                if run.done else f"{run.outcome}: {run.reason}"))  # fmt: skip
        deployment, best = results[2 * i : 2 * i + 2]
        if deployment.done and best.done:
            share[factor] = best.metrics["iae"] / deployment.metrics["iae"]
    for factor, each in share.items():
        print(f"head {factor}: the IAE is {100 * (1 - each):.0f} % below that of the deployment's gains")
    return list(share.values())


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=Path("tune_janus"), help="the folder of its sweeps")
    arguments.add_argument("--generations", type=int, default=15)
    arguments.add_argument("--candidates", type=int, default=8, help="in a generation, for each gain")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--workers", type=int, help="processes of this machine; as many as it has cores")
    arguments.add_argument("--scheduler", help="address of a Dask scheduler whose workers do the runs")
    given = arguments.parse_args()

    if given.scheduler:
        from distributed import Client

        with Client(given.scheduler) as client:
            tune(given, {"client": client})
    else:
        with Pool(given.workers) as pool:
            tune(given, {"workers": pool})


def tune(given, where):
    tuning = Tuning(given.out / "search", **where)
    tuned = tuning.best(given.generations, given.candidates, given.seed)
    print(f"{tuning.asked} sets of gains, the best: " + ", ".join(
        f"{name} {value:.4g}" for name, value in tuned.items()))  # fmt: skip
    robustness(tuned, given.out / "robustness", where)
    print(f"pages: {given.out / 'search/sweep.html'}, {given.out / 'robustness/sweep.html'}")


if __name__ == "__main__":
    main()
