# SPDX-License-Identifier: Apache-2.0
"""Runs for tests of sweeps, which need no robot. Workers import them by name."""
from __future__ import annotations

import math
import os
import random
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from armature.sweeps.run import Refusal


def rosenbrock(point, folder):
    """Smooth, with its least value 0 at (1, 1); its last digits depend on how it is computed."""
    x, y = point["x"], point["y"]
    if folder is not None:
        Path(folder, "left.txt").write_text(f"{x} {y}\n")
    return {"cost": (1 - x) ** 2 + 100 * (y - x * x) ** 2, "angle": math.atan2(y, x)}


def draws(point, folder):
    """What a run draws depends neither on the runs before it nor on what they have left."""
    return {"drawn": random.random() + 0 * point["x"]}


def picky(point, folder):
    """Not every point can be run, and not every run ends well."""
    if point["x"] < 0:
        raise Refusal(f"x must be 0 or more, found {point['x']}")
    if point["x"] > 10:
        raise RuntimeError("Joint1: too far from its reference")
    if point["x"] == 5:
        return {"cost": "much"}
    return {"cost": point["x"]}


def deadly_once(point, folder):
    """The first worker that has this point dies in the middle of it, as by kill -9."""
    mark = Path(point["marks"], f"begun-{point['x']}")
    if point["x"] == 3 and not mark.exists():
        mark.write_text(str(os.getpid()))
        os.kill(os.getpid(), signal.SIGKILL)
    return {"cost": math.sqrt(point["x"])}


def deadly(point, folder):
    if point["x"] == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"cost": point["x"]}


def slow(point, folder):
    """Says that it has begun, and takes its time: others can end its worker meanwhile."""
    Path(point["marks"], f"{point['x']}-{os.getpid()}").touch()
    time.sleep(point.get("takes", 0.1))
    return {"cost": math.exp(-point["x"])}


def with_child(point, folder):
    """Starts another process, and waits for it."""
    child = subprocess.Popen(["sleep", "600"])
    Path(point["marks"], str(child.pid)).touch()
    child.wait()
    return {"cost": 0.0}


def leaves_and_dies(point, folder):
    """A run that is killed while it has files of its own."""
    left = tempfile.mkdtemp()
    Path(point["marks"], "where").write_text(left)
    os.kill(os.getpid(), signal.SIGKILL)


def slow_with_folder(point, folder):
    """Writes its result in two steps, if it is recorded."""
    if folder is None:
        return {"cost": point["x"]}
    Path(folder, "left.txt").write_text("half")
    Path(point["marks"], "begun").touch()
    time.sleep(600 if point["x"] == 1 and not Path(point["marks"], "again").exists() else 0)
    Path(folder, "left.txt").write_text("whole")
    return {"cost": point["x"]}


def names_metric(point, folder):
    return {point["metric"]: 1.0}
