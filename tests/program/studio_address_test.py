#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`armature studio ADDRESS`: what is said of an application elsewhere that cannot be opened.

usage: studio_address_test.py PROGRAM
"""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from remote_browser_test import ALL, LONG, PROGRAM, TLS, PlainNode, Robot, make_certificates

PAGE = os.path.join(os.path.dirname(PROGRAM), "../share/armature/web/studio/index.html")


class WrongAddresses(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def studio(self, *arguments):
        environment = {**os.environ, "XDG_STATE_HOME": self.folder.name}
        return subprocess.run(
            [PROGRAM, "studio", *arguments, "--no-open", "--listen",
             "unix:" + os.path.join(self.folder.name, "page")],
            capture_output=True, text=True, timeout=120, env=environment)

    def robot(self, policy):
        robot = Robot(self.folder.name, policy)
        self.addCleanup(robot.stop)
        return robot

    def test_nobody_listens_there(self):
        done = self.studio("unix:/tmp/no-robot-listens-here")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'unix:/tmp/no-robot-listens-here' is not connected: ", done.stderr)
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_what_is_no_address_is_wrong_use(self):
        done = self.studio("http://robot:4242")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'http://robot:4242' is not an address: expected one such as "
                      "tcp://127.0.0.1:4242", done.stderr)

    def test_a_folder_without_a_deployment_is_wrong_use(self):
        done = self.studio(self.folder.name)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"'{self.folder.name}' has no deployment, a file with `application: NAME`: begin one by its "
                      f"name, as in `armature studio {self.folder.name}/robot.yaml`", done.stderr)

    def test_of_several_deployments_in_a_folder_one_has_to_be_named(self):
        deployments = os.path.join(self.folder.name, "deployments")
        os.mkdir(deployments)
        for path, text in ((os.path.join(self.folder.name, "b.yaml"), "include: part.yaml\napplication: b\n"),
                           (os.path.join(self.folder.name, "part.yaml"), "components: {}\n"),
                           (os.path.join(deployments, "a.yaml"), "application: a\n")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        done = self.studio(self.folder.name)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"'{self.folder.name}' has several deployments: name one of them\n"
                      f"  {self.folder.name}/b.yaml\n  {deployments}/a.yaml", done.stderr)

    def test_the_only_deployment_of_a_folder_is_opened(self):
        with open(os.path.join(self.folder.name, "head.yaml"), "w", encoding="utf-8") as file:
            file.write("application: head\n")
        environment = {**os.environ, "XDG_STATE_HOME": self.folder.name}
        address = os.path.join(self.folder.name, "page")
        opened = subprocess.Popen([PROGRAM, "studio", self.folder.name, "--no-open", "--listen", "unix:" + address],
                                  env=environment, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not os.path.exists(address) and opened.poll() is None and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertIsNone(opened.poll())
        opened.send_signal(signal.SIGTERM)
        self.assertEqual(opened.wait(60), 0)

    def test_tls_needs_its_files(self):
        done = self.studio("tls://robot:4243", "--key", "a")
        self.assertEqual(done.returncode, 2)
        self.assertIn("needs --certificate, --key and --authority", done.stderr)

    def test_an_authority_is_for_tls(self):
        done = self.studio("tcp://robot:4243", "--authority", "a")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--authority is for an application at a tls:// or wss:// address, found "
                      "'tcp://robot:4243'", done.stderr)

    def test_files_that_are_not_there_are_told(self):
        done = self.studio("tls://robot:4243", "--certificate", "/no/a", "--key", "/no/b",
                           "--authority", "/no/c")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/a", done.stderr)

    def test_a_node_without_an_application_is_none(self):
        node = PlainNode()
        node.start()
        self.addCleanup(node.listener.close)
        done = self.studio(node.address)
        self.assertEqual(done.returncode, 1)
        self.assertIn("a node is there, and no application that can be looked at", done.stderr)

    def test_who_may_nothing_is_told_so(self):
        robot = self.robot("allow somebody@tls read *\n")
        done = self.studio(robot.address)
        self.assertEqual(done.returncode, 1)
        self.assertIn("may not read 'armature'", done.stderr)
        self.assertIn("allow", done.stderr)

    @unittest.skipUnless(os.path.exists(PAGE), "the page is not built")
    def test_an_application_goes_on_when_the_studio_ends(self):
        self.opens_and_leaves(self.robot(ALL))

    @unittest.skipUnless(os.path.exists(PAGE) and shutil.which("openssl"),
                         "the page is not built, or there is no openssl")
    def test_an_encrypted_address_is_opened_by_who_its_policy_knows(self):
        place = self.folder.name + "/"
        make_certificates(self.folder.name)
        robot = Robot(self.folder.name, "allow operator@tls read *\n", "tls://127.0.0.1:0", TLS)
        self.addCleanup(robot.stop)
        self.opens_and_leaves(robot, "--certificate", place + "operator.pem", "--key",
                              place + "operator.key", "--authority", place + "authority.pem")

    def opens_and_leaves(self, robot, *arguments):
        page = os.path.join(self.folder.name, "page")
        studio = subprocess.Popen(
            [PROGRAM, "studio", robot.address, "--no-open", "--listen", "unix:" + page, *arguments],
            stderr=subprocess.PIPE, text=True,
            env={**os.environ, "XDG_STATE_HOME": self.folder.name})
        self.addCleanup(studio.stderr.close)
        while not os.path.exists(page) and studio.poll() is None:
            time.sleep(0.01)
        if studio.poll() is None:
            studio.send_signal(signal.SIGINT)
        self.assertEqual(studio.wait(timeout=LONG), 0)
        self.assertIn(f"the application at {robot.address} is left as it is", studio.stderr.read())
        self.assertIsNone(robot.process.poll())


if __name__ == "__main__":
    unittest.main(argv=["studio_address_test.py"], verbosity=1)
