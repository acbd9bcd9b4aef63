#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whatever the threads of components do, the end of --for, SIGTERM and an E-stop that somebody types act
within 100 ms: beside forty busy threads, and beside two that take all of two CPUs with a real-time
priority, for what stops the run.

usage: overload_test.py PROGRAM FOLDER_OF_VICTIM

A machine that stands still for a while is not the program's fault: the best of several attempts counts.
"""

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import LONG, Process

PROGRAM, VICTIM = sys.argv[1:3]
SOON = 0.1
DONE = 0.6  # each busy thread ends its cycle of 5 ms first
ATTEMPTS = 5

HEAD = """
application: overload
libraries: [victim]
components:
  Drive: {model: Drive, activity: {periodic: 10 ms, priority: 60}}
"""
# The last is stopped first, and Drive last of all.
LAST = """
  First: {model: Drive, activity: {periodic: 10 ms, priority: 50}}
"""
MANY = HEAD + """
  "Busy{1..40}": {model: Busy, activity: {periodic: 5 ms, scheduler: other}}
""" + LAST
URGENT = HEAD + """
  "Busy{1..2}": {model: Busy, activity: {periodic: 5 ms, priority: 30}}
""" + LAST


def be_urgent():
    """Who measures is woken in time; False if the system does not grant that."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(97))
    except PermissionError:
        return False
    return True


class Overload(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not be_urgent():
            raise unittest.SkipTest("the system grants no real-time priority")

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def start(self, text, *arguments):
        deployment = os.path.join(self.folder, "overload.yaml")
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(text)
        ordinary = lambda: os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
        run = Process([PROGRAM, "run", deployment, "-L", VICTIM, *arguments], self.folder, ordinary)
        self.addCleanup(self.end, run)
        return run

    @staticmethod
    def end(run):
        if run.process.poll() is None:
            run.process.kill()
        run.process.wait()
        run.reader.join()
        run.process.stdin.close()
        run.process.stdout.close()

    @staticmethod
    def time_of(run, what, who="Drive"):
        run.wait_until_it_says(f"{who}: {what} at ")
        return float(re.search(rf"{who}: {what} at ([0-9.]+)", run.text())[1])

    def assert_acts_soon(self, attempt):
        delays = []
        for _ in range(ATTEMPTS):
            first, last = attempt()
            delays.append((first, last))
            if first < SOON and last < DONE:
                return
        self.fail(f"within {delays} s")

    def delay_of_signal(self, text):
        run = self.start(text)
        run.wait_until_it_says("Drive: started")
        time.sleep(0.5)
        asked = time.monotonic()
        run.kill(signal.SIGTERM)
        return self.delays_of_stop(run, asked)

    def delay_of_time(self, text):
        run = self.start(text, "--for", "1 s")
        return self.delays_of_stop(run, self.time_of(run, "started", "First") + 1.0)

    def delays_of_stop(self, run, asked):
        """Until the first component is stopped, and until the last is."""
        last = self.time_of(run, "stopped") - asked
        run.process.wait(timeout=LONG)
        return self.time_of(run, "stopped", "First") - asked, last

    def test_a_signal_acts_soon(self):
        for text in (MANY, URGENT):
            self.assert_acts_soon(lambda text=text: self.delay_of_signal(text))

    def test_the_end_of_its_time_acts_soon(self):
        for text in (MANY, URGENT):
            self.assert_acts_soon(lambda text=text: self.delay_of_time(text))

    def test_an_estop_that_is_typed_acts_soon(self):
        def attempt():
            run = self.start(MANY, "--browse")
            time.sleep(1.0)
            asked = time.monotonic()
            run.say("Drive:estop()")
            delay = self.time_of(run, "estop") - asked
            run.say("quit")
            run.process.wait(timeout=LONG)
            return delay, delay
        self.assert_acts_soon(attempt)

    def test_an_estop_of_another_process_acts_soon(self):
        address = "unix:" + os.path.join(self.folder, "socket")
        policy = os.path.join(self.folder, "policy")
        with open(policy, "w", encoding="utf-8") as file:
            file.write("allow local read,command *\n")
        text = MANY + f"network: {{listen: '{address}', policy: {policy}}}\n"

        def attempt():
            run = self.start(text)
            browser = Process([PROGRAM, "browse", address], self.folder)
            self.addCleanup(self.end, browser)
            browser.say("Drive.estop")
            browser.wait_until_it_says("estop")
            asked = time.monotonic()
            browser.say("Drive:estop()")
            delay = self.time_of(run, "estop") - asked
            browser.say("quit")
            run.kill(signal.SIGTERM)
            run.process.wait(timeout=LONG)
            return delay, delay
        self.assert_acts_soon(attempt)


class Load(unittest.TestCase):
    """What cannot run is refused, in simulated time too."""

    def check(self, text, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            deployment = os.path.join(folder, "overload.yaml")
            with open(deployment, "w", encoding="utf-8") as file:
                file.write(text)
            return subprocess.run([PROGRAM, "run", deployment, "-L", VICTIM, "--for", "100 ms", *arguments],
                                  capture_output=True, text=True, timeout=LONG)

    def test_declared_load_that_cannot_be_is_refused(self):
        count = os.cpu_count() + 1
        text = HEAD + f'  "Busy{{1..{count}}}": {{model: Busy, activity: {{periodic: 5 ms, budget: 5 ms}}}}\n'
        for arguments in ([], ["--sim"]):
            done = self.check(text, *arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn("of a CPU, but have", done.stderr)

    def test_too_many_threads_are_refused(self):
        text = HEAD + '  "Busy{1..64}": {model: Busy, activity: {periodic: 5 ms}, properties: {For: 0}}\n'
        for arguments in ([], ["--sim"]):
            done = self.check(text, *arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn("has 65 threads, expected at most 64", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
