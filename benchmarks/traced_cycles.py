# SPDX-License-Identifier: Apache-2.0
"""How long the cycles of each thread take in runs in real time, by the timeline that `armature run --trace` writes: each
cycle by itself, not by classes of a histogram. The timeline costs all runs the same."""
import bisect
import json
import re
import statistics
import subprocess
import sys

SKIPPED = re.compile(r"thread (\w+): (\d+) cycles run, (\d+) skipped")
# A name beside those of threads: the cycles of the thread that drives the simulated robot, without the steps of that.
CONTROL = "control"


def cycles_of(trace, threads, driving, simulated):
    """{thread: durations of its cycles [us]}, and CONTROL for the `driving` one without the steps of `simulated`."""
    events = json.loads(trace.read_text())
    named = {each["tid"]: each["args"]["name"] for each in events if each["name"] == "thread_name"}
    cycles = {name: [] for name in threads}
    begins, robot = [], []
    for each in events:
        name = named.get(each.get("tid"))
        if name in cycles and each["ph"] == "X" and each["cat"] == "cycle":
            cycles[name].append(each["dur"])
            if name == driving:
                begins.append(each["ts"])
                robot.append(0.0)
    for each in events:
        if each["ph"] == "X" and each["cat"] == "step" and each["name"] == simulated and named[each["tid"]] == driving:
            index = bisect.bisect_right(begins, each["ts"]) - 1
            if index >= 0:
                robot[index] += each["dur"]
    cycles[CONTROL] = [whole - part for whole, part in zip(cycles[driving], robot) if part > 0.0]
    return {name: durations for name, durations in cycles.items() if durations}


class Run:
    """One run in real time."""

    def __init__(self, build, seconds, deployment, options, threads, driving, simulated):
        trace = build / "traced_cycles.json"
        done = subprocess.run([build / "bin/armature", "run", "--statistics", "--trace", trace, "--for", f"{seconds}s",
                               *options, deployment], capture_output=True, text=True)
        if done.returncode not in (0, 1, 4):
            sys.exit(done.stdout + done.stderr)
        cycles = cycles_of(trace, threads, driving, simulated)
        trace.unlink()
        self.medians = {name: statistics.median(durations) for name, durations in cycles.items()}
        self.counts = {name: (int(run), int(skipped)) for name, run, skipped in SKIPPED.findall(done.stdout + done.stderr)}
        self.is_whole = done.returncode == 0


def report(pairs, threads, driving):
    """Prints medians over turns, the median of their ratios, and skipped cycles, of (run without, run with)."""
    print(f"runs that ended early, since data was too old: {sum(not bare.is_whole for bare, _ in pairs)} without, "
          f"{sum(not more.is_whole for _, more in pairs)} with")
    # What is out of service computes nothing.
    whole = [(bare, more) for bare, more in pairs if bare.is_whole and more.is_whole]
    if not whole:
        sys.exit("no turn ran to its end without and with it")
    print(f"of the {len(whole)} turns in which both ran to their end:")
    for name in (CONTROL, *threads):
        medians = [(bare.medians[name], more.medians[name]) for bare, more in whole]
        ratio = statistics.median(more / bare for bare, more in medians)
        of = f"{driving}, without the simulated robot" if name == CONTROL else name
        print(f"{of}: a cycle takes {statistics.median(bare for bare, _ in medians):.2f} us without, "
              f"{statistics.median(more for _, more in medians):.2f} us with; ratio {ratio:.3f}")
    for name in threads:
        # Where nobody reads the console in time, lines of the summary are lost.
        (run, skipped), (run_with, skipped_with) = (
            map(sum, zip(*(each.counts.get(name, (0, 0)) for each in side))) for side in zip(*whole))
        print(f"{name}: skipped {skipped} of {run} cycles without, {skipped_with} of {run_with} with")
