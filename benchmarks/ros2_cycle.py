#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The control's cycles with and without the bridge to ROS 2, in turns: the emulated WAM in real time, whose joint states a
program with Fast DDS reads.

usage: ros2_cycle.py BUILD_FOLDER [--turns N] [--seconds S]

Prints for each thread of the control how long its cycles take without and with the bridge (medians over all cycles of a
turn, then over turns; of the Sampler's thread also without the steps of the emulated arm), the median of their ratios, and
the cycles that were skipped.
"""
import argparse
import bisect
import json
import re
import statistics
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
SKIPPED = re.compile(r"thread (\w+): (\d+) cycles run, (\d+) skipped")
WITHOUT = """
include: {source}/robots/wam/deployments/npid7.yaml
components:
  Generator: {{override: true, model: nAxesGeneratorTaught, peers: [Arming, WAM]}}
"""
DOMAIN = "65"
CONTROL = ("Sampler", "Generator", "Arming")
EMULATED = "WAM"


def cycles_of(trace):
    """{thread: durations of its cycles [us]}, and "control" for the Sampler's without the emulated arm."""
    events = json.loads(trace.read_text())
    threads = {each["tid"]: each["args"]["name"] for each in events if each["name"] == "thread_name"}
    cycles = {name: [] for name in CONTROL}
    begins, emulated = [], []
    for each in events:
        name = threads.get(each.get("tid"))
        if name not in CONTROL or each["ph"] != "X":
            continue
        if each["cat"] == "cycle":
            cycles[name].append(each["dur"])
            if name == "Sampler":
                begins.append(each["ts"])
                emulated.append(0.0)
    for each in events:
        if each["ph"] == "X" and each["cat"] == "step" and each["name"] == EMULATED and threads[each["tid"]] == "Sampler":
            index = bisect.bisect_right(begins, each["ts"]) - 1
            if index >= 0:
                emulated[index] += each["dur"]
    cycles["control"] = [whole - arm for whole, arm in zip(cycles["Sampler"], emulated) if arm > 0.0]
    return {name: durations for name, durations in cycles.items() if durations}


def run(arguments, deployment, *options):
    """({thread: median of its cycles [us]}, {thread: (cycles, skipped)}, whether it ran to its end)"""
    trace = arguments.build / "ros2_cycle_trace.json"
    done = subprocess.run([arguments.build / "bin/armature", "run", "--statistics", "--trace", trace, "--for",
                           f"{arguments.seconds}s", *options, deployment], capture_output=True, text=True)
    if done.returncode not in (0, 1, 4):
        sys.exit(done.stdout + done.stderr)
    medians = {name: statistics.median(durations) for name, durations in cycles_of(trace).items()}
    counts = {name: (int(cycles), int(skipped)) for name, cycles, skipped in SKIPPED.findall(done.stdout + done.stderr)}
    trace.unlink()
    return medians, counts, done.returncode == 0


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
    turns = []
    try:
        for _ in range(arguments.turns):
            turns.append((run(arguments, without),
                          run(arguments, SOURCE / "examples/13_ros2/wam.yaml", "--set", f"domain={DOMAIN}")))
    finally:
        listener.terminate()
    received = listener.communicate()[0].split()[-1:]
    without.unlink()
    print(f"{arguments.turns} turns of {arguments.seconds} s without and with the bridge; a program with Fast DDS read "
          f"{received[0] if received else 0} joint states")
    ended = [sum(not turn[side][2] for turn in turns) for side in (0, 1)]
    print(f"runs that ended early, since data was too old: {ended[0]} without, {ended[1]} with")
    # What is out of service computes nothing.
    whole = [turn for turn in turns if turn[0][2] and turn[1][2]]
    if not whole:
        sys.exit("no turn ran to its end without and with the bridge")
    print(f"of the {len(whole)} turns in which both ran to their end:")
    for name in ("control", *CONTROL):
        pairs = [(bare[0][name], bridged[0][name]) for bare, bridged in whole]
        ratio = statistics.median(bridged / bare for bare, bridged in pairs)
        of = "Sampler, without the emulated arm" if name == "control" else name
        print(f"{of}: a cycle takes {statistics.median(bare for bare, _ in pairs):.2f} us without, "
              f"{statistics.median(bridged for _, bridged in pairs):.2f} us with; ratio {ratio:.3f}")
    for name in CONTROL:
        cycles, skipped = zip(*((sum(turn[side][1][name][0] for turn in whole), sum(turn[side][1][name][1] for turn in whole))
                                for side in (0, 1)))
        print(f"{name}: skipped {skipped[0]} of {cycles[0]} cycles without, {skipped[1]} of {cycles[1]} with")


if __name__ == "__main__":
    main()
