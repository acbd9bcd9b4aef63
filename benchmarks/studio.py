#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the studio takes: `armature check --serve` for a change of a text with 1000 components and for
the ports that fit one of them; with --browsers the page in chromium, and what browsers cost that
watch a run (studio_page.mjs, studio_watch.ts; they need web/node_modules).

usage: studio.py PROGRAM [--json FILE] [--rounds N] [--browsers]
"""

import argparse
import json
import os
import subprocess
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROWS = 333  # of three components each, beside the source
# At most so much; of ratios, where there is a reference.
BOUNDS = {"studio/edit/p99": 150.0, "studio/fits/p99": 30.0, "studio/open_1000": 2.0,
          "studio/pan_1000/p50": 33.0, "studio/bundle/first_page_kB": 220.0,
          "studio/bundle/all_kB": 560.0, "studio/watch_200_at_60hz/age_p99": 100.0,
          "studio/server_cpu": 25.0, "studio/server_resident": 60.0,
          "studio/run_cpu_of_4_browsers": 1.5,
          "studio/cycle_with_browsers/median": 1.02, "studio/cycle_with_browsers/p99.9": 1.05,
          "studio/cycle_with_browsers/skipped": 0.0}
LEAST = {"studio/watch_200_at_60hz/frames": 58.0}


def deployment():
    components = ["  Source: {model: Constant, activity: {periodic: 10 ms}}"]
    connections = []
    for i in range(ROWS):
        before = f"Limit{i - 1}.Out" if i else "Source.Out"
        components += [f"  Adder{i}: {{model: Adder}}",
                       f"  Limit{i}: {{model: Limit, properties: {{High: 1}}}}",
                       f"  Comparator{i}: {{model: Comparator}}"]
        connections += [f"  - Source.Out -> Adder{i}.In1", f"  - {before} -> Adder{i}.In2",
                        f"  - Adder{i}.Out -> Limit{i}.In", f"  - Limit{i}.Out -> Comparator{i}.In"]
    return "\n".join(["application: edited", "libraries: [controls]", "components:", *components,
                      "connections:", *connections, ""])


class Checker:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "check", "--serve"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def ask(self, **request):
        """[ms] until the answer, and the answer."""
        begin = time.perf_counter()
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        return 1e3 * (time.perf_counter() - begin), answer["result"]

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def edits(checker, rounds):
    """Every other text has a mistake, which is found."""
    text = deployment()
    times = []
    for i in range(rounds):
        edited = text.replace("High: 1", f"High: {i + 2}", 1)
        if i % 2:
            edited = edited.replace("Comparator7.In", "Comparator7.Inn")
        took, result = checker.ask(do="check", file="edited.yaml", texts={"edited.yaml": edited},
                                   members=False)
        assert result["ok"] == (i % 2 == 0), result["diagnostics"]
        times.append(took)
    return times


def fits(checker, rounds):
    times = []
    for _ in range(rounds):
        took, result = checker.ask(do="fitting", component="Source", member="Out", models=True)
        assert len(result["ends"]) == 5 * ROWS and result["models"]
        times.append(took)
    return times


def percentile(times, share):
    return sorted(times)[min(len(times) - 1, int(share * len(times)))]


def entry_of(name, times):
    return {"name": name, "value": percentile(times, 0.99), "unit": "ms", "reference": None,
            "ratio": None, "allocations": None}


def check(program, rounds):
    checker = Checker(program)
    entries = [entry_of("studio/edit/p99", edits(checker, rounds)),
               entry_of("studio/fits/p99", fits(checker, rounds))]
    checker.end()
    return entries


def node(*arguments):
    return json.loads(subprocess.run(["node", *arguments], check=True, stdout=subprocess.PIPE).stdout)


def watching(program, folder, *arguments):
    """studio_watch.ts needs what rcidl makes of the two interfaces, and the runtime of the tree."""
    interfaces = ("armature/remote/inspection.idl", "armature/studio/workbench.idl")
    for idl in interfaces:
        rcidl = os.path.join(os.path.dirname(program), "rcidl")
        subprocess.run([rcidl, os.path.join(ROOT, idl), "--typescript", "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
    bundle = os.path.join(folder, "studio_watch.mjs")
    ride = os.path.join(ROOT, "web/ride/src")
    subprocess.run([os.path.join(ROOT, "web/node_modules/esbuild/bin/esbuild"), "--bundle",
                    "--format=esm", "--platform=node", "--log-level=warning",
                    f"--alias:@armature/ride/tcp={ride}/tcp.ts", f"--alias:@armature/ride={ride}/ride.ts",
                    f"--alias:@armature/placeholders={folder}", f"--outfile={bundle}",
                    os.path.join(ROOT, "benchmarks/studio_watch.ts")], check=True)
    return node(bundle, program, os.path.join(ROOT, "robots"), *arguments)


def page(program, folder):
    file = os.path.join(folder, "thousand.yaml")
    with open(file, "w", encoding="utf-8") as to:
        to.write(deployment())
    return node(os.path.join(ROOT, "benchmarks/studio_page.mjs"), program, file)


def show(entry):
    name, measured = entry["name"], entry["ratio"] or entry["value"]
    missed = measured > BOUNDS.get(name, measured) or measured < LEAST.get(name, measured)
    bound = f"at least {LEAST[name]:g}" if name in LEAST else "for comparison"
    bound = f"at most {BOUNDS[name]:g}" if name in BOUNDS else bound
    ratio = f", {entry['ratio']:.3f} of {entry['reference']:.3g}" if entry["ratio"] else ""
    print(f"{name:36} {entry['value']:8.4g} {entry['unit']:6}  ({bound}{ratio}{': missed' if missed else ''})")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--json")
    parser.add_argument("--rounds", type=int, default=200)
    parser.add_argument("--browsers", action="store_true")
    parser.add_argument("--watching", action="store_true", help="only tries what watches: one second")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    entries = check(program, arguments.rounds)
    if arguments.browsers:
        with tempfile.TemporaryDirectory() as folder:
            entries += page(program, folder) + watching(program, folder)
    if arguments.watching:
        with tempfile.TemporaryDirectory() as folder:
            entries += watching(program, folder, "--seconds", "1", "--rounds", "1")
    for entry in entries:
        show(entry)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(entries, file, indent=1)


if __name__ == "__main__":
    main()
