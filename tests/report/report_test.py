#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `armature report` makes of the demonstration's runs, and of folders with mistakes.

usage: report_test.py PROGRAM JANUS_FOLDER LIBRARY_FOLDER [JANUS_IO_CYCLE]

Its figures are computed once more here, from the CSV files; those of Janus are held against what
the head is to reach. Where chromium is installed, the page is run in it.
"""

import base64
import html.parser
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, JANUS, LIBRARIES = sys.argv[1:4]
IO_CYCLE = sys.argv[4] if len(sys.argv) > 4 else None
CHROMIUM = shutil.which("chromium")
CONTROLLERS = ("pid", "pid_feedforward")
COUNT = 2 * math.pi / 2000 * 0.01  # rad of a joint for a count of its encoder


def armature(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


def run_demo(folder, controller):
    done = armature("run", f"{JANUS}/demo/{controller}.yaml", "-L", LIBRARIES, "--sim", "--script",
                    f"{JANUS}/experiment.lua", "--out", folder)
    assert done.returncode == 0, done.stderr


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def trace_of_cycles():
    """As `armature run --trace` writes one: 20 cycles of 10 ms, of 500 us and a little more each."""
    events = [{"ph": "M", "name": "thread_name", "pid": 1, "tid": 1, "args": {"name": "Sampler"}}]
    for k in range(20):
        for name, begin, length in (("cycle", 0, 500 + k), ("Sampler", 0, 10), ("Joint1", 10, 10),
                                    ("AIC1", 20, 180), ("Joint1", 200, 20), ("Controller", 250, 10),
                                    ("PID1", 260, 30)):
            category = "cycle" if name == "cycle" else "step"
            events.append({"ph": "X", "name": name, "cat": category, "ts": 1000 + 10000 * k + begin,
                           "dur": length, "pid": 1, "tid": 1})
    return {"traceEvents": events}


def column_by_time(csv, name):
    """time in s: value, of what a CSV file has in one column."""
    with open(csv, encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    index = lines[0].split(",").index(name)
    rows = [line.split(",") for line in lines[1:]]
    return {float(row[0]): float(row[index]) for row in rows if row[index] != "nan"}


def trapezoid(values, period):
    return period * (sum(values) - (values[0] + values[-1]) / 2)


def figures_from_csv(csv, joint, period=0.01):
    desired = column_by_time(csv, f"PID{joint}_Ref")
    measured = column_by_time(csv, f"PID{joint}_Sen")
    armed = [column_by_time(csv, f"Joint{each}_Armed") for each in (1, 2)]
    begin = max(min(time for time, on in each.items() if on) for each in armed)
    end = min(max(each) for each in armed)
    errors = [desired[time] - measured[time] for time in sorted(measured) if begin <= time < end]
    times = [k * period for k in range(len(errors))]
    size = [abs(error) for error in errors]
    return {"iae": trapezoid(size, period),
            "itae": trapezoid([t * e for t, e in zip(times, size)], period),
            "ise": trapezoid([e * e for e in size], period),
            "itse": trapezoid([t * e * e for t, e in zip(times, size)], period),
            "max_abs_error_rad": max(size),
            "final_error_rad": errors[-1],
            "final_error_counts": errors[-1] / COUNT}


class ExperimentOfPaper2(unittest.TestCase):
    def test_reaches_the_four_integrals_of_joint_1_in_the_papers_table(self):
        with tempfile.TemporaryDirectory() as folder:
            done = armature("run", f"{JANUS}/demo/paper2.yaml", "-L", LIBRARIES, "--sim", "--script",
                            f"{JANUS}/paper2.lua", "--out", os.path.join(folder, "paper2"))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("joint 1: IAE 0.0", done.stdout)
            shutil.copy(f"{JANUS}/demo/paper2_to_reach.json", os.path.join(folder, "to_reach.json"))
            done = armature("report", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("warning", done.stderr)
            report = load(os.path.join(folder, "report.json"))
        self.assertEqual([(goal["most"], goal["reached"]) for goal in report["to_reach"]],
                         [(0.0213, True), (0.0271, True), (0.0012, True), (0.0014, True)])
        joints = report["controllers"]["paper2"]["joints"]
        self.assertEqual([joint["joint"] for joint in joints], ["1", "2"])
        for joint in joints:
            self.assertGreater(joint["iae"], 0)
            self.assertGreater(joint["from_s"], 0.1, "from arming on")
        efforts = report["runs"]["paper2"]["efforts"]
        self.assertEqual([(effort["joint"], effort["limit"]) for effort in efforts],
                         [("1", 12.0), ("2", 12.0)])


class Demonstration(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = cls.holder.name
        for controller in CONTROLLERS:
            run_demo(os.path.join(cls.folder, controller), controller)
        with open(os.path.join(cls.folder, "pid", "trace.json"), "w", encoding="utf-8") as file:
            json.dump(trace_of_cycles(), file)
        shutil.copy(f"{JANUS}/demo/phases.json", cls.folder)
        if IO_CYCLE:
            with open(os.path.join(cls.folder, "io.json"), "w", encoding="utf-8") as file:
                subprocess.run([IO_CYCLE, JANUS, LIBRARIES], stdout=file, check=True, timeout=120)
        done = armature("report", cls.folder)
        assert done.returncode == 0, done.stderr
        assert f"wrote {cls.folder}/report.html and {cls.folder}/report.json" in done.stderr
        assert "warning" not in done.stderr, done.stderr
        cls.report = load(os.path.join(cls.folder, "report.json"))
        with open(os.path.join(cls.folder, "report.html"), encoding="utf-8") as file:
            cls.page = file.read()

    def joints(self, controller):
        return self.report["controllers"][controller]["joints"]

    def test_every_controller_and_joint_is_there(self):
        self.assertEqual(list(self.report["controllers"]), list(CONTROLLERS))
        for controller in CONTROLLERS:
            self.assertEqual([joint["joint"] for joint in self.joints(controller)], ["1", "2"])
            for joint in self.joints(controller):
                self.assertEqual(joint["samples_missing"], 0)

    def test_figures_are_what_the_csv_file_gives(self):
        for controller in CONTROLLERS:
            csv = os.path.join(self.folder, controller, "janus.csv")
            for number, joint in enumerate(self.joints(controller), start=1):
                for name, expected in figures_from_csv(csv, number).items():
                    self.assertTrue(math.isclose(joint[name], expected, rel_tol=1e-9, abs_tol=1e-15),
                                    f"{controller}, joint {number}: {name} is {joint[name]}, the "
                                    f"file gives {expected}")

    def test_pids_reach_what_they_are_to_reach(self):
        for joint in self.joints("pid"):
            self.assertLessEqual(joint["max_abs_error_rad"], 0.01)
            self.assertLessEqual(joint["iae"], 0.0213)
            self.assertLessEqual(joint["at_rest_error_counts"], 2.01)
            self.assertLessEqual(abs(joint["final_error_counts"]), 2.01)

    def test_feed_forward_leaves_a_tenth_of_the_error(self):
        for alone, both in zip(self.joints("pid"), self.joints("pid_feedforward")):
            self.assertLessEqual(both["iae"], 0.1 * alone["iae"])
            self.assertLessEqual(both["at_rest_error_counts"], 2.01)

    @unittest.skipUnless(IO_CYCLE, "janus_io_cycle is not part of this build")
    def test_the_cycle_on_the_bus_reaches_what_it_is_to_reach(self):
        sequential, synchronous = (self.report["io"][mode] for mode in ("sequential", "synchronous"))
        # Simulated, so exact on every machine:
        self.assertLessEqual(sequential["bus_us"], 1.01 * sequential["monolithic_bus_us"])
        self.assertLessEqual(synchronous["bus_us"], 1.05 * (synchronous["wire_us"] + 90))
        self.assertLess(synchronous["bus_us"], sequential["bus_us"])
        # With what was computed, for which a busy machine takes longer:
        self.assertLessEqual(sequential["cycle_us"], 1.05 * sequential["monolithic_cycle_us"])
        self.assertLessEqual(synchronous["cycle_us"], 1.10 * (synchronous["wire_us"] + 90))
        for mode in (sequential, synchronous):
            self.assertGreater(mode["wire_us"], 4 * 47)  # four frames or more, of 47 bits or more
            self.assertGreater(mode["bus_us"], mode["wire_us"] + 89)

    def test_the_phases_of_a_traced_cycle_are_beside_those_of_the_paper(self):
        phases = {phase["name"]: phase for phase in self.report["runs"]["pid"]["phases"]}
        computing = {name: phase["computing_us"] for name, phase in phases.items()}
        self.assertEqual(computing["Joint1 senses"], 210)  # with its card, until PID1 runs
        self.assertEqual(computing["Controller, with its PIDs"], 40)
        self.assertIsNone(computing["Sensor"], "it is not in the trace")
        elsewhere = [phase["elsewhere_us"] for phase in phases.values()]
        self.assertEqual(elsewhere, [259, 259, 20, 30, 10, 150, 724])
        if IO_CYCLE:
            bus = self.report["io"]["sequential"]["joint1_sensing_us"]
            self.assertEqual(phases["Joint1 senses"]["us"], 210 + bus)
        self.assertNotIn("phases", self.report["runs"]["pid_feedforward"], "it has no trace")

    def test_a_run_says_how_it_fared(self):
        run = self.report["runs"]["pid"]["summary"]
        self.assertEqual((run["application"], run["time"], run["end"]),
                         ("janus-pid", "simulated", "stopped as asked"))
        self.assertEqual((run["faults"], run["reactions"], run["casualties"]), (0, 0, []))
        self.assertAlmostEqual(run["duration_s"], 60.41, delta=0.02)
        sampler = next(thread for thread in run["threads"] if thread["name"] == "Sampler")
        self.assertEqual(sampler["cycles_run"], sampler["cycles_due"])
        self.assertEqual(sampler["cycles_skipped"], 0)

    def test_the_same_runs_give_the_same_page(self):
        other = os.path.join(self.folder, "again.html")
        self.assertEqual(armature("report", self.folder, "--out", other).returncode, 0)
        with open(other, encoding="utf-8") as file:
            self.assertEqual(file.read(), self.page)

    def test_the_page_loads_nothing(self):
        page = Page()
        page.feed(self.page)
        page.close()
        self.assertEqual(page.open, [], "elements that are not closed")
        self.assertEqual(page.loads, [])
        self.assertTrue("Permission is hereby granted" in self.page, "uPlot's license")
        for text in page.texts["style"] + page.texts["script"]:
            code = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
            code = code.replace("'http://www.w3.org/2000/svg'", "")  # a name, which nobody opens
            self.assertNotRegex(code, r"https?://|@import|\burl\(|\bfetch\(|XMLHttpRequest|import\(")
        data = json.loads(page.texts["script"][0])
        self.assertEqual([run["name"] for run in data["runs"]], list(CONTROLLERS))
        self.assertEqual(len(data["runs"][0]["joints"][0]["curves"]["measured"]["v"]), 6040)
        timeline = data["runs"][0]["timeline"]
        self.assertEqual([lane["component"] for lane in timeline["lanes"]],
                         ["Sampler", "Joint1", "AIC1", "Controller", "PID1"])
        self.assertAlmostEqual(timeline["length_us"], 509, delta=1)

    def test_moments_are_what_the_joints_said(self):
        for controller in CONTROLLERS:
            moments = self.report["runs"][controller]["moments"]
            self.assertEqual([one["kind"] for one in moments], ["armed", "disarmed"])
            self.assertAlmostEqual(moments[0]["time_s"], 0.43, delta=0.03)
            self.assertAlmostEqual(moments[1]["time_s"], 60.43, delta=0.03)
            self.assertEqual(sorted(moments[0]["told"]), ["Joint1: armed", "Joint2: armed"])

    def test_velocities_and_efforts_have_their_limits(self):
        for controller in CONTROLLERS:
            run = self.report["runs"][controller]
            csv = os.path.join(self.folder, controller, "janus.csv")
            self.assertEqual((len(run["velocities"]), len(run["efforts"])), (2, 2))
            for number, (velocity, effort) in enumerate(zip(run["velocities"], run["efforts"]), start=1):
                self.assertEqual((velocity["joint"], velocity["limit_rad_s"]), (str(number), 3.0))
                self.assertGreater(velocity["largest_rad_s"], 0.9)
                self.assertLess(velocity["largest_of_limit"], 0.4)
                self.assertEqual((effort["unit"], effort["limit"]), ("V", 12.0))
                voltages = column_by_time(csv, f"Joint{number}_VoltageActuator_value").values()
                self.assertAlmostEqual(effort["largest"], max(map(abs, voltages)), delta=1e-9)

    def test_title_and_heading_are_the_applications(self):
        self.assertIn("<title>janus-pid, janus-pid-feed-forward</title>", self.page)

    def test_the_page_is_below_3_MB(self):
        self.assertLess(os.path.getsize(os.path.join(self.folder, "report.html")), 3_000_000)

    @unittest.skipUnless(CHROMIUM, "chromium is not installed: nobody has run the page")
    def test_the_page_runs_at_the_width_of_a_desk_and_of_a_phone(self):
        texts = ["10.0 <small>mrad s</small>", ">Sampler</div>", ">Controller</div>",
                 "<h1>janus-pid, janus-pid-feed-forward</h1>", ">Velocity</h2>", ">Effort</h2>",
                 ">The phases of a cycle</h2>", "Both joints actuate"]
        for width in (1280, 390):
            probed = probe(self.page, width, texts, self.folder)
            self.assertEqual(probed["width"], width)
            self.assertEqual(probed["needs"], width, "the page is wider than the window")
            self.assertEqual(probed["beyond"], [], "beyond the window, and not in a table")
            self.assertEqual(probed["absent"], [], "is not on the page")
            # Of two joints: errors, positions in each of two runs, velocities, efforts; then the others.
            self.assertGreaterEqual(probed["canvases"], 10)
            self.assertEqual(probed["inked"], probed["canvases"], "curves that were not drawn")
            self.assertEqual(len(probed["labels"]), probed["canvases"])
            for label in probed["labels"]:
                self.assertRegex(label, r"over time, armed at 0\.4\d* s, .*disarmed at 60\.4\d* s")
            self.assertEqual(probed["marked"], probed["canvases"], "curves without marks")

    @unittest.skipUnless(CHROMIUM, "chromium is not installed: nobody has run the page")
    def test_a_long_name_does_not_make_a_phone_scroll_sideways(self):
        page = self.page.replace('"name":"pid_feedforward"', '"name":"' + "w" * 70 + '"')
        probed = probe(page, 390, ["w" * 70 + "</td>"], self.folder)
        self.assertEqual((probed["needs"], probed["beyond"], probed["absent"]), (390, [], []))


PROBE = """<script>
  for (const d of document.querySelectorAll('details')) d.open = true;
  const all = (what) => [...document.querySelectorAll(what)];
  const inked = (data) => data.some((x) => x > 0);
  const pixels = (c) => c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  setTimeout(() => {
    const drawn = all('canvas').map((c) => [pixels(c), 4 * c.width * 8 * devicePixelRatio]);
    parent.postMessage({
    width: innerWidth, needs: document.documentElement.scrollWidth,
    beyond: all('main *').filter((e) => !e.closest('.scroll > table') && e.getBoundingClientRect().right > innerWidth + 0.5)
      .map((e) => e.outerHTML.slice(0, 80)),
    absent: TEXTS.filter((text) => !document.body.innerHTML.includes(text)),
    canvases: drawn.length,
    inked: drawn.filter(([data]) => inked(data)).length,
    marked: drawn.filter(([data, strip]) => inked(data.subarray(0, strip))).length,
    labels: all('.canvas').map((c) => c.getAttribute('aria-label'))}, '*');
  }, 500);
</script>"""

FRAME = """<!doctype html><body style="margin: 0"><iframe src="file://PATH"
  style="border: 0; width: WIDTHpx; height: 2000px"></iframe><script>
  onmessage = (told) => document.body.setAttribute('data-probe', btoa(unescape(encodeURIComponent(JSON.stringify(told.data)))));
</script>"""


def probe(page, width, texts, folder):
    """What a browser makes of the page, in a frame: a window of chromium is 500 pixels wide at least."""
    path, frame = os.path.join(folder, "probed.html"), os.path.join(folder, "frame.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page.replace("</body>", PROBE.replace("TEXTS", json.dumps(texts).replace("</", "<\\/")) + "</body>"))
    with open(frame, "w", encoding="utf-8") as file:
        file.write(FRAME.replace("PATH", path).replace("WIDTH", str(width)))
    done = run_chromium(frame)
    assert "CONSOLE" not in done.stderr, done.stderr
    found = re.search(r'data-probe="([^"]*)"', done.stdout)
    assert found, done.stderr
    return json.loads(base64.b64decode(found.group(1)))


def run_chromium(path):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic",
             "--no-first-run", "--disable-background-networking", "--disable-component-update",
             "--disable-sync", "--hide-scrollbars", f"--user-data-dir={profile}",
             "--window-size=1280,2000", "--enable-logging=stderr", "--virtual-time-budget=6000",
             "--dump-dom", f"file://{path}"], capture_output=True, text=True, timeout=120)


class Page(html.parser.HTMLParser):
    """Elements that stay open, what is loaded, and the texts of scripts and styles."""

    VOID = {"meta", "link", "br", "hr", "img", "input"}

    def __init__(self):
        super().__init__()
        self.open, self.loads, self.texts = [], [], {"script": [], "style": []}

    def handle_starttag(self, tag, attributes):
        if tag not in self.VOID:
            self.open.append(tag)
        self.loads += [value for name, value in attributes
                       if name in ("src", "href", "srcset", "action") and value != "data:,"]

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> within {self.open}"
        self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] in self.texts:
            self.texts[self.open[-1]].append(data)


class Mistakes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.good = os.path.join(cls.holder.name, "good")
        cls.run_short(cls.good)

    @staticmethod
    def run_short(folder, *more):
        done = armature("run", f"{JANUS}/demo/pid.yaml", "-L", LIBRARIES, "--sim", "--for", "3s",
                        "--out", folder, *more)
        assert done.returncode == 0, done.stderr

    def setUp(self):
        self.folder = os.path.join(self.holder.name, self.id().split(".")[-1])
        os.mkdir(self.folder)

    def copy(self, name="run"):
        return shutil.copytree(self.good, os.path.join(self.folder, name))

    def write(self, content, *path):
        with open(os.path.join(self.folder, *path), "wb") as file:
            file.write(content)

    def assert_refused(self, *arguments, says, code=1):
        done = armature("report", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "report.html")))
        self.assertFalse(os.path.exists(os.path.join(self.folder, "report.json")))

    def test_no_folder_is_wrong_use(self):
        self.assert_refused(says="folder is required", code=2)

    def test_a_folder_that_is_not_there(self):
        self.assert_refused("/nowhere", says=["/nowhere", "No such file or directory"])

    def test_a_file_is_no_folder(self):
        path = os.path.join(self.good, "janus.mcap")
        self.assert_refused(path, says=[path, "Not a directory"])

    def test_an_empty_folder(self):
        self.assert_refused(self.folder, says=[f"no run in '{self.folder}'", "expected a recording",
                                               "armature run FILE --out FOLDER"])

    def test_a_damaged_recording_is_named(self):
        run = self.copy()
        with open(os.path.join(run, "janus.mcap"), "r+b") as file:
            file.seek(5000)
            file.write(b"!!!!!!!!")
        self.assert_refused(self.folder, says=["run/janus.mcap", "byte"])

    def test_every_mistake_is_told_at_once(self):
        self.copy()
        self.write(b"{", "run", "run.json")
        self.write(b'{"traceEvents": 1}', "run", "trace.json")
        self.write(b"[]", "io.json")
        self.write(b'{"to_reach": [{"name": "speed", "figure": "speed", "most": 1}]}', "to_reach.json")
        self.assert_refused(self.folder, says=["run.json", "expected JSON", "trace.json",
                                               "traceEvents", "io.json", "a JSON object", "to_reach.json",
                                               "goal 1, 'speed', has the figure 'speed'"])

    def test_a_page_that_cannot_be_written(self):
        self.copy()
        self.assert_refused(self.folder, "--out", "/nowhere/report.html", says="/nowhere/report.html")

    def test_a_recording_that_was_cut_off_is_shown_to_its_last_whole_chunk(self):
        run = self.copy()
        with open(os.path.join(run, "janus.mcap"), "r+b") as file:
            file.truncate(os.path.getsize(file.name) * 2 // 3)
        done = armature("report", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: the recording has no end", done.stderr)
        report = load(os.path.join(self.folder, "report.json"))
        self.assertTrue(report["runs"]["run"]["cut_off"])
        samples = report["controllers"]["run"]["joints"][0]["samples"]
        self.assertGreater(samples, 20)
        self.assertLess(samples, 290)

    def test_a_black_box_is_no_recording_of_the_run_unless_it_is_all_there_is(self):
        run = self.copy()
        box = os.path.join(run, "blackbox-Joint1.mcap")
        shutil.copy(os.path.join(run, "janus.mcap"), box)
        done = armature("report", self.folder)
        self.assertEqual((done.returncode, done.stderr.count("warning")), (0, 0), done.stderr)
        self.assertIn("janus.mcap", load(os.path.join(self.folder, "report.json"))["runs"]["run"]["recording"])
        os.remove(os.path.join(run, "janus.mcap"))
        self.assertEqual(armature("report", self.folder).returncode, 0)
        self.assertEqual(load(os.path.join(self.folder, "report.json"))["runs"]["run"]["recording"], box)

    def test_a_recording_without_positions_says_what_was_looked_for_and_shows_the_rest(self):
        self.run_short(os.path.join(self.folder, "run"), "--set", "Reporter.what=[PID1.Out]")
        done = armature("report", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no positions to show; looked for of each joint", done.stderr)
        self.assertIn("PID1.Ref and PID1.Sen", done.stderr)
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            self.assertIn('"name":"PID1.Out"', file.read())
        self.assertEqual(load(os.path.join(self.folder, "report.json"))["controllers"], {})

    def test_the_vectors_of_all_joints_do_as_well(self):
        self.run_short(os.path.join(self.folder, "run"), "--set",
                       "Reporter.what=[Sensor.sensor, BridgeRef.reference]")
        done = armature("report", self.folder)
        self.assertEqual((done.returncode, "warning" in done.stderr), (0, False), done.stderr)
        joints = load(os.path.join(self.folder, "report.json"))["controllers"]["run"]["joints"]
        self.assertEqual([joint["measured"] for joint in joints],
                         ["Sensor.sensor[0]", "Sensor.sensor[1]"])
        self.assertIsNone(joints[0]["final_error_counts"], "nothing says what a count is")

    def test_a_run_folder_itself_is_reported(self):
        run = self.copy("alone")
        self.assertEqual(armature("report", run).returncode, 0)
        self.assertEqual(list(load(os.path.join(run, "report.json"))["controllers"]), ["alone"])

    def test_a_fault_is_in_the_summary_with_its_reason(self):
        run = os.path.join(self.folder, "run")
        done = armature("run", f"{JANUS}/deployments/pid.yaml", "-L", LIBRARIES, "--sim", "--for",
                        "2s", "--out", run, "--set", "AIC2.JointNumber=3")
        summary = load(os.path.join(run, "run.json"))
        self.assertEqual(summary["exit_code"], done.returncode)
        self.assertNotEqual(done.returncode, 0)
        self.assertTrue(summary["faults"] + summary["reactions"] + len(summary["casualties"]))
        self.assertTrue(summary["complaints"])
        self.assertEqual(armature("report", self.folder).returncode, 0)

    def test_a_run_that_does_not_begin_leaves_no_summary_of_the_one_before(self):
        run = self.copy()
        self.assertTrue(os.path.exists(os.path.join(run, "run.json")))
        done = armature("run", f"{JANUS}/demo/pid.yaml", "-L", LIBRARIES, "--sim", "--for", "1s",
                        "--out", run, "--set", "Reporter.csv=/nowhere/a.csv")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(run, "run.json")))

    def test_names_in_a_folder_cannot_break_the_page(self):
        name = "</script><b>&\"'"
        self.copy(name.replace("/", "\u2044"))
        self.assertEqual(armature("report", self.folder).returncode, 0)
        page = Page()
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            page.feed(file.read())
        self.assertEqual(page.open, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
