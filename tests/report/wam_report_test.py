#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the WAM's demonstration reaches, by the report of its runs.

usage: wam_report_test.py PROGRAM WAM_FOLDER LIBRARY_FOLDER [WAM_IO_CYCLE]
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, WAM, LIBRARIES = sys.argv[1:4]
IO_CYCLE = sys.argv[4] if len(sys.argv) > 4 else None
RUNS = (("tour_npid", "npid", "tour"), ("tour_computed_torque", "computed_torque", "tour"),
        ("weightless", "weightless", "weightless"))
# Where the pucks take their time, the bus has nothing to do: EMULATOR.md.
NOT_REACHED = ["/io/wam7/bus_of_wire"]


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def armature(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr


def press_estop(folder):
    with open(f"{WAM}/demo/estop.txt", encoding="utf-8") as lines:
        done = subprocess.run([PROGRAM, "run", f"{WAM}/demo/npid.yaml", "-L", LIBRARIES, "--sim",
                               "--browse", "--out", folder], stdin=lines, capture_output=True,
                              text=True, timeout=300)
    assert done.returncode == 1, done.stderr  # there was a fault


class Reached(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = folder = cls.holder.name
        for name, deployment, script in RUNS:
            armature("run", f"{WAM}/demo/{deployment}.yaml", "-L", LIBRARIES, "--sim", "--script",
                     f"{WAM}/demo/{script}.lua", "--out", os.path.join(folder, name))
        press_estop(os.path.join(folder, "estop"))
        shutil.copy(f"{WAM}/demo/to_reach.json", folder)
        if IO_CYCLE:
            with open(os.path.join(folder, "io.json"), "w", encoding="utf-8") as file:
                subprocess.run([IO_CYCLE, WAM, LIBRARIES], stdout=file, check=True, timeout=300)
        armature("report", folder)
        cls.report = load(os.path.join(folder, "report.json"))
        cls.goals = load(os.path.join(folder, "to_reach.json"))["to_reach"]
        with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
            cls.page = file.read()

    def found(self):
        """(goal, what became of it), but for what is of this machine's time."""
        return [(goal, found) for goal, found in zip(self.goals, self.report["to_reach"])
                if not goal["figure"].endswith("computing_us")
                and (IO_CYCLE or not goal["figure"].startswith("/io/"))]

    def test_each_goal_is_there_with_its_bound(self):
        self.assertEqual(len(self.report["to_reach"]), len(self.goals))
        for goal, found in zip(self.goals, self.report["to_reach"]):
            self.assertEqual(goal["name"], found["name"])
            self.assertEqual([goal.get("most"), goal.get("least")],
                             [found.get("most"), found.get("least")])
            self.assertIn(f'"name":{json.dumps(goal["name"], ensure_ascii=False)}', self.page)

    def test_each_is_reached_but_those_that_are_known_not_to_be(self):
        for goal, found in self.found():
            self.assertIsNotNone(found["value"], goal["name"])
            self.assertEqual(found["reached"], goal["figure"] not in NOT_REACHED, found)

    def test_what_is_to_be_reached_of_time_is_measured(self):
        if IO_CYCLE:
            for mode in ("wam7", "wam7_computed_torque", "wam4", "wam4_computed_torque"):
                self.assertGreater(self.report["io"][mode]["computing_us"], 0.0)

    def test_an_estop_and_its_reset_are_marked(self):
        moments = self.report["runs"]["estop"]["moments"]
        self.assertEqual([one["kind"] for one in moments[:4]], ["armed", "E-stop", "reset", "armed"])
        self.assertIn("WAM: fault: E-stop", moments[1]["told"][0])
        self.assertEqual(moments[2]["told"], ["WAM: reset"])
        times = [one["time_s"] for one in moments]
        self.assertEqual(times, sorted(times))
        # The recording knows when the last joint was not armed any more.
        self.assertAlmostEqual(times[1], self.disarmed_in("estop"), delta=0.01)

    def disarmed_in(self, run):
        with open(os.path.join(self.folder, run, "wam.csv"), encoding="utf-8") as file:
            lines = [line.rstrip("\n").split(",") for line in file if not line.startswith("#")]
        column = lines[0].index("WAM_Armed1")
        armed = [(float(line[0]), float(line[column])) for line in lines[1:] if line[column] != "nan"]
        first = next(time for time, on in armed if on)
        return next(time for time, on in armed if not on and time > first)

    def test_velocities_and_torques_have_their_limits(self):
        for name in ("estop", *(name for name, _, _ in RUNS)):
            run = self.report["runs"][name]
            self.assertEqual([joint["limit_rad_s"] for joint in run["velocities"]], [2.5] * 7)
            self.assertEqual([joint["limit"] for joint in run["efforts"]], [60, 60, 45, 28, 10, 10, 1.3])
            for joint in run["velocities"]:
                self.assertTrue(0.0 < joint["largest_rad_s"] < 2.5, joint)

    def test_the_page_is_below_3_MB(self):
        self.assertLess(os.path.getsize(os.path.join(self.folder, "report.html")), 3_000_000)

    def test_what_all_joints_reach_is_what_the_worst_of_them_does(self):
        for name, _, _ in RUNS:
            controller = self.report["controllers"][name]
            for figure in ("max_abs_error_rad", "moved_in_last_10_s_rad"):
                self.assertEqual(controller["all"][figure],
                                 max(joint[figure] for joint in controller["joints"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
