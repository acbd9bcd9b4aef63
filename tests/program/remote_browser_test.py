#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`armature browse`: the task browser in an application of another process.

usage: remote_browser_test.py PROGRAM
"""

import os
import pwd
import pty
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

PROGRAM = sys.argv[1]
LONG = 30.0
LIFT = """application: lift
libraries: [lift]
components:
  Lift: {model: Lift, activity: {periodic: 10 ms}, properties: {Top: 3 m, Speed: 1 m/s}}
network: {%s}
"""
QUIET = os.path.join(os.path.dirname(os.path.abspath(__file__)), "quiet.yaml")
OPENED = f"include: {QUIET}\nnetwork: {{%s}}\n"
ALL = "allow local read,command,configure *\n"


class Robot:
    """A lift, or another, that runs and listens at a socket file of its own folder."""

    def __init__(self, folder, policy, listen=None, network="", application=LIFT):
        deployment = os.path.join(folder, "lift.yaml")
        with open(os.path.join(folder, "policy"), "w", encoding="utf-8") as file:
            file.write(policy)
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(application % ("policy: policy" + network))
        self.process = subprocess.Popen(
            [PROGRAM, "run", deployment, "--realtime", "off", "--listen",
             listen or "unix:" + os.path.join(folder, "robot")],
            stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        before = ""
        while True:
            line = self.process.stderr.readline()
            before += line
            if not line:
                raise AssertionError("the robot did not start: " + before)
            if "listens at" in line:
                self.address = line.split("listens at ")[1].strip()
                break
        # What it says is taken, so that it never waits for anybody to read.
        self.said = []
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stderr:
            self.said.append(line)

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=LONG)
        self.reader.join(timeout=LONG)
        self.process.stderr.close()


class WithARobot(unittest.TestCase):
    policy = ALL

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.robot = self.start()

    def start(self):
        robot = Robot(self.folder.name, self.policy)
        self.addCleanup(robot.stop)
        return robot

    def browse(self, lines, *arguments):
        return subprocess.run([PROGRAM, "browse", self.robot.address, *arguments], input=lines,
                              capture_output=True, text=True, timeout=120)


class InputsOfTheOperator(WithARobot):
    """Who may do everything from another process is not the operator at this one."""

    def start(self):
        robot = Robot(self.folder.name, ALL, application=OPENED)
        self.addCleanup(robot.stop)
        return robot

    def test_they_are_closed_to_other_processes(self):
        done = self.browse("Filter.Raw = 1\nFilter.Raw\n")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("error: 'Filter.Raw' is an input of the operator: only the operator writes it",
                      done.stderr)
        self.assertEqual(done.stdout, "not yet written\n")


class Pipe(WithARobot):
    def test_it_lists_and_shows_as_the_local_browser_does(self):
        done = self.browse("ls\nls Lift\nLift.Top\nthreads\nfaults\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        says = done.stdout
        self.assertTrue(says.startswith("component  model  state    thread\n"
                                        "Lift       Lift   Running  Lift\n"
                                        "Lift: Lift, Running, in thread Lift (every 10 ms)\n"
                                        "property  Top    3 m\n"
                                        "property  Speed  1 m/s\n"
                                        "operations  top, height\n"
                                        "commands    travel\n"
                                        "3 m\n"
                                        "Lift, every 10 ms, 1 component\n"), says)
        self.assertTrue(says.endswith("all components run; 0 faults and 0 declared reactions "
                                      "since the start\n"), says)

    def test_help_explains_everything(self):
        done = self.browse("help\nhelp Lift\nhelp Lift.Top\nhelp travel\nhelp watch\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("quit\n      leaves; the application goes on", done.stdout)
        self.assertIn("Lift:travel(target [m])\n      goes to a height; takes double; a command",
                      done.stdout)
        self.assertIn("Lift.Top = 3 m\n      highest position; double; 0 to 100; "
                      "changes only while stopped\n", done.stdout)

    def test_a_property_is_set_while_its_component_is_stopped(self):
        done = self.browse("Lift.Speed = 2\nstop Lift\nLift.Speed = 150 cm/s\nstart\nLift.Speed\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("error: property 'Speed' of 'Lift' cannot change while the component runs; "
                      "stop it first\n", done.stderr)
        self.assertEqual(done.stdout, "Lift: Stopped\nLift.Speed = 1.5 m/s\nLift: Running\n"
                                      "1.5 m/s\n")

    def test_operations_are_called_and_commands_followed_to_their_end(self):
        done = self.browse("Lift:top()\nLift:travel(2)\nwait\nLift:height()\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "3\nLift.travel: under way; `wait` waits for its end\n"
                                      "Lift.travel: done\n2\n")

    def test_a_command_is_cancelled(self):
        done = self.browse("Lift:travel(3)\ncancel\nwait\ncancel\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "Lift.travel: under way; `wait` waits for its end\n"
                                      "Lift.travel: cancelled by its sender\n"
                                      "no command is under way\n")

    def test_commands_of_who_leaves_are_cancelled(self):
        done = self.browse("Lift:travel(3)\nquit\nnothing\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("Lift.travel: cancelled, because the connection of the client that began it has ended\n",
                      done.stdout)
        self.assertIsNone(self.robot.process.poll(), "the robot goes on")
        again = self.browse("Lift:travel(0)\nwait\n")
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertIn("Lift.travel: done\n", again.stdout)

    def test_mistakes_say_what_was_expected(self):
        lines = {
            "Lfit.Top": "unknown component 'Lfit' (did you mean 'Lift'?)",
            "Lift.Topp": "'Lift' has no 'Topp' (did you mean 'Top'?)",
            "lst": "unknown command or component 'lst' (did you mean 'ls'?)",
            "Lift:travel()": "Lift.travel takes 1 argument, not 0: it is ",
            "Lift:travel('up')": "Lift.travel: argument 1 (target [m]): expected a double",
            "Lift:travel(30)": "the target is outside the shaft",
            "Lift:travel(3": "Lift.travel: expected ')', found the end of the line",
            "Lift:fly(3)": "'Lift' has no 'fly'",
            "Lift.Top[1]": "'Lift.Top' is a double and has no '[1]'",
            "wait never": "wait takes the seconds to wait, above 0: wait 5",
            "watch": "watch takes the items to show",
            "stop": "stop takes the name of a component",
        }
        done = self.browse("\n".join(lines) + "\n")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        told = done.stderr.splitlines()
        self.assertEqual(len(told), len(lines), done.stderr)
        for said, wanted in zip(told, lines.values()):
            self.assertIn("error: ", said)
            self.assertIn(wanted, said)

    def test_values_are_watched(self):
        done = self.browse("watch Lift.Top Lift.Speed every 0.05 for 0.1\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([line.split() for line in done.stdout.splitlines()],
                         [["time", "Lift.Top", "[m]", "Lift.Speed", "[m/s]"],
                          ["0.050", "s", "3", "1"], ["0.100", "s", "3", "1"]])

    def test_a_robot_that_is_started_again_is_browsed_on(self):
        browser = subprocess.Popen([PROGRAM, "browse", self.robot.address], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(browser.stdout.close)
        self.addCleanup(browser.stderr.close)

        def ask(line):
            browser.stdin.write(line + "\n")
            browser.stdin.flush()

        ask("Lift.Top")
        self.assertEqual(browser.stdout.readline(), "3 m\n")
        ask("Lift:travel(3)")
        self.assertIn("under way", browser.stdout.readline())
        self.robot.stop()
        self.assertIn("is lost: ", browser.stderr.readline())
        self.robot = self.start()
        self.assertIn("connected to " + self.robot.address + " again", browser.stderr.readline())
        # An orderly stop cancels it; whether that is heard before the connection ends is not said.
        self.assertRegex(browser.stdout.readline(), "Lift.travel: (cancelled|how it ended is not known: "
                                                    "unknown command handle)")
        ask("Lift.Speed")
        self.assertEqual(browser.stdout.readline(), "1 m/s\n")
        browser.stdin.close()
        self.assertEqual(browser.wait(timeout=LONG), 0)


HERE = "local:" + pwd.getpwuid(os.getuid()).pw_name


class WhoMayOnlyRead(WithARobot):
    policy = "allow local read *\n"

    def test_sees_everything_and_changes_nothing(self):
        done = self.browse("Lift.Top\nLift:travel(1)\nstop Lift\nLift.Top = 1\n")
        self.assertEqual((done.returncode, done.stdout), (1, "3 m\n"))
        self.assertEqual(done.stderr, f"error: not allowed: {HERE} may not command 'Lift'\n"
                                      f"error: not allowed: {HERE} may not configure 'Lift'\n"
                                      f"error: not allowed: {HERE} may not configure 'Lift'\n")


class WhoMayNothing(WithARobot):
    policy = "allow somebody@tls read *\n"

    def test_is_told_so(self):
        done = self.browse("ls\n")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(f"error: not allowed: {HERE} may not read 'armature'", done.stderr)


class Addresses(unittest.TestCase):
    def browse(self, *arguments):
        return subprocess.run([PROGRAM, "browse", *arguments], input="", capture_output=True,
                              text=True, timeout=120)

    def test_nobody_listens_there(self):
        done = self.browse("unix:/tmp/no-robot-listens-here")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'unix:/tmp/no-robot-listens-here' is not connected: ", done.stderr)

    def test_what_is_no_address_is_wrong_use(self):
        done = self.browse("robot")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'robot' is not an address: expected one such as tcp://127.0.0.1:4242",
                      done.stderr)

    def test_tls_needs_its_files(self):
        done = self.browse("tls://robot:4243", "--key", "a")
        self.assertEqual(done.returncode, 2)
        self.assertIn("needs --certificate, --key and --authority", done.stderr)

    def test_files_that_are_not_there_are_told(self):
        done = self.browse("tls://robot:4243", "--certificate", "/no/a", "--key", "/no/b",
                           "--authority", "/no/c")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/a", done.stderr)


def openssl(folder, *arguments):
    subprocess.run(["openssl", *arguments], cwd=folder, check=True, capture_output=True)


def make_certificates(folder):
    """Of an authority, a robot at 127.0.0.1 and its operator."""
    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc")
    openssl(folder, "req", "-x509", *key, "-keyout", "authority.key", "-out", "authority.pem",
            "-subj", "/CN=test")
    with open(os.path.join(folder, "ext"), "w", encoding="utf-8") as file:
        file.write("subjectAltName=IP:127.0.0.1\n")
    for name in ("robot", "operator"):
        openssl(folder, "req", *key, "-keyout", name + ".key", "-out", name + ".csr", "-subj",
                "/CN=" + name)
        openssl(folder, "x509", "-req", "-in", name + ".csr", "-CA", "authority.pem", "-CAkey",
                "authority.key", "-CAcreateserial", "-extfile", "ext", "-out", name + ".pem")


TLS = ", tls: {certificate: robot.pem, key: robot.key, authority: authority.pem}"


@unittest.skipUnless(shutil.which("openssl"), "there is no openssl")
class Tls(unittest.TestCase):
    def test_the_policy_knows_the_operator_by_the_certificate(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        make_certificates(folder.name)
        robot = Robot(folder.name, "allow operator@tls read,command *\n", "tls://127.0.0.1:0", TLS)
        self.addCleanup(robot.stop)
        place = folder.name + "/"
        for _ in range(3):  # The program waits 3 s: on a busy machine a handshake may take longer.
            done = subprocess.run(
                [PROGRAM, "browse", robot.address, "--certificate", place + "operator.pem", "--key",
                 place + "operator.key", "--authority", place + "authority.pem"],
                input="Lift.Top\nLift:height()\nstop Lift\n", capture_output=True, text=True,
                timeout=120)
            if "it has not answered yet" not in done.stderr:
                break
        self.assertEqual(done.stdout, "3 m\n0\n", done.stderr)
        self.assertIn("operator@tls may not configure 'Lift'", done.stderr)


class PlainNode(threading.Thread):
    """A node of another make: its directory lists one component, and there is no application."""

    FIND, LIST = 0x12e3685b, 0x265c5890

    def __init__(self):
        super().__init__(daemon=True)
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = "tcp://127.0.0.1:%d" % self.listener.getsockname()[1]

    def run(self):
        connection, _ = self.listener.accept()
        with connection:
            while True:
                header = self.take(connection, 16)
                if header is None:
                    return
                _, _, kind, length, _ = struct.unpack("<4sIHHI", header)
                body = self.take(connection, length - 16)
                if kind != 2:
                    continue
                operation, call = struct.unpack_from("<II", body)
                name, interface = b"camera\0\0", b"Vision\0\0"
                entry = (struct.pack("<iI", 1, 6) + name + struct.pack("<I", 6) + interface +
                         struct.pack("<I", 7))
                nobody = struct.pack("<iIII", 0, 0, 0, 0)
                result = struct.pack("<I", 1) + entry if operation == self.LIST else nobody
                connection.sendall(struct.pack("<4sIHHI", b"RIDE", 0, 3, 16 + len(result), call) +
                                   result)

    @staticmethod
    def take(connection, size):
        data = b""
        while len(data) < size:
            more = connection.recv(size - len(data))
            if not more:
                return None
            data += more
        return data


class WithoutAnApplication(unittest.TestCase):
    def test_the_directory_of_a_plain_node_is_listed(self):
        node = PlainNode()
        node.start()
        self.addCleanup(node.listener.close)
        done = subprocess.run([PROGRAM, "browse", node.address], input="ls\nls camera\n",
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, "camera +Vision")
        self.assertIn("but no application that can be browsed; `list` shows what it hosts",
                      done.stderr)


class AtATerminal(WithARobot):
    ESCAPES = re.compile(rb"\r\x1b\[[0-9]+G|\x1b\[[0-9;?]*[A-Za-z]|\x1b[()=>][B0]?|\x0f")

    def setUp(self):
        super().setUp()
        self.process_id, self.end = pty.fork()
        if self.process_id == 0:
            os.environ.update(TERM="xterm", XDG_STATE_HOME=self.folder.name)
            os.execv(PROGRAM, [PROGRAM, "browse", self.robot.address])
        self.raw = b""
        self.status = None
        self.expect("lift> ")

    def tearDown(self):
        if self.status is None:
            os.kill(self.process_id, signal.SIGKILL)
            os.waitpid(self.process_id, 0)
        os.close(self.end)

    def type(self, text):
        os.write(self.end, text.encode())

    def text(self):
        return self.ESCAPES.sub(b"", self.raw).decode(errors="replace")

    def read(self):
        if not select.select([self.end], [], [], LONG)[0]:
            raise AssertionError("nothing comes any more:\n" + self.text())
        try:
            came = os.read(self.end, 4096)
            self.raw += came
            return bool(came)
        except OSError:
            return False

    def expect(self, text):
        deadline = time.monotonic() + LONG
        while text not in self.text():
            if time.monotonic() > deadline or not self.read():
                raise AssertionError(f"'{text}' did not come:\n{self.text()}")
        seen = self.text()
        self.raw = seen[seen.index(text) + len(text):].encode()

    def leave(self):
        self.type("\x04")
        while self.read():
            pass
        _, status = os.waitpid(self.process_id, 0)
        self.status = os.waitstatus_to_exitcode(status)
        self.assertEqual(self.status, 0)

    def test_tab_completes_the_names_of_the_robot(self):
        self.type("Li\t")
        self.expect("Lift")
        self.type(".To\t\r")
        self.expect("3 m")
        self.type("Lift:tr\t3)\r")
        self.expect("under way")
        self.type("cancel\r")
        self.expect("Lift.travel: cancelled")
        self.expect("lift> ")
        self.leave()

    def test_an_interrupt_cancels_what_is_waited_for(self):
        # Slow enough to be interrupted on a machine that is busy with something else.
        for line in ("stop Lift", "Lift.Speed = 0.05", "start Lift"):
            self.type(line + "\r")
            self.expect(line)
        self.expect("Lift: Running")
        self.type("Lift:travel(3)\r")
        self.expect("under way")
        self.type("wait\r")
        self.expect("(Ctrl-C cancels)")
        self.type("\x03")
        self.expect("Lift.travel: cancelled")
        self.expect("lift> ")
        self.leave()

    def test_a_lost_connection_is_told_above_the_line_that_is_typed(self):
        self.type("Lift.T")
        self.expect("Lift.T")
        self.robot.stop()
        self.expect("is lost")
        self.expect("Lift.T")
        self.robot = self.start()
        self.expect("again")
        self.type("op\r")
        self.expect("3 m")
        self.expect("lift> ")
        self.leave()

    def test_watch_ends_at_a_key(self):
        self.type("watch Lift.Top every 0.05\r")
        self.expect("any key ends it")
        self.type("x")
        self.expect("lift> ")
        self.leave()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
