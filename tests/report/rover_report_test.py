#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the demonstration of the rover shows: the experiment with both control programs reaches what it is to reach.

usage: rover_report_test.py PROGRAM ROVER_FOLDER LIBRARY_FOLDER ROVER_FIGURES

The figures in real time and of memory are those of the machine, and not looked at here.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROVER, LIBRARIES, FIGURES = map(os.path.abspath, sys.argv[1:5])
REAL_TIME = ("/figures/realtime/", "/figures/memory/")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


class RoverReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        for program in ("p", "pi"):
            run(PROGRAM, "run", f"{ROVER}/demo/{program}.yaml", "-L", LIBRARIES, "--sim", "--script",
                f"{ROVER}/experiment.lua", "--out", os.path.join(cls.folder, program))
        found = run(FIGURES, cls.folder)
        with open(os.path.join(cls.folder, "figures.json"), "w", encoding="utf-8") as file:
            file.write(found)
        shutil.copy(f"{ROVER}/demo/to_reach.json", cls.folder)
        cls.said = run(PROGRAM, "report", cls.folder)
        with open(os.path.join(cls.folder, "report.json"), encoding="utf-8") as file:
            cls.report = json.load(file)
        with open(f"{ROVER}/demo/to_reach.json", encoding="utf-8") as file:
            cls.figures = [goal["figure"] for goal in json.load(file)["to_reach"]]

    def test_every_figure_in_simulated_time_is_found_and_reached(self):
        self.assertEqual(len(self.report["to_reach"]), len(self.figures))
        for goal, figure in zip(self.report["to_reach"], self.figures):
            if figure.startswith(REAL_TIME):
                continue
            with self.subTest(goal["name"]):
                self.assertTrue(goal["reached"], goal)

    def test_images_enough_are_judged(self):
        for program in ("p", "pi"):
            judged = self.report["figures"][program]["recognition"]
            self.assertGreater(judged["whole_in_sight"], 2000)
            self.assertGreater(judged["out_of_sight"], 50)

    def test_the_page_has_ways_curves_and_pictures(self):
        self.assertTrue({"curves", "ways", "pictures"}.isdisjoint(self.report["figures"]))
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            page = file.read()
        for text in ("Ways from above, p", "Distance to the ball", "Bearing of the ball", "Error of Vision",
                     "Colour distance", "Mask", "Blobs"):
            self.assertIn(text, page)
        self.assertLess(len(page), 3_000_000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
