#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The campaign of configurations of the WAM as a sweep: what passes the check moves no arm.

    cmake --build --preset dev --target configurations_campaign
    python3 python/examples/wam_configurations.py --mutants 1000 --out build/wam_configurations

A run is a mutant of a deployment that is shipped, named by its seed. It is refused by the check, or
tried out on the simulated arm and judged by where that really is (tests/configurations). So a run
here is a process of that program; `armature.sweeps.each` gives them to the workers of this machine,
or with --scheduler to those of a cluster, where the program is at the same path.
"""
from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from collections import Counter
from functools import partial
from pathlib import Path

from armature.sweeps import each, grid

ROOT = Path(__file__).resolve().parents[2]
ROBOTS = {
    "wam4": "MutantConfigurations.OfTheWamWithFourJointsAreRefusedOrMoveWithinBounds",
    "wam7": "MutantConfigurations.OfTheWamWithSevenJointsAreRefusedOrMoveWithinBounds",
}
OUTCOMES = ["refused", "not started", "not armed", "faulted", "quiet", "UNSAFE"]


def try_mutant(program, point, folder):
    """Tries one mutant; `unsafe` is 1 for one that passed the check and moved what it may not."""
    done = subprocess.run(
        [program, f"--gtest_filter={ROBOTS[point['robot']]}"],
        env={**os.environ, "CONFIGURATION": str(point["seed"])},
        capture_output=True,
        text=True,
        timeout=600,
    )
    told = re.search(
        rf"^{point['robot']} {point['seed']}, (.*): ({'|'.join(OUTCOMES)}), ?(.*)$",
        done.stdout,
        re.MULTILINE,
    )
    if told is None:
        raise RuntimeError(f"the campaign says nothing of this mutant: {done.stdout[-200:]!r}")
    found = {outcome.replace(" ", "_").lower(): 0 for outcome in OUTCOMES}
    found[told[2].replace(" ", "_").lower()] = 1
    return {"unsafe": found.pop("unsafe"), **found}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument(
        "--program", type=Path, default=ROOT / "build/dev/tests/configurations_campaign"
    )
    arguments.add_argument("--mutants", type=int, default=1000, help="of each arm")
    arguments.add_argument("--out", type=Path, help="the folder of the sweep; without one, no page")
    arguments.add_argument("--workers", type=int, help="processes of this machine")
    arguments.add_argument("--scheduler", help="address of a Dask scheduler")
    given = arguments.parse_args()
    if not given.program.exists():
        sys.exit(f"{given.program} is missing: build configurations_campaign, or give --program")

    client = None
    if given.scheduler:
        from distributed import Client

        client = Client(given.scheduler)
    results = each(
        partial(try_mutant, str(given.program.resolve())),
        grid({"robot": list(ROBOTS), "seed": range(given.mutants)}),
        client=client,
        workers=given.workers,
        out=given.out,
        title="Configurations of the WAM",
    )
    counts = Counter(
        (run.point["robot"], name) for run in results for name in run.metrics if run.metrics[name]
    )
    columns = [outcome.replace(" ", "_").lower() for outcome in OUTCOMES]
    print(f"{'':6}" + "".join(f"{name:>13}" for name in columns))
    for robot in ROBOTS:
        print(f"{robot:6}" + "".join(f"{counts[robot, name]:13}" for name in columns))
    unsafe = [run for run in results if not run.done or run.metrics["unsafe"]]
    for run in unsafe:
        print(f"{run.point['robot']}, seed {run.point['seed']}: {run.reason or 'UNSAFE'}")
    sys.exit(1 if unsafe else 0)


if __name__ == "__main__":
    main()
