#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The task browser of `armature run --browse`, through a pipe and at a terminal.

usage: browser_test.py PROGRAM EXAMPLES_DIR
"""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

PROGRAM, EXAMPLES = sys.argv[1:3]
WAVE = os.path.join(EXAMPLES, "02_ports_and_triggers", "wave.yaml")
QUIET = os.path.join(os.path.dirname(os.path.abspath(__file__)), "quiet.yaml")
PROMPT = f"""include: {QUIET}
components:
  TaskBrowser: {{model: TaskBrowser}}
"""
ESCAPES = re.compile(rb"\r\x1b\[[0-9]+G|\x1b\[[0-9;?]*[A-Za-z]|\x1b[()=>][B0]?|\x0f")
LONG = 30.0


def browse(text, *arguments, **more):
    return subprocess.run([PROGRAM, "run", WAVE, "--browse", *arguments], input=text,
                          capture_output=True, text=True, timeout=120, **more)


class Pipe(unittest.TestCase):
    def test_lines_are_done_in_order_without_prompts_and_colour(self):
        done = browse("run 2.5\nSource.Frequency\n"
                      "for i = 1, 2 do\n  print(i)\nend\nnow()", "--sim")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[0], "2 Hz")
        self.assertEqual(done.stdout.splitlines()[-3:], ["1", "2", "2.5"])
        self.assertNotIn("\x1b", done.stdout + done.stderr)

    def test_state_machines_show_where_they_are(self):
        door = os.path.join(EXAMPLES, "04_state_machine", "door.yaml")
        done = subprocess.run([PROGRAM, "run", door, "--browse", "--sim"], capture_output=True,
                              input="ls Door\nrun 1.5\nls Door\nhelp Door\n", text=True,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "machine +door +in Closed")
        self.assertRegex(done.stdout, "machine +door +in Moving/Opening")
        self.assertIn("what the door is doing; states Closed, Moving, Moving/Opening", done.stdout)

    def test_a_head_is_armed_moved_broken_and_mended(self):
        head = os.path.join(EXAMPLES, "..", "robots", "janus", "deployments", "pid.yaml")
        lines = """run 0.1
            Arming:arm()
            wait
            Generator:moveTo(array(1.0, 0.5), 2)
            wait
            stop Cards
            run 0.5
            faults
            reset
            start
            faults
            run 0.5
            Joint1.Armed
            assert(wait(Arming:arm()))
            assert(wait(Generator:moveTo(array(0.0, 0.0), 2)))
            math.abs(Joint1.Position) < 0.01"""
        done = subprocess.run([PROGRAM, "run", head, "--browse", "--sim"], capture_output=True,
                              input=lines, text=True, timeout=120)
        says = done.stdout
        self.assertIn("AIC1        Exception  the bus of the card is gone", says, done.stderr)
        self.assertIn("all components run; 2 faults", says)
        self.assertEqual(says.splitlines()[-1], "true", says)
        self.assertIn("Arming.arm: done\nGenerator.moveTo: under way; `wait` waits for its end\n"
                      "Generator.moveTo: done\n", says)
        self.assertIn("\nfalse\n", says)  # nothing arms itself
        self.assertNotIn("error: ", done.stderr)

    def test_the_end_of_the_input_stops_in_order(self):
        self.assertEqual(browse("", "--sim").returncode, 0)
        self.assertEqual(browse("", "--realtime", "off").returncode, 0)

    def test_quit_leaves_the_rest_alone(self):
        done = browse("quit\nnothing\n", "--sim")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)

    def test_a_mistake_is_told_and_the_next_line_goes_on(self):
        done = browse("Sourse.Frequency\n1 + 1\n", "--sim")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, "2\n")
        self.assertIn("error: unknown component or variable 'Sourse' "
                      "(did you mean 'Source'?)\n", done.stderr)

    def test_input_that_ends_within_a_statement_is_a_mistake(self):
        done = browse("if true then\n", "--sim")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the input ends within a statement", done.stderr)

    def test_two_simulated_runs_are_equal(self):
        lines = "watch Source.Position Filter.Filtered every 0.1 for 1\nrun 1\nls\n"
        first, second = (browse(lines, "--sim") for _ in range(2))
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual((first.stdout, first.stderr), (second.stdout, second.stderr))

    def test_for_ends_a_run_whose_input_stays_open(self):
        running = subprocess.Popen([PROGRAM, "run", WAVE, "--browse", "--realtime", "off", "--for",
                                    "100ms"], stdin=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(running.wait(timeout=LONG), 0)
        running.stdin.close()
        running.stderr.close()

    def test_for_ends_a_loop_without_end(self):
        done = browse("while true do end\n", "--realtime", "off", "--for", "100ms")
        self.assertIn("the application ends", done.stderr)

    def test_a_signal_stops_in_order_while_a_line_waits(self):
        running = subprocess.Popen([PROGRAM, "run", WAVE, "--browse", "--realtime", "off"],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        running.stdin.write("print('here')\nwait(1000)\n")
        running.stdin.flush()
        self.assertEqual(running.stdout.readline(), "here\n")
        running.send_signal(signal.SIGTERM)
        self.assertEqual(running.wait(timeout=LONG), 0)
        running.stdin.close()
        running.stdout.close()

    def test_a_script_and_the_browser_exclude_each_other(self):
        self.assertEqual(browse("", "--script", "x.lua").returncode, 2)


class InputsOfTheOperator(unittest.TestCase):
    """A deployment that opens an input without a writer (paper 2, section 4.2.1)."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.deployment = QUIET

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_it(self, *arguments, text=""):
        return subprocess.run([PROGRAM, "run", self.deployment, "--sim", *arguments], input=text,
                              capture_output=True, text=True, timeout=120)

    def test_the_prompt_writes_them_also_within_lines_of_lua(self):
        done = self.run_it("--browse", text="Filter.Raw = 1\nFilter.Filtered\n"
                           "Filter.Raw = 180 deg\nFilter.Raw\n"
                           "for i = 1, 2 do\n  Filter.Raw = 0.0\nend\nFilter.Raw\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines(),
                         ["Filter.Raw = 1 rad", "0.5 rad", "Filter.Raw = 3.14159265 rad",
                          "3.14159265 rad", "0 rad"])

    def test_what_is_no_value_of_theirs_is_refused(self):
        done = self.run_it("--browse", text="Filter.Raw = {1}\nFilter.Raw = 1 V\n"
                           "for i = 1, 2 do Filter.Raw = 'high' end\n"
                           "Watcher.Value = 1\nFilter.Raw\n")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("error: "), 4, done.stderr)
        self.assertIn("'Watcher.Value' is a port: only components write it", done.stderr)
        self.assertEqual(done.stdout, "not yet written\n")

    def test_a_script_may_not_write_them(self):
        script = self.file("write.lua", "Filter.Raw = 1\n")
        done = self.run_it("--script", script, "--for", "1s")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("write.lua:1: error: 'Filter.Raw' is an input of the operator: only the "
                      "operator writes it", done.stderr)

    def test_without_a_terminal_a_task_browser_asks_for_no_prompt(self):
        self.deployment = self.file("prompt.yaml", PROMPT)
        done = self.run_it("--for", "1s", text="Filter.Raw = 1\nFilter.Raw\n")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)


class Terminal:
    """The program behind a pseudo-terminal of 60 columns."""

    def __init__(self, *arguments, state, deployment=WAVE, browse=True, **environment):
        self.process_id, self.end = pty.fork()
        if self.process_id == 0:
            os.environ.update(TERM="xterm", XDG_STATE_HOME=state, **environment)
            asked = ["--browse"] if browse else []
            os.execv(PROGRAM, [PROGRAM, "run", deployment, *asked, *arguments])
        fcntl.ioctl(self.end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 60, 0, 0))
        self.raw = b""
        self.all = b""
        self.status = None

    def type(self, text):
        os.write(self.end, text.encode())

    def text(self):
        return ESCAPES.sub(b"", self.raw).decode(errors="replace")

    def read(self):
        """False when the program has closed the terminal."""
        if not select.select([self.end], [], [], LONG)[0]:
            raise AssertionError("nothing comes any more:\n" + self.text())
        try:
            came = os.read(self.end, 4096)
            self.raw += came
            self.all += came
            return True
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
        """Ctrl-D, once the prompt is there."""
        self.expect("> ")
        self.type("\x04")
        if self.wait() != 0:
            raise AssertionError(self.text())

    def wait(self):
        while self.read():
            pass
        _, status = os.waitpid(self.process_id, 0)
        self.status = os.waitstatus_to_exitcode(status)
        os.close(self.end)
        return self.status


class AtATerminal(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.open = []

    def tearDown(self):
        for terminal in self.open:
            if terminal.status is None:
                os.kill(terminal.process_id, signal.SIGKILL)
                terminal.wait()

    def browse(self, *arguments, **environment):
        terminal = Terminal(*arguments, state=self.folder.name, **environment)
        self.open.append(terminal)
        terminal.expect("> ")
        return terminal

    def test_tab_completes_and_lists(self):
        terminal = self.browse("--sim")
        terminal.type("Sou\t")
        terminal.expect("Source")
        terminal.type(".Fr\t\r")
        terminal.expect("2 Hz")
        terminal.type("Source.\t\t")
        terminal.expect("Source.Position")
        terminal.type("\x03")
        terminal.expect("^C")  # Ctrl-D behind "Source." would only list
        terminal.leave()

    def test_an_interrupt_while_the_terminal_takes_nothing_is_no_error_of_the_output(self):
        terminal = self.browse("--sim")
        terminal.type("\x13Sou")  # Ctrl-S: what the editor shows of it waits
        time.sleep(0.3)
        terminal.type("\x03")
        terminal.expect("^C")
        terminal.leave()

    def test_a_task_browser_in_the_deployment_opens_the_prompt(self):
        deployment = os.path.join(self.folder.name, "prompt.yaml")
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(PROMPT)
        terminal = self.browse("--sim", deployment=deployment, browse=False)
        terminal.type("Filter.Raw = 1\rFilter.Filtered\r")
        terminal.expect("0.5 rad")
        terminal.leave()

    def test_interrupt_clears_the_line_and_what_runs(self):
        terminal = self.browse("--sim")
        terminal.type("this is wrong\x03")
        terminal.expect("^C")
        terminal.expect("> ")
        terminal.type("while true do end\r")
        terminal.expect("end")
        time.sleep(0.2)  # whether Ctrl-C meets the loop or the line, the browser goes on
        terminal.type("\x03")
        terminal.expect("> ")
        terminal.type("1 + 1\r")
        terminal.expect("2\r\n")
        terminal.type("quit\r")
        self.assertEqual(terminal.wait(), 0)

    def test_a_second_interrupt_at_an_empty_prompt_stops_in_order(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("\x03")
        terminal.expect("stops the application")
        terminal.expect("> ")
        terminal.type("\x03")
        self.assertEqual(terminal.wait(), 0)

    def test_end_of_file_stops_in_order(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("\x04")
        self.assertEqual(terminal.wait(), 0)

    def test_end_of_file_is_heard_although_it_is_typed_ahead(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("wait 0.3\r")
        terminal.expect("wait 0.3\r\n")
        terminal.type("\x04")
        self.assertEqual(terminal.wait(), 0)

    def test_a_terminal_that_goes_away_stops_in_order(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("Source.Freq")
        terminal.expect("Source.Freq")
        os.close(terminal.end)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(terminal.process_id, 0)[1]), 0)
        terminal.status = 0

    def test_log_lines_go_above_the_line_that_is_typed(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("Source.Freq")
        terminal.expect("Source.Freq")
        terminal.expect("Watcher: ")
        terminal.expect("> Source.Freq")  # written anew below
        terminal.type("uency\r")
        terminal.expect("2 Hz")
        terminal.leave()

    def test_watch_ends_at_a_key(self):
        terminal = self.browse("--realtime", "off")
        terminal.type("watch Source.Position every 0.05\r")
        terminal.expect("any key ends it")
        terminal.expect("any key ends it")
        terminal.type("x")
        terminal.expect("> ")
        terminal.type("quit\r")
        self.assertEqual(terminal.wait(), 0)

    def test_history_is_kept(self):
        terminal = self.browse("--sim")
        terminal.type("40 + 2\r")
        terminal.expect("42")
        terminal.leave()
        again = self.browse("--sim")
        again.type("\x1b[A")
        again.expect("40 + 2")
        again.type("\r")
        again.expect("42")
        again.leave()

    def test_colour_can_be_refused(self):
        coloured = self.browse("--sim")
        coloured.type("nothing\r")
        coloured.expect("error:")
        coloured.leave()
        plain = self.browse("--sim", NO_COLOR="1")
        plain.type("nothing\r")
        plain.expect("error:")
        plain.leave()
        self.assertIn(b"\x1b[31merror:", coloured.all)
        self.assertNotIn(b"\x1b[31m", plain.all)

    def test_for_ends_it_while_somebody_types(self):
        terminal = self.browse("--realtime", "off", "--for", "300ms")
        terminal.type("Source")
        self.assertEqual(terminal.wait(), 0)

    def test_what_is_no_ascii_can_be_typed(self):
        terminal = self.browse("--sim")
        terminal.type("return 'größer', #'ö'\r")
        terminal.expect("größer\r\n2")
        terminal.leave()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
