# SPDX-License-Identifier: Apache-2.0
"""The process behind a `Pool`: `python3 -m armature.sweeps.worker SOCKET SCRATCH`, started by pool.py.

It has the parent's search path and none of its state, keeps what it has loaded from run to run, and
ends within a second of its parent.
"""
from __future__ import annotations

import contextlib
import os
import shutil
import signal
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
                connection.send(run_task(job, message))


def end_with(parent: int, scratch: str) -> None:
    """Also in the middle of a run, which nobody waits for any more, with all that it has started."""
    while os.getppid() == parent:
        time.sleep(1.0)
    shutil.rmtree(scratch, ignore_errors=True)
    if os.getpgrp() == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


if __name__ == "__main__":
    threading.Thread(target=end_with, args=(os.getppid(), sys.argv[2]), daemon=True).start()
    with Connection(int(sys.argv[1])) as _connection:
        serve(_connection)
