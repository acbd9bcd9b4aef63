#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long `armature check --serve` takes for an editor: a change of a text with 1000 components,
and the ports that fit one of them.

usage: studio.py PROGRAM [--json FILE] [--rounds N]
"""

import argparse
import json
import subprocess
import time

ROWS = 333  # of three components each, beside the source
BOUNDS = {"studio/edit/p99": 150.0, "studio/fits/p99": 30.0}  # [ms]


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
        assert len(result["ends"]) == 4 * ROWS and result["models"]
        times.append(took)
    return times


def percentile(times, share):
    return sorted(times)[min(len(times) - 1, int(share * len(times)))]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--json")
    parser.add_argument("--rounds", type=int, default=200)
    arguments = parser.parse_args()
    checker = Checker(arguments.program)
    measured = {"studio/edit/p99": edits(checker, arguments.rounds),
                "studio/fits/p99": fits(checker, arguments.rounds)}
    checker.end()
    entries = []
    for name, times in measured.items():
        value = percentile(times, 0.99)
        print(f"{name:20} {value:8.1f} ms   (median {percentile(times, 0.5):.1f} ms, "
              f"at most {BOUNDS[name]:g} ms{'' if value <= BOUNDS[name] else ': missed'})")
        entries.append({"name": name, "value": value, "unit": "ms", "reference": None, "ratio": None,
                        "allocations": None})
    if arguments.json:
        with open(arguments.json, "w") as file:
            json.dump(entries, file, indent=1)


if __name__ == "__main__":
    main()
