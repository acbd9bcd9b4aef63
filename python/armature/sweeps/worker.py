# SPDX-License-Identifier: Apache-2.0
"""The process behind a `Pool`: `python3 -m armature.sweeps.worker SOCKET`, started by pool.py.

It has the parent's search path and none of its state, keeps what it has loaded from run to run, and
ends within a second of its parent.
"""
from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from multiprocessing.connection import Connection

from .job import Job
from .run import Task, run_task


def serve(connection: Connection) -> None:
    """Answers each task with its run, one after the other, until the other side has gone."""
    job: Job | None = None
    with contextlib.suppress(EOFError, ConnectionError):
        connection.send("ready")
        while True:
            message = connection.recv()
            if isinstance(message, Job):
                job = message
            elif isinstance(message, Task):
                assert job is not None
                connection.send(run_task(job.load(), message))


def end_with(parent: int) -> None:
    """Also in the middle of a run, which nobody waits for any more."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


if __name__ == "__main__":
    threading.Thread(target=end_with, args=(os.getppid(),), daemon=True).start()
    with Connection(int(sys.argv[1])) as _connection:
        serve(_connection)
