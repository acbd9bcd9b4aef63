#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a step costs through Python: each instant of a small application asked for by `step`, beside the same time in one
`run_for`. In turns; CPU time of the process, so that others on the machine count little.

    PYTHONPATH=build/release/lib/python3/dist-packages /usr/bin/python3 benchmarks/python_step.py
"""
import statistics
import tempfile
import time
from pathlib import Path

import armature

ROUNDS = 31
SIMULATED_S = 20.0
# Little to do at each instant, so that what is looked for is not lost in it.
DEPLOYMENT = """application: small
libraries: [controls]
components:
  Slider: {model: Slider, activity: {periodic: 1 ms}}
"""


def stepped(deployment):
    with deployment.application() as app:
        steps = 0
        begin = time.process_time()
        while app.step() < SIMULATED_S:
            steps += 1
        return time.process_time() - begin, steps + 1


def at_once(deployment):
    with deployment.application() as app:
        begin = time.process_time()
        app.run_for(SIMULATED_S)
        return time.process_time() - begin


def looked_at(deployment):
    """A port read and an operation called, each."""
    with deployment.application() as app:
        app.run_for(0.1)
        count = 20000
        begin = time.process_time()
        for _ in range(count):
            app.Slider.Out.value
        read = time.process_time() - begin
        begin = time.process_time()
        for _ in range(count):
            app.Slider.move(0.5)
        return read / count, (time.process_time() - begin) / count


def main():
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "small.yaml"
        file.write_text(DEPLOYMENT)
        measure(armature.load(file))


def measure(deployment):
    by_step, in_one, costs = [], [], []
    for _ in range(ROUNDS):
        seconds, steps = stepped(deployment)
        whole = at_once(deployment)
        by_step.append(seconds / steps * 1e6)
        in_one.append(whole / steps * 1e6)
        costs.append((seconds - whole) / steps * 1e6)
    read, call = looked_at(deployment)
    print(f"{ROUNDS} rounds of {SIMULATED_S:g} s with {steps} instants each, medians of CPU time")
    print(f"an instant, by Application.step():   {statistics.median(by_step):6.2f} us")
    print(f"an instant, within one run_for():    {statistics.median(in_one):6.2f} us")
    print(f"what a step costs through Python:    {statistics.median(costs):6.2f} us, from {min(costs):.2f} to {max(costs):.2f}")
    print(f"a port's value read:                 {read * 1e6:6.2f} us")
    print(f"an operation called:                 {call * 1e6:6.2f} us")


if __name__ == "__main__":
    main()
