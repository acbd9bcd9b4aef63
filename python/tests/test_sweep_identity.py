# SPDX-License-Identifier: Apache-2.0
"""What tells one experiment from another: files, libraries, functions and what is around them."""
import functools
import os
import subprocess
import sys

import pytest

from armature.sweeps.identity import digest_of, files_named_by, source_of

SCALE = 1.0


def measure(app, factor=2.0):
    return {"cost": SCALE * factor * helper(app)}


def helper(app):
    return len(app)


def test_a_function_is_itself_with_all_that_is_plain_around_it(monkeypatch):
    assert source_of(measure) == source_of(measure)
    for name, other in {"SCALE": 2.0, "helper": lambda app: 0}.items():
        before = source_of(measure)
        with monkeypatch.context() as patch:
            patch.setitem(globals(), name, other)
            if callable(other):
                other.__module__ = __name__
            assert source_of(measure) != before
        assert source_of(measure) == before


def test_closures_defaults_partials_and_objects_are_told_apart_by_their_values():
    def of_closure(scale):
        return lambda app: {"cost": scale}

    def of_default(scale):
        def run(app, factor=scale):
            return {"cost": factor}
        return run

    class Callable:
        def __init__(self, scale):
            self.scale = scale

        def __call__(self, app):
            return {"cost": self.scale}

    def of_partial(scale):
        return functools.partial(measure, factor=scale)

    for make in (of_closure, of_default, Callable, of_partial):
        assert source_of(make(1.0)) == source_of(make(1.0))
        assert source_of(make(1.0)) != source_of(make(2.0))
        assert source_of(make({"a", "b"})) == source_of(make({"b", "a"}))


def test_a_function_that_refers_to_itself_has_an_identity():
    def run(app):
        return run(app)

    assert source_of(run) == source_of(run)


def test_a_class_without_a_file_is_told_apart_by_its_methods():
    def made(text):
        there = {"__name__": "nowhere"}
        exec(text, there)
        return there["A"]

    assert source_of(made("class A:\n def f(self): return 1")) != source_of(made("class A:\n def f(self): return 2"))


SCRIPT = """
from armature.sweeps import each
scale = SCALE
def run(point, folder):
    return {"cost": scale * point["x"] + CONSTANT + (point["x"] in {"a", "b"})}
results = each(run, [{"x": 1}], workers=1, out=OUT, progress=False)
print(results[0].metrics["cost"])
"""


def test_a_script_without_a_file_is_refused_where_its_function_has_changed(tmp_path):
    pytest.importorskip("cloudpickle")

    def run(scale, constant):
        text = SCRIPT.replace("SCALE", scale).replace("CONSTANT", constant).replace("OUT", repr(str(tmp_path)))
        return subprocess.run([sys.executable, "-"], input=text, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))})

    assert run("1", "0").stdout == "1.0\n"
    assert run("1", "0").stdout == "1.0\n"
    for changed in (("2", "0"), ("1", "5")):
        assert "another experiment: run changed since" in run(*changed).stderr


def test_the_digest_covers_included_files_and_component_libraries(tmp_path):
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf/x.urdf").write_text("<robot/>")
    (tmp_path / "base.yaml").write_text('libraries: [mine, "./near.so"]\nfile: "${here}/urdf/x.urdf"\n')
    (tmp_path / "a.yaml").write_text("include: [base.yaml]\n")
    for name in ("libmine.so", "libother.so", "near.so"):
        (tmp_path / name).write_bytes(b"1")
    digests = [digest_of(tmp_path / "a.yaml", [str(tmp_path)])]
    changes = {"urdf/x.urdf": "<robot />", "libmine.so": "2", "near.so": "2", "libother.so": "2"}
    for file, text in changes.items():
        (tmp_path / file).write_text(text)
        digests.append(digest_of(tmp_path / "a.yaml", [str(tmp_path)]))
    assert len(set(digests[:4])) == 4 and digests[3] == digests[4]


def test_libraries_of_all_folders_that_a_load_searches_count(tmp_path, monkeypatch):
    from armature.sweeps.experiment import Simulated

    for folder in ("here", "path", "first"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "libmine.so").write_bytes(b"1")
    (tmp_path / "here/a.yaml").write_text("libraries: [mine]\n")
    monkeypatch.setenv("ARMATURE_LIBRARY_PATH", str(tmp_path / "path"))
    simulated = Simulated(str(tmp_path / "here/a.yaml"), measure, {}, (str(tmp_path / "first"),))
    found = {simulated.describe()["files of the deployment"]}
    for folder in ("here", "path", "first"):
        (tmp_path / folder / "libmine.so").write_bytes(b"2")
        found.add(simulated.describe()["files of the deployment"])
    assert len(found) == 4


def test_files_that_points_name_count(tmp_path):
    (tmp_path / "heavy.urdf").write_text("<robot/>")
    points = [{"x": 1, "description": "heavy.urdf"}, {"description": f"[{tmp_path}/heavy.urdf, none.urdf]"}]
    found = files_named_by(points, [tmp_path])
    assert list(found) == [f"file {tmp_path}/heavy.urdf"]
    (tmp_path / "heavy.urdf").write_text("<robot />")
    assert files_named_by(points, [tmp_path]) != found
