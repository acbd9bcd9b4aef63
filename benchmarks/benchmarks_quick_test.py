#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every measurement runs, and says what it is to say; how fast anything is plays no role.

usage: benchmarks_quick_test.py ARMATURE_BENCH
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
JOINTS = (2, 7, 64, 256, 1000)
COMPONENTS = (100, 1000, 10000)

# What happens while an application runs: none of it may allocate.
AT_RUN_TIME = (
    [f"cycle/{n}" for n in JOINTS]
    + [f"cycle_threaded/{n}" for n in JOINTS]
    + [f"cycle_threaded_with_work/{n}" for n in JOINTS]
    + ["port_write_read", "port_write_read/vector", "port_write_read_across_threads", "trigger", "find_ball"]
    + [f"watched/{n}" for n in (2, 7, 64)]
    + ["operation_call", "operation_send_collect", "event/1", "event/8"]
    + ["latency_1khz/p50", "latency_1khz/p99", "latency_1khz/p99.9", "periods_exact"]
)
OTHERS = (
    [f"timeline_on/{n}" for n in JOINTS] +
    [f"online_trajectory/{n}/{which}" for n in (1, 7, 14) for which in ("mean", "worst")] +
    [f"cartesian/7/{which}" for which in ("mean", "worst", "plan", "plan_jog")] +
    ["cia402/bus_of_wire", "cia402/computing"] +
    [f"model/{n}{after}" for n in (2, 7) for after in ("", "/after_10_ms")] +
    ["janus_feed_forward", "event_command"] +
    [f"{what}_per_component/{n}" for what in ("start", "load", "memory") for n in COMPONENTS]
    + ["resident_two_joints", "resident_two_joints/locked", "compile_time", "queries/p99.9"]
)
CPUS = ("one_cpu", "two_cpus") if os.cpu_count() > 1 else ("one_cpu",)
OTHERS += [f"{call}/{where}" for call in ("remote_call", "remote_call_1KiB", "remote_event/16_processes")
           for where in CPUS]
if os.cpu_count() > 1:
    OTHERS += ["remote_command", "remote_event/16"]
WITHOUT_REFERENCE = (
    [f"{what}_per_component/100" for what in ("start", "load", "memory")]
    + ["periods_exact", "resident_two_joints", "resident_two_joints/locked", "cia402/computing"]
    + [f"online_trajectory/{n}/{which}" for n in (1, 7, 14) for which in ("mean", "worst")]
    + [f"cartesian/7/{which}" for which in ("mean", "worst", "plan", "plan_jog")]
)


def bench(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=280)


class Quick(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "results.json")
            cls.done = bench("--quick", "--json", path)
            with open(path, encoding="utf-8") as file:
                cls.entries = {entry["name"]: entry for entry in json.load(file)}

    def test_everything_runs_and_computes_what_the_reference_does(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)

    def test_all_entries_are_there(self):
        self.assertEqual(sorted(self.entries), sorted([*AT_RUN_TIME, *OTHERS]))

    def test_entries_have_the_same_fields(self):
        fields = ["name", "value", "unit", "reference", "ratio", "allocations"]
        for name, entry in self.entries.items():
            with self.subTest(name):
                self.assertEqual(list(entry), fields)
                self.assertIsInstance(entry["value"], float)
                self.assertNotEqual(entry["unit"], "")

    def test_ratio_is_value_by_reference(self):
        for name, entry in self.entries.items():
            with self.subTest(name):
                if name in WITHOUT_REFERENCE:
                    self.assertIsNone(entry["reference"])
                    self.assertIsNone(entry["ratio"])
                else:
                    ratio = entry["value"] / entry["reference"]
                    self.assertAlmostEqual(entry["ratio"], ratio, delta=1e-9 * ratio)

    def test_nothing_allocates_at_run_time(self):
        for name in AT_RUN_TIME:
            with self.subTest(name):
                self.assertEqual(self.entries[name]["allocations"], 0.0)

    def test_every_period_is_accounted_for(self):
        self.assertEqual(self.entries["periods_exact"]["value"], 0.0)


class WrongUse(unittest.TestCase):
    def test_a_filter_that_nothing_matches(self):
        done = bench("--filter", "no such entry")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no entry's name contains 'no such entry'", done.stderr)

    def test_a_filter_that_is_no_regular_expression(self):
        done = bench("--filter", "(")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--filter (:", done.stderr)

    def test_a_file_that_cannot_be_written(self):
        done = bench("--quick", "--filter", "^trigger$", "--json", "/no/such/folder/f.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/such/folder", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
