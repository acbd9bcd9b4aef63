# SPDX-License-Identifier: Apache-2.0
"""What all runs of a sweep share, as it is sent to workers: once, and by value where it must be."""
from __future__ import annotations

import dataclasses
import hashlib
import pickle
from functools import lru_cache

from .run import RunPoint


@dataclasses.dataclass(frozen=True)
class Job:
    """A `RunPoint` in the form in which it travels."""

    pickled: bytes

    @staticmethod
    def of(run_point: RunPoint) -> Job:
        """Functions of a script or notebook travel by value, others by name.

        @raises TypeError if it cannot be sent; the text says what stands in the way.
        """
        try:
            import cloudpickle
        except ImportError:
            raise RuntimeError("sweeps need cloudpickle (apt-get install python3-cloudpickle)") from None
        try:
            return Job(cloudpickle.dumps(run_point))
        except Exception as error:
            raise TypeError(
                f"the metrics cannot be sent to another process: {error} "
                "(use a function of a module or script that holds no open files or applications)"
            ) from error

    @property
    def key(self) -> str:
        return hashlib.sha256(self.pickled).hexdigest()[:16]

    def load(self) -> RunPoint:
        return _loaded(self.pickled)


@lru_cache(maxsize=4)
def _loaded(pickled: bytes) -> RunPoint:
    run_point: RunPoint = pickle.loads(pickled)
    return run_point
