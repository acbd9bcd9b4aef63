#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the program `armature` does with right and wrong use: exit codes and messages.

usage: program_test.py PROGRAM EXAMPLES_DIR
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, EXAMPLES = sys.argv[1:3]
WAVE = os.path.join(EXAMPLES, "02_ports_and_triggers", "wave.yaml")
HELLO = os.path.join(EXAMPLES, "01_hello", "hello.yaml")


def armature(*arguments, **more):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **more)


class WrongUse(unittest.TestCase):
    def assert_wrong_use(self, *arguments, says):
        done = armature(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(says, done.stderr + done.stdout)

    def test_no_command(self):
        self.assert_wrong_use(says="subcommand is required")

    def test_unknown_command(self):
        self.assert_wrong_use("fly", says="fly")

    def test_unknown_option(self):
        self.assert_wrong_use("run", WAVE, "--fast", says="--fast")

    def test_no_file(self):
        self.assert_wrong_use("run", says="file")

    def test_time_that_is_none(self):
        for text in ("fast", "0s", "-1s", "1 m", ""):
            self.assert_wrong_use("run", WAVE, "--for", text, says="--for")

    def test_unknown_realtime_mode(self):
        self.assert_wrong_use("run", WAVE, "--realtime", "maybe", says="maybe")

    def test_help_is_no_mistake(self):
        done = armature("run", "--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--sim", done.stdout)

    def test_version(self):
        done = armature("--version")
        self.assertEqual(done.returncode, 0)
        self.assertIn("armature 0.", done.stdout)


class Checking(unittest.TestCase):
    def test_good_file(self):
        done = armature("check", WAVE, "--order")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("hosts Filter", done.stdout)
        self.assertIn("3 components, 2 connections, no errors", done.stderr)

    def test_file_that_is_not_there(self):
        done = armature("check", "/nowhere.yaml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere.yaml", done.stderr)
        self.assertIn("No such file", done.stderr)

    def test_one_mistake_is_one_error(self):
        done = armature("check", WAVE, "--set", "Source.Frequency=100 Hz")
        self.assertTrue(done.stderr.endswith(f"armature: {WAVE}: 1 error\n"), done.stderr)

    def test_all_mistakes_in_one_run(self):
        done = armature("check", WAVE, "--set", "Source.Frequency=100 Hz", "--set", "Filtr.Weight=1",
                        "--set", "Watcher.activity.priority=200")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("error:"), 3, done.stderr)
        self.assertIn("did you mean 'Filter'?", done.stderr)

    def test_mode_that_is_not_there(self):
        done = armature("check", WAVE, "--mode", "fast")
        self.assertEqual(done.returncode, 1)
        self.assertIn("<command line>: error: there is no mode 'fast', as there are no modes", done.stderr)

    def test_run_refuses_what_check_refuses(self):
        done = armature("run", "--sim", "--for", "1s", WAVE, "--set", "Source.Frequency=100 Hz")
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("Watcher:", done.stderr)


class Running(unittest.TestCase):
    def test_two_simulated_runs_are_equal(self):
        first, second = (armature("run", "--sim", "--for", "20s", WAVE) for _ in range(2))
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual(first.stderr, second.stderr)
        self.assertEqual(first.stderr.count("Watcher:"), 100)

    def test_log_lines_for_machines(self):
        done = armature("--log-json", "run", "--sim", "--for", "1s", HELLO)
        lines = [json.loads(line) for line in done.stderr.splitlines()]
        self.assertEqual(lines[0], {"time": 0.5, "level": "info", "component": "Greeter",
                                    "message": "hello, robot! (1)"})

    def test_refusal_to_configure(self):
        done = armature("run", "--sim", "--for", "1s", HELLO, "--set", "Greeter.Whom=''")
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is nobody to greet: set the property Whom", done.stderr)

    def test_required_real_time_that_is_not_to_be_had(self):
        with open("/proc/version", encoding="utf-8") as version:
            if "PREEMPT_RT" in version.read():
                self.skipTest("this kernel gives everything that is asked for")
        done = armature("run", "--for", "1s", "--realtime", "require", WAVE)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("linux-image-rt", done.stderr)

    def test_stop_by_signal_is_in_order(self):
        for sent in (signal.SIGINT, signal.SIGTERM):
            running = subprocess.Popen([PROGRAM, "run", HELLO], stderr=subprocess.PIPE, text=True)
            for line in running.stderr:
                if "hello, robot!" in line:
                    break
            running.send_signal(sent)
            rest = running.stderr.read()
            self.assertEqual(running.wait(timeout=60), 0, rest)
            self.assertIn("goodbye after", rest)
            running.stderr.close()

    def test_old_data_on_an_input_stops_and_says_so(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("""
application: stale
libraries: [wave]
on_fault: stop_all
components:
  Source: {model: Source, activity: {periodic: 500 ms}}
  Watcher: {model: Watcher, activity: {periodic: 10 ms}}
connections:
  - {from: Source.Position, to: Watcher.Value, max_age: 100 ms, on_old: stop}
""")
            file.flush()
            done = armature("run", "--sim", "--for", "5s", file.name)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("older than declared", done.stderr)


class Timeline(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "trace.json")

    def test_has_every_cycle_with_the_steps_of_its_components(self):
        done = armature("run", WAVE, "--sim", "--for", "1s", "--trace", self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path, encoding="utf-8") as file:
            events = json.load(file)
        names = {event["args"]["name"] for event in events if event["name"] == "thread_name"}
        self.assertIn("Source", names)
        thread = next(e["tid"] for e in events if e["ph"] == "M" and e["args"]["name"] == "Source")
        mine = [e for e in events if e.get("tid") == thread and e["ph"] == "X"]
        cycles = [e for e in mine if e["cat"] == "cycle"]
        self.assertEqual([e["args"]["cycle"] for e in cycles], list(range(1, 101)))
        for step in (e for e in mine if e["cat"] == "step"):
            around = [c for c in cycles if c["ts"] <= step["ts"] <= c["ts"] + c["dur"]]
            self.assertEqual(len(around), 1, step)
        self.assertEqual({e["name"] for e in mine if e["cat"] == "step"}, {"Source", "Filter"})

    def test_is_there_after_a_kill_up_to_the_last_second(self):
        run = subprocess.Popen(
            [PROGRAM, "run", WAVE, "--realtime", "off", "--trace", self.path],
            stderr=subprocess.DEVNULL)
        try:
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and self.whole_lines() < 300:
                time.sleep(0.05)
        finally:
            run.kill()
            run.wait()
        self.assertGreaterEqual(self.whole_lines(), 300)

    def whole_lines(self):
        """Events of a file that ends anywhere, read as Perfetto does."""
        if not os.path.exists(self.path):
            return 0
        with open(self.path, encoding="utf-8") as file:
            text = file.read()
        whole = text[:text.rfind("\n")].rstrip(",\n")
        return len(json.loads(whole + "]")) if whole else 0

    def test_file_that_cannot_be_made_is_told_before_anything_runs(self):
        done = armature("run", WAVE, "--sim", "--for", "1s", "--trace", "/no/such/folder/t.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write '/no/such/folder/t.json'", done.stderr)

    def test_full_disk_ends_nothing_and_is_told(self):
        done = armature("run", WAVE, "--sim", "--for", "5s", "--trace", "/dev/full")
        self.assertEqual(done.returncode, 1)
        self.assertIn("No space left on device: the timeline lacks", done.stderr)


class Scripts(unittest.TestCase):
    def run_script(self, text, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wave.lua")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            done = armature("run", "--sim", "--for", "20s", WAVE, "--script", path, *arguments)
        done.stderr = done.stderr.replace(path, "wave.lua")
        return done

    def test_commands_the_application_until_it_stops_it(self):
        done = self.run_script("wait(2.5)\n"
                               "print(now(), Source.Frequency)\nstop()")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "2.5\t2.0\n")

    def test_mistake_ends_the_run_in_order(self):
        done = self.run_script("wait(1)\nSource.Frequncy = 1")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("error"), 1, done.stderr)
        self.assertIn("wave.lua:2: error: 'Source' has no property 'Frequncy' "
                      "(did you mean 'Frequency'?)\n", done.stderr)

    def test_mistake_of_syntax_is_found_before_anything_starts(self):
        done = self.run_script("wait(1")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "wave.lua:1: error: ')' expected near <eof>\n")

    def test_script_that_is_not_there(self):
        done = armature("run", "--sim", "--for", "1s", WAVE, "--script", "/nowhere.lua")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere.lua", done.stderr)


class Looking(unittest.TestCase):
    def test_models_for_machines(self):
        done = armature("models", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        names = [model["name"] for model in json.loads(done.stdout)]
        self.assertIn("LowPass", names)

    def test_unknown_model_has_a_suggestion(self):
        done = armature("models", "LowPas")
        self.assertEqual(done.returncode, 1)
        self.assertIn("LowPass", done.stderr)

    def test_graph_formats(self):
        for kind, begins in (("svg", "<svg"), ("dot", "digraph"), ("mermaid", "flowchart")):
            done = armature("graph", WAVE, "--format", kind)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(begins, done.stdout)
            self.assertIn("Filter", done.stdout)

    def test_convert_there_and_back(self):
        with tempfile.TemporaryDirectory() as work:
            xml, yaml = os.path.join(work, "wave.xml"), os.path.join(work, "wave.yaml")
            self.assertEqual(armature("convert", WAVE, xml).returncode, 0)
            self.assertEqual(armature("convert", xml, yaml).returncode, 0)
            first, second = (armature("run", "--sim", "--for", "1s", file) for file in (xml, yaml))
            self.assertEqual(first.returncode, 0, first.stderr)
            self.assertEqual([line for line in first.stderr.splitlines() if "Watcher:" in line],
                             [line for line in second.stderr.splitlines() if "Watcher:" in line])

    def test_convert_to_no_known_format(self):
        done = armature("convert", WAVE, "/tmp/wave.txt")
        self.assertEqual(done.returncode, 2)
        self.assertIn("must end in .yaml, .yml or .xml", done.stderr)

    def test_convert_to_where_nothing_can_be_written(self):
        done = armature("convert", WAVE, "/nowhere/wave.xml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere/wave.xml", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
