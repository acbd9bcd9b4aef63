# SPDX-License-Identifier: Apache-2.0
"""How far a sweep is, on standard error."""
from __future__ import annotations

import math
import sys
import time
from typing import TextIO

from .run import Run


class Progress:
    """A line that is kept up to date at a terminal, and written every ten seconds elsewhere."""

    def __init__(self, total: int, objective: str | None, stream: TextIO | None = None):
        self._total = total
        self._objective = objective
        self._stream = stream or sys.stderr
        self._is_terminal = self._stream.isatty()
        self._begin = self._told = time.monotonic()
        self._done = 0
        self._without_result = 0
        self._best: float | None = None

    def add(self, run: Run) -> None:
        self._done += 1
        self._without_result += not run.done
        self._take_best(run)
        now = time.monotonic()
        if now - self._told >= (0.2 if self._is_terminal else 10.0) or self._done == self._total:
            self._told = now
            self._write(self.text(now - self._begin))

    def text(self, elapsed_s: float) -> str:
        """`120/1000 runs, 2.4 a second, 6 min left; 3 without result; best iae 0.0123`"""
        rate = self._done / elapsed_s if elapsed_s > 0 else 0.0
        parts = [f"{self._done}/{self._total} runs"]
        if rate > 0 and self._done < self._total:
            parts.append(f"{rate:.3g} a second, {_time((self._total - self._done) / rate)} left")
        text = ", ".join(parts)
        if self._without_result:
            text += f"; {self._without_result} without result"
        if self._best is not None:
            text += f"; best {self._objective} {self._best:.6g}"
        return text

    def _take_best(self, run: Run) -> None:
        if run.done and self._objective is None:
            self._objective = next(iter(run.metrics))
        value = run.metrics.get(self._objective or "")
        if value is not None and not math.isnan(value) and (self._best is None or value < self._best):
            self._best = value

    def _write(self, text: str) -> None:
        if self._is_terminal:
            self._stream.write(f"\r\x1b[K{text}" + ("\n" if self._done == self._total else ""))
        else:
            self._stream.write(text + "\n")
        self._stream.flush()


def _time(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"
