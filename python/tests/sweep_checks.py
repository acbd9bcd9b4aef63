# SPDX-License-Identifier: Apache-2.0
"""What tests of sweeps share."""
from __future__ import annotations

import struct


def bits(results):
    """What must be the same wherever the runs were done: floating-point numbers to the bit."""
    return [
        (
            run.number,
            sorted(run.point.items()),
            run.outcome,
            sorted((name, struct.pack("<d", value)) for name, value in run.metrics.items()),
            run.reason,
        )
        for run in results
    ]
