# SPDX-License-Identifier: Apache-2.0
"""The process behind a `Pool`: `python3 -m armature.sweeps.worker SOCKET`, started by pool.py.

It has the parent's search path and none of its state, keeps what it has loaded from run to run, and
ends when its parent does.
"""
from __future__ import annotations

import sys
from multiprocessing.connection import Connection

from .job import Job
from .run import Task, run_task


def serve(connection: Connection) -> None:
    """Answers each task with its run, one after the other, until the other side has gone."""
    job: Job | None = None
    connection.send("ready")
    while True:
        try:
            message = connection.recv()
        except (EOFError, ConnectionError):
            return
        if isinstance(message, Job):
            job = message
        elif isinstance(message, Task):
            assert job is not None
            connection.send(run_task(job.load(), message))


if __name__ == "__main__":
    with Connection(int(sys.argv[1])) as _connection:
        serve(_connection)
