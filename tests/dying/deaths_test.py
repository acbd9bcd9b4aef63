#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The short form of `scripts/campaign deaths`: some of its deaths, once each. Milliseconds are judged by
the campaign alone: nothing here depends on how fast the machine is.

usage: deaths_test.py PROGRAM EMULATOR LIBRARIES FOLDER_OF_VICTIM WAM_DIR
"""

import random
import sys
import types
import unittest

import deaths

ATTEMPTS = 10
NAMES = ("program", "emulator", "libraries", "victim", "wam")
OPTIONS = types.SimpleNamespace(**dict(zip(NAMES, sys.argv[1:6])))


class Deaths(unittest.TestCase):
    def assert_as_promised(self, name):
        """A machine that stands still for some milliseconds stops the arm before anybody dies: then once more."""
        for _ in range(ATTEMPTS):
            with deaths.Run(OPTIONS, random.Random(name)) as run:
                try:
                    return deaths.DEATHS[name](run)
                except deaths.CutShort as stalled:
                    why = str(stalled)
                except deaths.Broken as broken:
                    why = str(broken)
                    if not self.was_idled_before(why):
                        self.fail(why)
        return self.fail(f"{ATTEMPTS} runs were stopped before anybody died: {why}")

    @staticmethod
    def was_idled_before(why):
        """By a guardian that had acted already: how often it does not act is the campaign's to count."""
        return "the pucks are set idle" in why

    def test_a_killed_controller_has_its_arm_idled_by_its_guardian_which_then_ends(self):
        self.assert_as_promised("controller killed")

    def test_a_controller_that_was_stopped_finds_itself_out_and_drives_nothing(self):
        self.assert_as_promised("controller stopped 0.1 s")

    def test_a_crash_is_named_and_the_arm_left_to_nobody(self):
        self.assert_as_promised("segmentation fault")

    def test_a_stack_overflow_in_the_hardwares_thread_has_the_arm_idled(self):
        self.assert_as_promised("stack overflow beside the arm")

    def test_a_guardian_that_dies_is_named_and_the_motion_goes_on(self):
        self.assert_as_promised("guardian killed")

    def test_a_required_guardian_that_dies_is_a_fault(self):
        self.assert_as_promised("required guardian killed")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[6:])
