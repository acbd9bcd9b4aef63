#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a controller in the shadow (docs/replay.md) costs the one that drives: the simulated head at 1 kHz in real time,
with and without the shadow of examples/14_shadow, in turns.

usage: shadow_cost.py BUILD_FOLDER [--turns N] [--seconds S] [--triggered]
"""
import argparse
from pathlib import Path

from traced_cycles import Run, report

SOURCE = Path(__file__).resolve().parent.parent
THREADS = ("Sampler", "Generator", "Arming")
# Within what the check accepts at 1 kHz.
AT_1_KHZ = ["--set", "period=1ms", *(word for pid in ("PID", "PIDFF") for i in (1, 2) for word in ("--set", f"{pid}{i}.Ki=2"))]
TRIGGERED = """
include: {source}/examples/14_shadow/shadow.yaml
components:
  Shadow: {{override: true, activity: {{triggered: true, priority: 5}}}}
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--turns", type=int, default=12)
    parser.add_argument("--seconds", type=int, default=5)
    parser.add_argument("--triggered", action="store_true", help="by its data, so the one that drives wakes it in each cycle")
    arguments = parser.parse_args()
    sides = [SOURCE / "robots/janus/deployments/modes.yaml", SOURCE / "examples/14_shadow/shadow.yaml"]
    if arguments.triggered:
        sides[1] = arguments.build / "shadow_cost_triggered.yaml"
        sides[1].write_text(TRIGGERED.format(source=SOURCE))
    pairs = []
    for turn in range(arguments.turns):
        runs = {}
        for side in (turn % 2, 1 - turn % 2):  # who comes first changes, too
            runs[side] = Run(arguments.build, arguments.seconds, sides[side], AT_1_KHZ, THREADS, "Sampler", "Cards")
        pairs.append((runs[0], runs[1]))
    print(f"{arguments.turns} turns of {arguments.seconds} s without and with the shadow"
          f"{', which is triggered' if arguments.triggered else ''}")
    report(pairs, THREADS, "Sampler")


if __name__ == "__main__":
    main()
