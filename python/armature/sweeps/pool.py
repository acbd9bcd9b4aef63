# SPDX-License-Identifier: Apache-2.0
"""Workers on this machine: processes that are started once and kept."""
from __future__ import annotations

import contextlib
import dataclasses
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from multiprocessing.connection import Connection, wait

from .job import Job
from .run import Run, Task, lost


class PoolError(RuntimeError):
    """Workers cannot be started or kept; the text says why and what to do."""


class Pool:
    """`workers` processes of this machine (None: one for each core this process may use).

    Keep one open for several sweeps: `with Pool(4) as pool: sweep(..., workers=pool)`. Workers need
    no `if __name__ == "__main__"` in the script that starts them.
    @thread the one that made it
    """

    #: Workers that may die with the same run before it is given up.
    MOST_ATTEMPTS = 3

    def __init__(self, workers: int | None = None):
        if workers is None:
            workers = len(os.sched_getaffinity(0))
        if workers < 1:
            raise PoolError(f"the number of workers must be 1 or more, found {workers}")
        self._workers: list[_Worker] = []
        # What runs leave behind is gone with the pool, also where their worker was killed.
        self._scratch = tempfile.mkdtemp(prefix="armature-sweep-")
        self.start_seconds: list[float] = []  #: from starting a worker to its first word
        self._failed_starts = 0
        try:
            for _ in range(workers):
                self._workers.append(_Worker(self._scratch))
        except BaseException:
            self.close()
            raise

    def __len__(self) -> int:
        return len(self._workers)

    @property
    def processes(self) -> list[int]:
        """The identifiers of the workers' processes."""
        return [worker.process.pid for worker in self._workers]

    def run(self, job: Job, tasks: Sequence[Task]) -> Iterator[Run]:
        """Yields each task's run as it ends, in whatever order that is.

        A worker that dies is replaced, and its run is done again. A caller that leaves the
        iteration early leaves workers at work: close the pool then, or use `Pool` as a context.
        """
        if not self._workers:
            raise PoolError("the pool is closed: its workers have ended (open another one)")
        for worker in list(self._workers):
            if worker.task is not None:
                self._replace(worker)  # A run that was given up half-way is of no use now.
        waiting = deque(tasks)
        attempts: Counter[int] = Counter()
        while waiting or any(worker.task for worker in self._workers):
            self._hand_out(job, waiting)
            for worker in self._whose_turn():
                run = self._hear(worker, waiting, attempts)
                if run is not None:
                    yield run

    def close(self) -> None:
        """Ends all workers at once, whatever they do: their runs are simulated only."""
        for worker in self._workers:
            worker.end()
        self._workers.clear()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def _hand_out(self, job: Job, waiting: deque[Task]) -> None:
        for worker in self._workers:
            if waiting and worker.is_ready and worker.task is None:
                worker.give(job, waiting.popleft())

    def _whose_turn(self) -> list[_Worker]:
        ready = wait([worker.connection for worker in self._workers])
        return [worker for worker in self._workers if worker.connection in ready]

    def _hear(self, worker: _Worker, waiting: deque[Task], attempts: Counter[int]) -> Run | None:
        try:
            answer = worker.receive()
        except (EOFError, ConnectionError):
            return self._bury(worker, waiting, attempts)
        if isinstance(answer, Run):
            self._failed_starts = 0
            return dataclasses.replace(answer, attempts=1 + attempts[answer.number])
        self.start_seconds.append(worker.ready())
        return None

    def _bury(self, worker: _Worker, waiting: deque[Task], attempts: Counter[int]) -> Run | None:
        """Its task is done again by another one, unless it was the last attempt."""
        self._replace(worker)
        task = worker.task
        if task is None:
            self._count_failed_start(worker)
            return None
        attempts[task.number] += 1
        if attempts[task.number] < self.MOST_ATTEMPTS:
            waiting.appendleft(task)
            return None
        how = f"{attempts[task.number]} workers died with it: {worker.how_it_ended()}"
        return lost(task, attempts[task.number], how)

    def _count_failed_start(self, worker: _Worker) -> None:
        self._failed_starts += 1
        if self._failed_starts >= self.MOST_ATTEMPTS * len(self._workers):
            raise PoolError(
                f"workers end before they do a run: {worker.how_it_ended()} "
                "(see what they wrote above)"
            )

    def _replace(self, worker: _Worker) -> None:
        worker.end()
        self._workers[self._workers.index(worker)] = _Worker(self._scratch)


class _Worker:
    def __init__(self, scratch: str) -> None:
        ours, theirs = socket.socketpair()
        with theirs:
            self.process = subprocess.Popen(
                # -P: the search path is the parent's, without the working directory before it.
                [sys.executable, "-P", "-m", "armature.sweeps.worker", str(theirs.fileno()), scratch],
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                env={
                    **os.environ,
                    "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path)),
                    "TMPDIR": scratch,
                },
                process_group=0,  # Ctrl-C is the parent's affair
            )
        self.connection = Connection(ours.detach())
        self.task: Task | None = None
        self.is_ready = False
        self._job_key = ""
        self._begin = time.perf_counter()

    def ready(self) -> float:
        self.is_ready = True
        return time.perf_counter() - self._begin

    def give(self, job: Job, task: Task) -> None:
        self.task = task
        try:
            if self._job_key != job.key:
                self.connection.send(job)
                self._job_key = job.key
            self.connection.send(task)
        except ConnectionError:
            pass  # It has died, as its connection says next.

    def receive(self) -> Run | str:
        answer: Run | str = self.connection.recv()
        if isinstance(answer, Run):
            self.task = None
        return answer

    def how_it_ended(self) -> str:
        code = self.process.wait()
        if code < 0:
            return f"signal {-code}, {signal.strsignal(-code)}"
        return f"exit code {code}"

    def end(self) -> None:
        """With all processes that its runs have started."""
        self.connection.close()
        if self.process.returncode is not None:
            return  # it was ended before, and its number may be another one's now
        self._let_die()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()

    def _let_die(self) -> None:
        """It may be dying by itself, of what is to be told. Its number stays its own meanwhile."""
        how = os.WEXITED | os.WNOHANG | os.WNOWAIT
        end = time.monotonic() + 0.05
        while time.monotonic() < end and os.waitid(os.P_PID, self.process.pid, how) is None:
            time.sleep(0.005)

