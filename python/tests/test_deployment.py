# SPDX-License-Identifier: Apache-2.0
"""Deployments are checked and loaded; what is wrong with them is told with its place."""
import os
import shutil
import subprocess

import pytest

import armature

MISTAKEN = """application: mistaken
libraries: [controls]
components:
  Sum: {model: Adder, activity: {periodic: 10 ms}, properties: {inputs: 0}}
  Lost: {model: Addr}
"""


@pytest.fixture
def mistaken(tmp_path):
    file = tmp_path / "mistaken.yaml"
    file.write_text(MISTAKEN)
    return file


def test_check_finds_nothing_in_a_good_deployment(janus_file):
    assert [one for one in armature.check(janus_file) if one.severity != "note"] == []


def test_check_tells_each_mistake_with_its_place_and_a_hint(mistaken):
    found = {one.line: one for one in armature.check(mistaken)}
    unknown = found[5]
    assert isinstance(unknown, armature.Diagnostic)
    assert (unknown.severity, unknown.file, unknown.column > 0) == ("error", str(mistaken), True)
    assert "Addr" in unknown.message and "Adder" in str(unknown)
    assert unknown.name == "" and "Adder" in unknown.hint + unknown.message
    assert repr(unknown) == f"<Diagnostic {unknown}>"


def test_it_finds_what_the_program_finds(mistaken):
    told = subprocess.run([os.environ["ARMATURE_PROGRAM"], "check", mistaken], capture_output=True, text=True)
    lines = [line for line in (told.stdout + told.stderr).splitlines() if line.startswith(str(mistaken))]
    assert lines == [str(one) for one in armature.check(mistaken)]


def test_load_raises_all_mistakes_at_once(mistaken):
    with pytest.raises(armature.DeploymentError) as raised:
        armature.load(mistaken)
    assert isinstance(raised.value, armature.Error)
    assert len(raised.value.diagnostics) >= 1
    assert f"{mistaken}:5:" in str(raised.value)


def test_a_file_that_is_not_there_is_a_mistake(tmp_path):
    with pytest.raises(armature.DeploymentError, match="nowhere.yaml"):
        armature.load(tmp_path / "nowhere.yaml")


def test_what_is_set_counts_in_place_of_the_file(janus_file):
    deployment = armature.load(janus_file, set={"PID1.Kp": 200, "PID2.UMax": "9000 mV", "period": "5 ms"})
    with deployment.application() as app:
        assert (app.PID1.Kp, app.PID2.UMax) == (200.0, 9.0)
        app.run_for(0.1)
        assert app.Sampler.state == "Running"


def test_what_is_set_wrongly_is_a_mistake_with_a_suggestion(janus_file):
    with pytest.raises(armature.DeploymentError, match="did you mean 'Kp'"):
        armature.load(janus_file, set={"PID1.Kpp": 200})
    with pytest.raises(ValueError, match="a number, a text, a list or a mapping"):
        armature.load(janus_file, set={"PID1.Kp": object()})


def test_component_libraries_are_looked_for_in_further_folders(tmp_path):
    program = tmp_path / "mine.yaml"
    program.write_text("application: mine\nlibraries: [my_controls]\n"
                       "components: {Sum: {model: Adder, activity: {periodic: 10 ms}}}\n")
    folder = tmp_path / "libraries"
    folder.mkdir()
    with pytest.raises(armature.DeploymentError, match="my_controls"):
        armature.load(program)
    from armature._deployment import _COMPONENTS
    shutil.copy(f"{_COMPONENTS}/libcontrols.so", folder / "libmy_controls.so")
    assert "my_controls" not in " ".join(str(one) for one in armature.check(program, libraries=[folder]))


def test_a_deployment_makes_any_number_of_applications(janus_file):
    deployment = armature.load(janus_file)
    assert (deployment.file, deployment.name) == (str(janus_file), "janus-pid")
    assert repr(deployment) == f"<Deployment 'janus-pid' of {janus_file}>"
    with deployment.application() as first, deployment.application() as second:
        first.run_for(1)
        second.run_for(0.5)
        assert (first.now, second.now) == (1.0, 0.5)


def test_what_does_not_pass_the_check_does_not_run(tmp_path, janus_file, mistaken):
    with pytest.raises(armature.DeploymentError):
        armature.Deployment(mistaken).application()
    file = tmp_path / "changing.yaml"
    text = f"include: {janus_file}\napplication: changing\n"
    file.write_text(text)
    deployment = armature.load(file)
    deployment.application().stop()
    file.write_text(text + "components: {PID1: {override: true, properties: {Kpp: 1}}}\n")
    with pytest.raises(armature.DeploymentError, match="Kpp"):
        deployment.application()


def test_acts_of_the_operator_need_a_grant(tmp_path, janus_file):
    file = tmp_path / "strict.yaml"
    file.write_text(f"include: {janus_file}\napplication: strict\ngrants: {{script: []}}\n")
    deployment = armature.load(file)
    with deployment.application() as app:
        app.run_for(0.1)
        with pytest.raises(armature.Refusal, match="act of the operator"):
            app.Arming.arm()
    with deployment.application(grants=["Arming.arm"]) as app:
        app.run_for(0.1)
        app.Arming.arm()
        assert app.Joint1.Armed.value is True
    with pytest.raises(ValueError, match="Component.operation"):
        deployment.application(grants=["arm"])
