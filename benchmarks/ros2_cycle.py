#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The control's cycles with and without the bridge to ROS 2, in turns: the emulated WAM in real time, its joint states read by
a program with Fast DDS.

usage: ros2_cycle.py BUILD_FOLDER [--turns N] [--seconds S]

Prints for each thread of the control the median time of a cycle without and with the bridge, the median over the turns
of their ratio, and the cycles that were skipped.
"""
import argparse
import re
import statistics
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
LINE = re.compile(r"thread (\w+): (\d+) cycles run, (\d+) skipped; a cycle took ([\d.]+) us \(median\), ([\d.]+) us at most")
WITHOUT = """
include: {source}/robots/wam/deployments/npid7.yaml
components:
  Generator: {{override: true, model: nAxesGeneratorTaught, peers: [Arming, WAM]}}
"""
DOMAIN = "65"
NOT_CONTROL = ("ros", "Diagnostics", "Clock", "service")


def run(program, deployment, seconds, *options):
    """{thread: (cycles, skipped, median, longest)} of a run"""
    done = subprocess.run([program, "run", "--statistics", "--for", f"{seconds}s", *options, deployment],
                          capture_output=True, text=True)
    found = {name: (int(run), int(skipped), float(median), float(longest))
             for name, run, skipped, median, longest in LINE.findall(done.stdout + done.stderr)}
    if done.returncode not in (0, 4) or not found:
        sys.exit(done.stdout + done.stderr)
    return {name: figures for name, figures in found.items() if name not in NOT_CONTROL}, done.returncode


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--turns", type=int, default=10)
    parser.add_argument("--seconds", type=int, default=5)
    arguments = parser.parse_args()
    program = arguments.build / "bin/armature"
    without = arguments.build / "ros2_cycle_without.yaml"
    without.write_text(WITHOUT.format(source=SOURCE))
    listener = subprocess.Popen([arguments.build / "tests/ros2_commander", DOMAIN, "listen", "rt/joint_states"],
                                stdout=subprocess.PIPE, text=True)
    turns = []
    ended_early = [0, 0]
    try:
        for _ in range(arguments.turns):
            bare, left = run(program, without, arguments.seconds)
            bridged, right = run(program, SOURCE / "examples/13_ros2/wam.yaml", arguments.seconds, "--set", f"domain={DOMAIN}")
            ended_early[0] += left != 0
            ended_early[1] += right != 0
            turns.append((bare, bridged))
    finally:
        listener.terminate()
    received = listener.communicate()[0].split()[-1:]
    print(f"{arguments.turns} turns of {arguments.seconds} s without and with the bridge; a program with Fast DDS read "
          f"{received[0] if received else 0} joint states")
    print(f"runs that ended early, since data was too old: {ended_early[0]} without, {ended_early[1]} with")
    for name in sorted(turns[0][0]):
        pairs = [(bare[name], bridged[name]) for bare, bridged in turns if name in bare and name in bridged]
        ratio = statistics.median(bridged[2] / bare[2] for bare, bridged in pairs)
        print(f"{name}: a cycle takes {statistics.median(bare[2] for bare, _ in pairs):.1f} us without, "
              f"{statistics.median(bridged[2] for _, bridged in pairs):.1f} us with (medians), ratio {ratio:.3f}; "
              f"skipped {sum(bare[1] for bare, _ in pairs)} of {sum(bare[0] for bare, _ in pairs)} without, "
              f"{sum(bridged[1] for _, bridged in pairs)} of {sum(bridged[0] for _, bridged in pairs)} with")


if __name__ == "__main__":
    main()
