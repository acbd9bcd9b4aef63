#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The control's cycles with and without the bridge to ROS 2, in turns: the emulated WAM in real time, whose joint states a
program with Fast DDS reads.

usage: ros2_cycle.py BUILD_FOLDER [--turns N] [--seconds S]
"""
import argparse
import subprocess
from pathlib import Path

from traced_cycles import Run, report

SOURCE = Path(__file__).resolve().parent.parent
WITHOUT = """
include: {source}/robots/wam/deployments/npid7.yaml
components:
  Generator: {{override: true, model: nAxesGeneratorTaught, peers: [Arming, WAM]}}
"""
DOMAIN = "65"
THREADS = ("Sampler", "Generator", "Arming")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--turns", type=int, default=10)
    parser.add_argument("--seconds", type=int, default=5)
    arguments = parser.parse_args()
    without = arguments.build / "ros2_cycle_without.yaml"
    without.write_text(WITHOUT.format(source=SOURCE))
    listener = subprocess.Popen([arguments.build / "tests/ros2_commander", DOMAIN, "listen", "rt/joint_states"],
                                stdout=subprocess.PIPE, text=True)

    def run(deployment, *options):
        return Run(arguments.build, arguments.seconds, deployment, options, THREADS, "Sampler", "WAM")

    pairs = []
    try:
        for _ in range(arguments.turns):
            pairs.append((run(without), run(SOURCE / "examples/13_ros2/wam.yaml", "--set", f"domain={DOMAIN}")))
    finally:
        listener.terminate()
    received = listener.communicate()[0].split()[-1:]
    without.unlink()
    print(f"{arguments.turns} turns of {arguments.seconds} s without and with the bridge; a program with Fast DDS read "
          f"{received[0] if received else 0} joint states")
    report(pairs, THREADS, "Sampler")


if __name__ == "__main__":
    main()
