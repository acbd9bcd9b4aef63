# SPDX-License-Identifier: Apache-2.0
"""The package works from where it is installed, with the component libraries of that place."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

BUILD = Path(os.environ["ARMATURE_BUILD"])


@pytest.fixture
def prefix(tmp_path):
    prefix = tmp_path / "prefix"
    subprocess.run([os.environ["ARMATURE_CMAKE"], "--install", BUILD, "--prefix", prefix, "--component", "python"],
                   check=True, stdout=subprocess.DEVNULL)
    # The rest of an installation, which takes a build of everything.
    libraries = prefix / os.environ["ARMATURE_LIBDIR"]
    libraries.mkdir(parents=True, exist_ok=True)
    for library in (BUILD / "lib").glob("libarmature_*.so*"):
        (libraries / library.name).symlink_to(library)
    (prefix / "lib/armature").symlink_to(BUILD / "lib/armature")
    return prefix


def test_it_finds_its_runtime_and_its_component_libraries(prefix, janus_file):
    package = prefix / "lib/python3/dist-packages"
    program = f"""
import armature
from armature import _native
assert _native.__file__.startswith({str(package)!r}), _native.__file__
with armature.load({str(janus_file)!r}).application() as app:
    app.run_for(0.1)
    print(app.Sampler.state)
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                         env={"PYTHONPATH": str(package), "PATH": "/usr/bin:/bin"})
    assert (run.stdout, run.stderr) == ("Running\n", "")


def test_the_module_looks_for_the_runtime_beside_itself_only(prefix):
    module = next((prefix / "lib/python3/dist-packages/armature").glob("_native.*.so"))
    told = subprocess.run(["readelf", "-d", module], capture_output=True, text=True, check=True).stdout
    paths = [line for line in told.splitlines() if "RUNPATH" in line or "RPATH" in line]
    assert len(paths) == 1 and "$ORIGIN/../../../../" in paths[0] and str(BUILD) not in paths[0]


def test_it_has_all_modules_types_and_stubs(prefix):
    source = Path(__file__).parents[1] / "armature"
    package = prefix / "lib/python3/dist-packages/armature"

    def files_in(folder):
        return {str(file.relative_to(folder)) for file in folder.rglob("*")
                if file.is_file() and "__pycache__" not in file.parts}

    assert files_in(package) == files_in(source) | {next(package.glob("_native.*.so")).name}
