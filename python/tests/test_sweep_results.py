# SPDX-License-Identifier: Apache-2.0
import csv
import io
import json
import math
import struct

import numpy
import pytest

from armature.sweeps import DONE, FAILED, LOST, REFUSED, Effort, JournalError, Results, Run
from armature.sweeps.journal import Journal
from armature.sweeps.progress import Progress
from armature.sweeps.results import text_of


def run(number, outcome="done", reason="", cost=None, **point):
    metrics = {} if cost is None else {"cost": cost, "other": -cost}
    return Run(number, point, outcome, metrics, reason, 0.5, "host:1")


def some_results(**options):
    return Results(
        [
            run(0, cost=0.1 + 0.2, Kp=400.0, mode="synchronous"),
            run(1, "refused", "PID1.Kp: gains shake the joint", Kp=4e9, mode="sequential"),
            run(2, cost=0.25, Kp=1 / 3, mode="sequential"),
        ],
        **options,
    )


def test_the_best_run_has_the_smallest_objective():
    assert some_results().objective == "cost"
    assert some_results().best.number == 2
    assert some_results(objective="other").best.number == 0
    assert [each.number for each in some_results().ranked()] == [2, 0]


def test_a_metric_that_is_no_number_is_best_of_nothing():
    results = Results([run(0, cost=math.nan, Kp=1), run(1, cost=5.0, Kp=2)])
    assert results.best.number == 1


def test_without_any_result_the_reason_is_told():
    results = Results([run(0, "refused", "unknown component 'PID3'", Kp=1)])
    with pytest.raises(LookupError, match="no run of 1 is done: run 0, unknown component 'PID3'"):
        results.best


def test_an_objective_that_no_run_has_is_told_with_those_there_are():
    with pytest.raises(LookupError, match="no run has the metric 'cots': there are cost, other"):
        some_results(objective="cots").best


def test_csv_has_all_digits_and_reasons(tmp_path):
    some_results().to_csv(tmp_path / "runs.csv")
    rows = list(csv.DictReader((tmp_path / "runs.csv").open()))
    assert list(rows[0]) == [
        "run", "Kp", "mode", "cost", "other", "outcome", "reason", "seconds", "worker"]  # fmt: skip
    assert struct.pack("<d", float(rows[0]["cost"])) == struct.pack("<d", 0.1 + 0.2)
    assert float(rows[2]["Kp"]) == 1 / 3
    assert rows[1]["cost"] == "" and rows[1]["reason"] == "PID1.Kp: gains shake the joint"


def test_the_array_has_a_row_for_each_run():
    array = some_results().array()
    assert array.dtype.names == ("number", "outcome", "Kp", "mode", "cost", "other")
    assert array["Kp"].dtype == numpy.float64
    assert array["mode"].tolist() == ["synchronous", "sequential", "sequential"]
    assert array["cost"][0] == 0.1 + 0.2 and math.isnan(array["cost"][1])
    assert array[array["outcome"] == "done"]["number"].tolist() == [0, 2]


def test_what_a_point_does_not_name_is_nan_or_empty_in_the_array():
    array = Results([run(0, cost=1.0, Kp=1.0), run(1, cost=2.0, mode="x")]).array()
    assert array["Kp"][0] == 1.0 and math.isnan(array["Kp"][1])
    assert array["mode"].tolist() == ["", "x"]


def test_the_table_names_the_best_first_and_counts_all():
    lines = some_results().table().splitlines()
    assert lines[1].split() == ["2", "0.333333", "sequential", "0.25", "-0.25"]
    assert lines[-1] == some_results().summary() == "3 runs: 2 done, 1 refused"


def test_outcomes_have_names():
    outcomes = [DONE, REFUSED, FAILED, LOST]
    assert outcomes == ["done", "refused", "failed", "lost"]
    assert [run(0, outcome).done for outcome in outcomes] == [True, False, False, False]


def test_overhead_is_what_workers_did_beside_runs():
    assert Effort(wall_s=10.5, workers=2, own_s=20.0, runs=4).overhead == pytest.approx(0.05)
    assert math.isnan(Effort().overhead)


def test_values_are_written_as_the_command_line_takes_them():
    assert text_of(True) == "true"
    assert text_of(0.1) == "0.1"
    assert text_of(numpy.float64(0.1)) == "0.1"
    assert text_of("20 ms") == "20 ms"
    assert text_of([1, 2.5]) == "[1, 2.5]"
    assert text_of(numpy.bool_(True)) == "true"
    assert text_of(numpy.array([1, 2])) == "[1, 2]"


EXPERIMENT = {"deployment": "pid.yaml", "metrics": "measure 1234"}


def test_a_folder_gives_runs_back_to_the_bit(tmp_path):
    with Journal(tmp_path, EXPERIMENT) as journal:
        for each in some_results():
            journal.add(each)
        journal.add(run(3, cost=math.inf, Kp=numpy.float64(2), mode="x"))
    with Journal(tmp_path, EXPERIMENT) as journal:
        assert journal.runs[:3] == list(some_results())
        assert journal.next_number == 4
        assert journal.find({"mode": "synchronous", "Kp": 400.0}).metrics["cost"] == 0.1 + 0.2
        assert journal.find({"Kp": 2.0, "mode": "x"}).metrics["cost"] == math.inf
        assert journal.find({"Kp": 401.0, "mode": "synchronous"}) is None


def test_a_run_that_was_lost_is_done_again_under_its_number(tmp_path):
    with Journal(tmp_path, EXPERIMENT) as journal:
        journal.add(run(7, "lost", "3 workers died with it", Kp=1))
        assert journal.find({"Kp": 1}) is None
        assert journal.number_of({"Kp": 1}) == 7


def test_what_a_crash_left_of_a_line_is_cut_off(tmp_path):
    with Journal(tmp_path, EXPERIMENT) as journal:
        journal.add(run(0, cost=1.0, Kp=1))
    with (tmp_path / "runs.jsonl").open("a") as file:
        file.write('{"number": 1, "poi')
    with Journal(tmp_path, EXPERIMENT) as journal:
        journal.add(run(1, cost=2.0, Kp=2))
    lines = (tmp_path / "runs.jsonl").read_text().splitlines()
    assert [json.loads(line)["number"] for line in lines] == [0, 1]


def test_a_folder_is_of_one_experiment_and_one_sweep_at_a_time(tmp_path):
    with Journal(tmp_path, EXPERIMENT):
        with pytest.raises(JournalError, match="is in use by another sweep"):
            Journal(tmp_path, EXPERIMENT)
    with pytest.raises(JournalError, match="another experiment: metrics changed since"):
        Journal(tmp_path, {**EXPERIMENT, "metrics": "measure 5678"})


def test_files_that_points_name_are_compared_where_both_name_them(tmp_path):
    for named in ({"file a": "1"}, {"file b": "2"}, {"file a": "1", "file b": "2"}):
        Journal(tmp_path, {**EXPERIMENT, **named}).close()
    with pytest.raises(JournalError, match="another experiment: file b changed since"):
        Journal(tmp_path, {**EXPERIMENT, "file b": "3"})


def test_progress_takes_no_metric_that_is_no_number_for_the_best():
    progress = Progress(3, None, io.StringIO())
    progress.add(run(0, cost=math.nan, Kp=1))
    assert "best" not in progress.text(1.0)
    progress.add(run(1, cost=2.0, Kp=2))
    assert progress.text(1.0).endswith("best cost 2")


def test_progress_tells_how_many_how_fast_and_the_best():
    stream = io.StringIO()
    progress = Progress(4, None, stream)
    for each in some_results():
        progress.add(each)
    assert progress.text(2.0) == "3/4 runs, 1.5 a second, 1 s left; 1 without result; best cost 0.25"
    progress.add(run(3, cost=0.125, Kp=3.0, mode="x"))
    assert stream.getvalue() == "4/4 runs; 1 without result; best cost 0.125\n"
