# SPDX-License-Identifier: Apache-2.0
"""The page as a browser shows it."""
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from armature.sweeps import Effort, Results, Run, each, grid
from armature.sweeps.page import page_text

HERE = Path(__file__).parent
WEB = HERE.parent.parent / "web"


def some_runs():
    """A grid of 4 x 3; the cost is least at Kp = 400, Kd = 100, and Kp = 3200 is refused."""
    runs = []
    for number, point in enumerate(grid({"PID1.Kp": [100, 400, 1600, 3200], "Kd": [50, 100, 200]})):
        kp, kd = point["PID1.Kp"], point["Kd"]
        if kp == 3200:
            reason = f"PID1 </script> shakes Joint1: gain margin 1.{number}"
            runs.append(Run(number, point, "refused", {}, reason, 0.01, "host:1"))
            continue
        cost = abs(kp - 400) / 1000 + abs(kd - 100) / 100
        runs.append(Run(number, point, "done", {"cost": cost, "largest": kp / 4}, "", 1.5, "h:1"))
    return runs


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    recorded = folder / "runs/000004"
    recorded.mkdir(parents=True)
    (recorded / "report.html").touch()
    effort = Effort(wall_s=7.0, workers=2, own_s=13.5, runs=12)
    results = Results(some_runs(), effort=effort, folder=folder, title="janus & pid.yaml")
    results.page(folder / "sweep.html")
    return look_at(folder / "sweep.html")


def look_at(page):
    node = shutil.which("node")
    if node is None:
        pytest.skip("there is no node")
    looked = subprocess.run(
        [node, HERE / "sweep_page.mjs", WEB, page], capture_output=True, text=True, timeout=120
    )
    if looked.returncode == 77:
        pytest.skip("there is no browser, or no web/node_modules")
    assert looked.returncode == 0, looked.stderr
    return json.loads(looked.stdout)


def test_it_says_how_many_runs_ended_how(found):
    assert found["title"] == "janus & pid.yaml"
    assert found["lead"] == "12 runs: 9 done, 3 refused."


def test_the_best_run_is_first(found):
    assert found["best"][0] == ["4", "400", "100", "0", "100", "report"]
    assert [float(row[3]) for row in found["best"]] == sorted(float(row[3]) for row in found["best"])
    assert len(found["best"]) == 9


def test_the_heat_map_has_a_cell_for_each_pair_with_the_brightest_for_the_best(found):
    cells = {number: (text, colour) for number, text, colour in found["cells"]}
    assert sorted(cells) == list(range(12))
    assert cells[4] == ("cost 0, run 4", "rgb(253,231,37)")
    assert cells[8] == ("cost 2.2, run 8", "rgb(68,1,84)")
    assert cells[9] == ("refused: PID1 </script> shakes Joint1: gain margin 1.9", None)


def test_another_metric_colours_it(found):
    assert "largest 100, run 4" in found["cellsOfOther"]
    assert "cost 0, run 4" not in found["cellsOfOther"]


def test_parallel_coordinates_have_an_axis_for_each_name_and_a_line_for_each_result(found):
    assert found["axes"] == ["PID1.Kp", "Kd", "cost", "largest"]
    assert found["lines"] == 9
    assert found["kept"].startswith("6 of 9 runs are within the marked ranges.")


def test_a_run_leads_to_what_it_left(found):
    assert re.search(r"Run 4\b.*PID1\.Kp\s+400.*largest\s+100", found["chosen"], re.DOTALL)
    assert found["links"] == [
        ["recording", "runs/000004/"], ["report", "runs/000004/report.html"]]  # fmt: skip
    assert found["marked"] == [4]


def test_reasons_that_differ_in_figures_are_one_and_lead_to_their_runs(found):
    assert found["reasons"] == ["refused: PID1 </script> shakes Joint1: gain margin 1.9"]
    assert "gain margin 1.9" in found["chosenWithout"] and "Run 9" in found["chosenWithout"]


def test_all_runs_are_listed(found):
    assert found["all"] == 12


def test_it_has_no_errors_and_loads_nothing_from_elsewhere(found):
    assert found["errors"] == []
    assert found["elsewhere"] == []


def test_no_text_of_a_run_ends_its_data(tmp_path):
    text = page_text(Results(some_runs()), tmp_path)
    data = re.search(r'<script type="application/json" id="data">(.*?)</script>', text).group(1)
    assert json.loads(data)["runs"][9]["reason"] == "PID1 </script> shakes Joint1: gain margin 1.9"


def test_braces_in_a_run_are_no_place_for_a_part_of_the_page(tmp_path):
    runs = [Run(0, {"x": "{{elements}} {{title}} {{other}}"}, "done", {"cost": 1.0}, "")]
    text = page_text(Results(runs, title="{{data}}"), tmp_path)
    data = re.search(r'<script type="application/json" id="data">(.*?)</script>', text).group(1)
    assert json.loads(data)["runs"][0]["parameters"] == ["{{elements}} {{title}} {{other}}"]
    assert "<title>{{data}}" in text


def test_an_axis_has_room_for_many_runs(tmp_path):
    node = shutil.which("node")
    if node is None:
        pytest.skip("there is no node")
    elements = HERE.parent / "armature/sweeps/page/elements.js"
    script = f"""
const {{readFileSync}} = require('fs');
const Elements = new Function(readFileSync({json.dumps(str(elements))}, 'utf8') + '; return Elements;')();
const axis = Elements.numericAxis(Array.from({{length: 500000}}, (_, i) => i - 3));
console.log(axis.least, axis.most);"""
    ran = subprocess.run([node, "-e", script], capture_output=True, text=True)
    assert (ran.stdout, ran.stderr) == ("-3 499996\n", "")


def test_a_sweep_that_records_makes_a_folder_for_each_run_that_the_page_links(tmp_path):
    pytest.importorskip("cloudpickle")
    import sweep_runs

    points = [{"x": x, "y": 1.0} for x in (0.5, 1.0)]
    first = each(sweep_runs.rosenbrock, points, workers=1, out=tmp_path, progress=False)
    assert not (tmp_path / "runs").exists()
    again = each(
        sweep_runs.rosenbrock, [first.best.point], workers=1, out=tmp_path, record=True,
        progress=False,
    )  # fmt: skip
    assert again.best.metrics == first.best.metrics
    assert (tmp_path / "runs/000001/left.txt").read_text() == "1.0 1.0\n"
    text = (tmp_path / "sweep.html").read_text()
    data = json.loads(re.search(r'id="data">(.*?)</script>', text).group(1))
    assert [run.get("folder") for run in data["runs"]] == [None, "runs/000001/"]
    assert data["runs"][1]["metrics"][0] == 0.0
