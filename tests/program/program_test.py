#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the program `armature` does with right and wrong use: exit codes and messages.

usage: program_test.py PROGRAM EXAMPLES_DIR
"""

import json
import os
import resource
import shutil
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

    def test_unknown_values_are_told_with_the_known_ones(self):
        self.assert_wrong_use("run", WAVE, "--realtime", "maybe", says="(known: off, prefer, require)")
        self.assert_wrong_use("run", WAVE, "--realtime", "requir", says="did you mean 'require'?")
        self.assert_wrong_use("graph", WAVE, "--format", "pdf", says="svg, dot, mermaid")
        self.assert_wrong_use("graph", WAVE, "--only", "Source,Fliter",
                              says="--only: unknown component 'Fliter' (did you mean 'Filter'?)")

    def test_a_misspelt_option_has_a_suggestion(self):
        self.assert_wrong_use("run", WAVE, "--realtme", "off", says="did you mean '--realtime'?")
        self.assert_wrong_use("check", WAVE, "--ordr", says="did you mean '--order'?")

    def test_check_needs_a_file_or_serves(self):
        self.assert_wrong_use("check", says="file is required")
        self.assert_wrong_use("check", WAVE, "--serve", says="--serve")

    def test_a_pace_is_for_simulated_time_and_above_0(self):
        self.assert_wrong_use("run", WAVE, "--pace", "1", says="--sim")
        self.assert_wrong_use("run", WAVE, "--sim", "--pace", "0", says="--pace")

    def test_a_library_folder_that_is_not_there(self):
        self.assert_wrong_use("check", WAVE, "-L", "/nowhere", says="folder '/nowhere' does not exist")

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
        self.assertIn("<command line>: error: unknown mode 'fast': the deployment has no modes", done.stderr)

    def test_all_that_is_known_for_machines(self):
        done = armature("check", WAVE, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual([one["name"] for one in found["components"]], ["Source", "Filter", "Watcher"])
        self.assertEqual(found["connections"][0]["from"], "Source.Position")

    def test_mistakes_for_machines(self):
        with tempfile.TemporaryDirectory() as folder:
            wrong = os.path.join(folder, "wrong.yaml")
            with open(WAVE) as right, open(wrong, "w") as file:
                file.write(right.read().replace("Filter.Raw", "Filter.Row"))
            done = armature("check", wrong, "--json")
            self.assertEqual(done.returncode, 1)
            fixes = [one["fix"] for one in json.loads(done.stdout)["diagnostics"] if "fix" in one]
            self.assertEqual([(fix["found"], fix["by"]) for fix in fixes], [("Row", "Raw")])
            with open(wrong) as file:
                line = file.read().splitlines()[fixes[0]["line"] - 1]
            self.assertTrue(line[fixes[0]["column"] - 1:].startswith("Row"), line)

    def test_serves_an_editor_until_its_input_ends(self):
        requests = [{"id": 1, "do": "check", "file": WAVE, "members": False},
                    {"id": 2, "do": "fitting", "component": "Source", "member": "Position"},
                    {"id": 3, "do": "fly"}]
        done = armature("check", "--serve", input="".join(json.dumps(one) + "\n" for one in requests))
        self.assertEqual(done.returncode, 0, done.stderr)
        check, fitting, refused = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertTrue(check["result"]["ok"])
        self.assertEqual({end["member"] for end in fitting["result"]["ends"]}, {"Raw", "Value"})
        self.assertIn("unknown act 'fly'", refused["error"])

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
        self.assertIn("the property Whom is empty: set it to a name", done.stderr)

    def test_required_real_time_that_is_not_to_be_had(self):
        with open("/proc/version", encoding="utf-8") as version:
            if "PREEMPT_RT" in version.read():
                self.skipTest("this kernel gives everything that is asked for")
        done = armature("run", "--for", "1s", "--realtime", "require", WAVE)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("linux-image-rt", done.stderr)

    def test_stop_by_signal_is_in_order(self):
        # nohup, and a script's job in the background, ignore these from the start.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            running = subprocess.Popen([PROGRAM, "run", HELLO], stderr=subprocess.PIPE, text=True)
            for line in running.stderr:
                if "hello, robot!" in line:
                    break
            running.send_signal(sent)
            rest = running.stderr.read()
            self.assertEqual(running.wait(timeout=60), 0, rest)
            self.assertIn("goodbye after", rest)
            running.stderr.close()

    def run_to_its_end(self, stream):
        """A run in real time whose messages go to `stream`; what its summary says."""
        with tempfile.TemporaryDirectory() as folder:
            running = subprocess.Popen([PROGRAM, "run", HELLO, "--for", "2s", "--statistics", "--out", folder],
                                       stdout=stream, stderr=stream)
            os.close(stream)
            yield running
            self.assertEqual(running.wait(timeout=60), 0)
            with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
                yield json.load(file)

    def test_a_reader_of_the_output_that_goes_away_stops_nothing_and_lost_lines_are_counted(self):
        reader, writer = os.pipe()
        run = self.run_to_its_end(writer)
        next(run)
        os.read(reader, 1)
        os.close(reader)
        summary = next(run)
        self.assertEqual(summary["end"], "time up")
        self.assertGreater(summary["lines_lost"], 0)

    def test_output_that_nobody_reads_holds_up_nothing(self):
        reader, writer = os.pipe()
        os.set_blocking(writer, False)
        try:
            while True:
                os.write(writer, b"." * 512)
        except BlockingIOError:
            os.set_blocking(writer, True)
        run = self.run_to_its_end(writer)
        next(run)
        self.assertEqual(next(run)["end"], "time up")
        os.close(reader)

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

    def test_graph_shows_a_few_components_or_every_line(self):
        done = armature("graph", WAVE, "--format", "dot", "--only", "Watcher,Watcher")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Filter", done.stdout)
        self.assertNotIn('label="Source\\n', done.stdout)
        each = armature("graph", WAVE, "--format", "dot", "--each-line")
        self.assertEqual((each.returncode, each.stdout.count(" -> ")), (0, 2))
        self.assertIn('label="Source\\n', each.stdout)

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


class Files(unittest.TestCase):
    """What is read is a file, what is written is told if it is not, and nothing overwrites its source."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def assert_fails(self, done, says, code=1):
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(says, done.stderr)

    def test_a_pipe_is_no_file_and_nobody_waits_for_it(self):
        pipe, including = self.path("pipe.yaml"), self.path("including.yaml")
        os.mkfifo(pipe)
        self.assert_fails(armature("check", pipe), "it is a pipe, and a file is expected")
        for key in ("include: pipe.yaml", "libraries: [./pipe.yaml]",
                    "network: {policy: pipe.yaml, listen: unix:x}"):
            with open(including, "w", encoding="ascii") as file:
                file.write(f"{key}\ncomponents: {{}}\n")
            self.assert_fails(armature("check", including), "it is a pipe")
        os.mkfifo(self.path("run.json"))
        os.mkfifo(self.path("a.mcap"))
        self.assertNotEqual(armature("report", self.folder).returncode, 0)
        self.assert_fails(armature("run", WAVE, "--sim", "--script", pipe), "it is a pipe")
        self.assert_fails(armature("check", "/dev/zero"), "it is a device")

    def test_output_that_cannot_be_written_is_told(self):
        for command in (["models"], ["graph", WAVE], ["check", WAVE, "--order"], ["check", WAVE, "--load"], ["--help"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([PROGRAM, *command], stdout=full, stderr=subprocess.PIPE, text=True, timeout=120)
            self.assert_fails(done, "cannot write the standard output: No space left on device")
        self.assert_fails(armature("graph", WAVE, "-o", "/dev/full"), "cannot write '/dev/full'")

    def test_a_file_that_may_not_grow_ends_nothing_and_is_told(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY))
        done = armature("run", WAVE, "--sim", "--for", "60s", "--trace", self.path("trace.json"), preexec_fn=limit)
        self.assert_fails(done, "File too large")
        self.assertEqual(os.path.getsize(self.path("trace.json")), 4096)
        with open(self.path("log"), "wb") as log:
            log.write(b"." * 4096)
            log.flush()
            run = subprocess.run([PROGRAM, "run", WAVE, "--for", "200 ms"], stdout=log, stderr=log, timeout=120,
                                 preexec_fn=limit)
        self.assertGreaterEqual(run.returncode, 0, "it was not killed")

    def test_nothing_overwrites_what_it_is_made_of(self):
        source = self.path("a.yaml")
        shutil.copy(WAVE, source)
        os.symlink(source, self.path("soft.yaml"))
        os.link(source, self.path("hard.yaml"))
        with open(self.path("including.yaml"), "w", encoding="ascii") as file:
            file.write("include: a.yaml\n")
        before = open(source, "rb").read()
        for name in ("a.yaml", "soft.yaml", "hard.yaml"):
            self.assert_fails(armature("convert", source, self.path(name)), "is the file that is read", 2)
            self.assert_fails(armature("convert", self.path("including.yaml"), self.path(name)), "is the file that is read", 2)
            self.assert_fails(armature("graph", source, "-o", self.path(name)), "is the file that is read", 2)
            self.assert_fails(armature("run", source, "--sim", "--write-times", self.path(name)), "is the deployment")
        self.assertEqual(open(source, "rb").read(), before)
        self.assert_fails(armature("report", self.folder, "--out", source), "ends in .html", 2)

    def test_what_is_written_at_the_end_is_looked_at_before_the_run(self):
        done = armature("run", WAVE, "--sim", "--for", "1h", "--write-times", "/nowhere/times")
        self.assert_fails(done, "cannot write '/nowhere/times': No such file or directory")
        self.assertNotIn("Watcher:", done.stderr)

    def test_a_folder_of_recordings_is_of_one_run_at_a_time(self):
        out = self.path("out")
        first = subprocess.Popen([PROGRAM, "run", WAVE, "--realtime", "off", "--out", out], stderr=subprocess.PIPE)
        self.addCleanup(first.stderr.close)
        self.addCleanup(first.wait)
        self.addCleanup(first.kill)
        end = time.monotonic() + 60
        while not os.path.exists(os.path.join(out, ".armature.lock")) and time.monotonic() < end:
            time.sleep(0.01)
        self.assert_fails(armature("run", WAVE, "--sim", "--for", "1s", "--out", out),
                          f"is used by another run, process {first.pid}; give --out another folder")
        first.kill()
        first.wait()
        done = armature("run", WAVE, "--sim", "--for", "1s", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
