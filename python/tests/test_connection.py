# SPDX-License-Identifier: Apache-2.0
"""An application of another process has the same components, as its policy allows it."""
import os
import signal
import subprocess
import time

import numpy as np
import pytest

import armature


@pytest.fixture(scope="module")
def address(tmp_path_factory, janus_file):
    folder = tmp_path_factory.mktemp("served")
    socket = f"unix:{folder}/janus.sock"
    run = subprocess.Popen([os.environ["ARMATURE_PROGRAM"], "run", "--sim", "--pace", "1",
                            str(janus_file.with_name("served.yaml")), "--set", f"address={socket}"],
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = []
    for line in run.stdout:
        said.append(line)
        if "listens at" in line:
            break
    else:
        pytest.fail("".join(said))
    yield socket
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=60)


def test_it_is_seen_and_commanded(address):
    with armature.connect(address, limit=30) as app:
        assert isinstance(app, armature.Connection)
        assert app.connected and app.address == address and app.name == "janus" and app.simulated
        while app.now < 0.1:  # the cards answer
            time.sleep(0.01)
        before = app.now
        app.Arming.arm()
        assert app.now > before
        app.Generator.moveTo([0.2, 0.1], 0.5)
        np.testing.assert_allclose(app.Sensor.sensor.value[:2], [0.2, 0.1], atol=0.02)
        assert app.Joint1.Position.value == pytest.approx(0.2, abs=0.02) and app.Joint1.Position.age >= 0.0
        assert app.PID1.Kp == 400.0 and app.PID1.properties["Kp"].unit == "V/rad"
        assert app.Joint1.VoltageActuator.value.value == pytest.approx(0.0, abs=5.0)
        assert app.Cards.mode == "synchronous" and app.Joint1.Armed.value is True
        assert any(line.text == "armed" for line in app.log)
        assert app.faults == {} and "PID1" in dir(app) and "connected" in repr(app)
        command = app.Generator.moveTo.begin([1.0, 1.0], 30.0)
        assert not command.done and command.progress < 1.0
        command.cancel()
        with pytest.raises(armature.CommandError, match="cancelled"):
            command.wait(60.0)


def test_what_its_policy_does_not_allow_is_refused(address):
    with armature.connect(address, limit=30) as app:
        with pytest.raises(armature.NoAnswer, match="may not"):
            app.PID1.Kp = 300
        with pytest.raises(armature.NoAnswer, match="own process"):
            next(iter(app.Arming.events.values())).raised


def test_after_it_was_closed_nothing_answers(address):
    app = armature.connect(address, limit=30)
    app.close()
    assert not app.connected
    with pytest.raises(armature.NoAnswer, match="was closed"):
        app.now


def test_an_address_that_is_none_or_where_nobody_is_is_told(tmp_path):
    with pytest.raises(ValueError, match="not an address"):
        armature.connect("robot")
    with pytest.raises(ValueError, match="needs certificate, key and authority"):
        armature.connect("tls://robot:4243")
    with pytest.raises(armature.NoAnswer):
        armature.connect(f"unix:{tmp_path}/nobody.sock", limit=0.05)
