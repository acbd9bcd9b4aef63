# SPDX-License-Identifier: Apache-2.0
"""Every public call has a type, which mypy checks, and a test."""
import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import armature
import armature.author
import armature.sweeps

TESTS = Path(__file__).parent
PACKAGE = Path(armature.__file__).resolve().parent


MODULES = (armature, armature.author, armature.sweeps)


def public():
    """`Application.run_for`, ... of what the modules say that they export, and what it is."""
    for module in MODULES:
        names = getattr(module, "__all__", None) or [
            name for name, one in vars(module).items()
            if inspect.isclass(one) and one.__module__ == module.__name__ and not name.startswith("_")]
        for name in names:
            one = getattr(module, name)
            yield name, one
            if inspect.isclass(one):
                for member, value in vars(one).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                        yield f"{name}.{member}", value


def names_in(file):
    """What the code of a file of tests uses: names and attributes, also of programs in its texts; no comments, no documentation."""
    tree = ast.parse(file.read_text())
    documentation = {id(node.body[0].value) for node in ast.walk(tree)
                     if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("test_"):
            yield node.name  # a hook of a component
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documentation:
            yield from re.findall(r"(?<=\.)\w+(?=\W)", node.value)


def test_every_public_call_is_in_a_test():
    used = {name for file in TESTS.glob("test_*.py") if file != Path(__file__).resolve() for name in names_in(file)}
    assert [name for name, _ in public() if name.split(".")[-1] not in used] == []


def test_every_public_call_says_what_it_does():
    silent = [name for name, one in public() if not inspect.getdoc(one) and not isinstance(one, str)]
    assert silent == []


def test_the_package_is_typed_and_mypy_strict_finds_nothing(tmp_path):
    pytest.importorskip("mypy")
    assert (PACKAGE / "py.typed").exists()
    user = tmp_path / "user.py"
    user.write_text('''import armature
from armature import sweeps
from armature.author import Component, Input, Output, Property


class Double(Component):
    """As users write it."""

    gain = Property(2.0, unit="", doc="how much")
    a = Input(float, doc="in")
    out = Output(float, doc="out")

    def update(self) -> None:
        if self.a is not None:
            self.out = self.gain * self.a


def run(file: str) -> float:
    with armature.load(file, set={"PID1.Kp": 200}, components=[Double]).application(record="out") as app:
        end: armature.RunEnd = app.run_for("60 s")
        assert end is armature.RunEnd.TIME_UP
        app.PID1.Kp = 200
        app["PID1"].operations["reset"]()
    samples = armature.read_recording("out")["PID1.Out"]
    return float(samples.times[-1])


def measure(app: armature.Application) -> dict[str, float]:
    following = sweeps.Following(app, [("PID1.Ref", "PID1.Sen")], period=0.01)
    following.run_until(1.0)
    return {"iae": following.joints[0].iae, "seconds": following.seconds}


def search(file: str) -> list[sweeps.Run]:
    with sweeps.Pool(2) as pool:
        results: sweeps.Results = armature.sweep(file, {"PID1.Kp": [100, 200]}, measure, workers=pool, out="sweep")
    for points in (sweeps.grid({"x": [1, 2]}), sweeps.random({"x": (0, 1)}, 9, seed=1), sweeps.sobol({"x": (0, 1)}, 8, seed=1)):
        sweeps.each(lambda point, folder: {"y": float(point["x"])}, points)
    overhead: float = results.effort.overhead
    best: dict[str, float] = results.best.metrics
    return [run for run in results.ranked() if run.outcome == sweeps.DONE or overhead or best]


reveal_type(Double().gain)
''')
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file", str(TESTS.parent / "mypy.ini"),
                              "--cache-dir", str(tmp_path / "cache"), str(PACKAGE), str(user)],
                             env={"MYPYPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin"}, capture_output=True,
                             text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert 'Revealed type is "builtins.float"' in checked.stdout


def test_the_stubs_of_the_native_module_are_complete():
    """What it has and what `_native.pyi` says of it are the same names."""
    from armature import _native
    stubs = (PACKAGE / "_native.pyi").read_text()
    classes = dict(re.findall(r"^class (\w+).*?:(.*?)(?=^class |^def |\Z)", stubs, re.MULTILINE | re.DOTALL))
    functions = set(re.findall(r"^def (\w+)", stubs, re.MULTILINE))
    there = {name for name in vars(_native) if not name.startswith("_")}
    assert there == set(classes) | functions
    for name, body in classes.items():
        said = set(re.findall(r"def (\w+)", body)) - {"__init__"}
        has = {member for member in vars(getattr(_native, name)) if not member.startswith("_")}
        assert has == said, name
