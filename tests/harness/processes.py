# SPDX-License-Identifier: Apache-2.0
"""Programs that tests type to, and stop and kill. Nothing here depends on how fast the machine is: what
is waited for has to come true in a long while."""

import contextlib
import ctypes
import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
import unittest

LONG = 60.0


class Broken(AssertionError):
    """A promise was not kept."""


def wait_for(condition, what, limit=LONG):
    """What `condition` gives once it gives something."""
    end = time.monotonic() + limit
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.005)
    raise Broken(f"it did not come true: {what}")


@contextlib.contextmanager
def kept_port():
    """A port of this machine at which a program of the test may listen again and again, and which the system gives to nobody else
    meanwhile, such as to the next test."""
    with socket.socket() as one:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        one.bind(("127.0.0.1", 0))
        yield one.getsockname()[1]


LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1


class Process:
    """A program that is typed to, and all that it has said; it does `first` before it begins. It dies with the test:
    emulators that a killed test left behind would load the machine for ever."""

    def __init__(self, command, cwd=None, first=None):
        def begin():
            LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
            if first:
                first()

        self.lines, self.asked = [], 0
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True, cwd=cwd, preexec_fn=begin)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))

    def text(self):
        return "\n".join(self.lines)

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def ask(self, expression):
        """What the browser of `armature run` prints of an expression in Lua."""
        self.asked += 1
        mark = f"@{self.asked}@"
        self.say(f"print('{mark}', {expression})")
        line = wait_for(lambda: next((line for line in self.lines if line.startswith(mark)), None),
                        f"an answer to {expression}; {self.text()}")
        return line[len(mark):].strip()

    def wait_until_it_says(self, text, limit=LONG):
        try:
            wait_for(lambda: text in self.text(), f"it says '{text}'", limit)
        except Broken as broken:
            raise Broken(f"{broken}; it said:\n{self.text()}") from None

    def kill(self, sent):
        self.process.send_signal(sent)

    def end(self, limit=LONG):
        """Its exit code, once it has stopped in order."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
        try:
            code = self.process.wait(timeout=limit)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise Broken("it did not end: " + self.text()) from None
        self.reader.join(limit)
        self.process.stdin.close()
        self.process.stdout.close()
        return code


def states_in(file):
    """The states that a plant or an emulator has written, as JSON, a line each."""
    if not os.path.exists(file):
        return []
    with open(file, encoding="utf-8") as now:  # all at once: it grows meanwhile
        return [json.loads(line) for line in now.read().splitlines(keepends=True) if line.endswith("\n")]


def main_with_second_chances(chances=3):
    """Runs the tests of the calling module. One that fails may be tried again, since a machine that others use stalls now and then for longer than
    data may be old, which rightly stops a robot: what fails each time has failed."""
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    for _ in range(chances):
        result = unittest.TextTestRunner(verbosity=2).run(suite)
        failed = [test for test, _ in result.failures + result.errors]
        if not failed:
            sys.exit(0)
        suite = unittest.TestSuite(type(test)(test._testMethodName) for test in failed)
    sys.exit(1)
