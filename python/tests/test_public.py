# SPDX-License-Identifier: Apache-2.0
"""Every public call has a type, which mypy checks, and a test."""
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import armature
import armature.author

TESTS = Path(__file__).parent
PACKAGE = Path(armature.__file__).resolve().parent


def public_names():
    """`Application.run_for`, ... of what the package says that it exports."""
    for module in (armature, armature.author):
        names = getattr(module, "__all__", None) or [
            name for name, one in vars(module).items()
            if inspect.isclass(one) and one.__module__ == module.__name__ and not name.startswith("_")]
        for name in names:
            one = getattr(module, name)
            yield name
            if inspect.isclass(one):
                for member, value in vars(one).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                        yield f"{name}.{member}"


def test_every_public_call_is_in_a_test():
    tests = "\n".join(file.read_text() for file in TESTS.glob("test_*.py") if file != Path(__file__).resolve())
    words = set(re.findall(r"\w+", tests))
    assert [name for name in public_names() if name.split(".")[-1] not in words] == []


def test_every_public_call_says_what_it_does():
    for name in public_names():
        holder, _, member = name.partition(".")
        one = getattr(armature, holder, None) or getattr(armature.author, holder)
        if not member:
            assert one.__doc__, name


def test_the_package_is_typed_and_mypy_strict_finds_nothing(tmp_path):
    pytest.importorskip("mypy")
    assert (PACKAGE / "py.typed").exists()
    user = tmp_path / "user.py"
    user.write_text('''import armature
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


reveal_type(Double().gain)
''')
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"),
                              str(PACKAGE), str(user)], env={"MYPYPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin"},
                             capture_output=True, text=True)
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
