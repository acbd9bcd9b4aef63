# SPDX-License-Identifier: Apache-2.0
"""Many runs of a deployment: on this machine by a pool of processes, on many by Dask.

    import armature
    results = armature.sweep("pid.yaml", {"PID1.Kp": [200, 400, 800]}, measure, out="sweep")
    print(results.table())
"""
from . import points
from .following import Following
from .journal import JournalError
from .points import PointsError, grid, random, sobol
from .pool import Pool, PoolError
from .results import Effort, Results
from .run import DONE, FAILED, LOST, REFUSED, Refusal, Run
from .sweep import Interrupted, each, sweep

__all__ = [
    "DONE", "FAILED", "LOST", "REFUSED",
    "Effort", "Following", "Interrupted", "JournalError", "PointsError", "Pool", "PoolError", "Refusal",
    "Results", "Run", "each", "grid", "points", "random", "sobol", "sweep",
]  # fmt: skip
