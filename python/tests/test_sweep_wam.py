# SPDX-License-Identifier: Apache-2.0
"""The WAM's campaign of configurations as a sweep: python/examples/wam_configurations.py."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("cloudpickle")
EXAMPLE = Path(__file__).resolve().parents[1] / "examples/wam_configurations.py"
CAMPAIGN = Path(os.environ["ARMATURE_BUILD"]) / "tests/configurations_campaign"


def campaign(program, mutants, out):
    return subprocess.run(
        [sys.executable, EXAMPLE, "--program", program, "--mutants", str(mutants), "--out", out, "--workers", "2"],
        capture_output=True,
        text=True,
    )


def counted(printed):
    """{robot: {outcome: how many}} of the table that it prints."""
    columns, *rows = [line.split() for line in printed.splitlines()[:3]]
    return {robot: dict(zip(columns, map(int, counts))) for robot, *counts in rows}


@pytest.mark.skipif(not CAMPAIGN.exists(), reason="configurations_campaign is not built")
def test_a_few_mutants_are_refused_or_safe(tmp_path):
    done = campaign(CAMPAIGN, 3, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    counts = counted(done.stdout)
    assert {robot: sum(found.values()) for robot, found in counts.items()} == {"wam4": 3, "wam7": 3}
    assert counts["wam4"]["unsafe"] == counts["wam7"]["unsafe"] == 0
    assert (tmp_path / "sweep.html").exists()


def test_one_that_is_not_safe_and_one_of_which_nothing_is_said_are_named(tmp_path):
    """The program is a double: of arm wam4 it says that seed 1 is not safe, and of seed 2 nothing."""
    program = tmp_path / "campaign"
    program.write_text("""#!/bin/sh
case "$CONFIGURATION $1" in
  "1 "*Four*) echo "wam4 1, pd4.yaml, Arm.Kp: 1 -> 2: UNSAFE, 3 rad too far" ;;
  "2 "*Four*) exit 1 ;;
  *Four*) echo "wam4 $CONFIGURATION, pd4.yaml, Arm.Kp: 1 -> 2: quiet, " ;;
  *) echo "wam7 $CONFIGURATION, pd7.yaml, Arm.Kp: 1 -> 2: refused, too large" ;;
esac
""")
    program.chmod(0o755)
    done = campaign(program, 3, tmp_path / "out")
    assert done.returncode == 1
    counts = counted(done.stdout)
    assert (counts["wam4"]["quiet"], counts["wam4"]["unsafe"], counts["wam7"]["refused"]) == (1, 1, 3)
    assert "wam4, seed 1: UNSAFE" in done.stdout
    assert "wam4, seed 2: " in done.stdout and "says nothing of this mutant" in done.stdout
