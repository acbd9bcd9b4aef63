# SPDX-License-Identifier: Apache-2.0
"""What the tests of the package share: deployments of this tree, which is where tests run."""
import signal
from pathlib import Path

import pytest

import armature

ROOT = Path(__file__).parents[2]
JANUS = ROOT / "robots/janus/deployments/pid.yaml"


@pytest.fixture(scope="session")
def janus_file() -> Path:
    return JANUS


@pytest.fixture
def janus():
    """The simulated head, at time 0."""
    with armature.load(JANUS).application() as app:
        yield app


@pytest.fixture
def armed_janus(janus):
    janus.run_for("100 ms")  # the cards answer
    janus.Arming.arm()
    return janus


@pytest.fixture
def ctrl_c():
    """SIGINT is an exception also where whoever started the tests has it ignored, as shells do."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
