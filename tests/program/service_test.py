#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A run as a service of systemd: what it tells its manager, and how it ends.

usage: service_test.py ARMATURE DEPLOYMENT
"""
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

ARMATURE, FILE = sys.argv[1:3]


class Manager:
    """Starts a service as systemd does, and hears what it says."""

    def __init__(self, folder, watchdog):
        path = os.path.join(folder, "notify")
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(path)
        self.socket.settimeout(60)
        self.service = subprocess.Popen([ARMATURE, "run", FILE], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        env={**os.environ, "NOTIFY_SOCKET": path, "WATCHDOG_USEC": str(watchdog)})

    def hears(self):
        return self.socket.recv(100).decode()

    def stop(self):
        self.service.send_signal(signal.SIGTERM)
        return self.service.wait(timeout=60)

    def close(self):
        self.service.kill()
        self.service.wait()
        self.socket.close()


class Service(unittest.TestCase):
    def manager(self, watchdog):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        manager = Manager(folder.name, watchdog)
        self.addCleanup(manager.close)
        return manager

    def test_it_says_that_it_is_ready_that_it_lives_and_that_it_stops(self):
        manager = self.manager(watchdog=100_000)
        self.assertEqual(manager.hears(), "READY=1")
        self.assertEqual([manager.hears() for _ in range(3)], ["WATCHDOG=1"] * 3)
        self.assertEqual(manager.stop(), 0)
        said = manager.hears()
        while said == "WATCHDOG=1":
            said = manager.hears()
        self.assertEqual(said, "STOPPING=1")

    def test_one_that_stands_still_shows_no_sign_of_life(self):
        manager = self.manager(watchdog=100_000)
        self.assertEqual(manager.hears(), "READY=1")
        manager.service.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, manager.service.pid, os.WSTOPPED)
        manager.socket.setblocking(False)
        with self.assertRaises(BlockingIOError):
            while manager.hears() == "WATCHDOG=1":
                pass
        time.sleep(0.3)
        with self.assertRaises(BlockingIOError):
            manager.hears()
        manager.service.send_signal(signal.SIGCONT)
        manager.socket.settimeout(60)
        self.assertEqual(manager.hears(), "WATCHDOG=1")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
