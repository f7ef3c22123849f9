"""Checks files side by side, each worker with a rehearsing process of its own."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import TypeVar

from .rehearser import Rehearser

T = TypeVar("T")

_LISTEN_S = 0.2
"""How often the main thread wakes to hear Ctrl-C: a wait without end hears it only if the system
hands the signal to that very thread, and on Windows never."""


def processors() -> int:
    """How many processors this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


class LazyRehearser:
    """A rehearser that is started when the first readable file needs it.

    Args:
        rules: Paths of further rules, loaded ahead.

    Attributes:
        cancelled: Set once it does nothing more.
    """

    def __init__(self, rules: tuple[str, ...]) -> None:
        self._rules = rules
        self._lock = threading.Lock()
        self._rehearser: Rehearser | None = None
        self.cancelled = threading.Event()

    def __enter__(self) -> LazyRehearser:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._rehearser is not None:
            self._rehearser.__exit__(kind, error, trace)

    def get(self) -> Rehearser:
        """The rehearser; it starts its process with the first task."""
        with self._lock:
            if self._rehearser is None:
                self._rehearser = Rehearser(self._rules)
                if self.cancelled.is_set():
                    self._rehearser.cancel()
            return self._rehearser

    def cancel(self) -> None:
        """End what it does now, and all that it is asked from now on."""
        with self._lock:
            self.cancelled.set()
            if self._rehearser is not None:
                self._rehearser.cancel()


def check_each(
    files: Sequence[Path],
    jobs: int,
    rules: tuple[str, ...],
    check: Callable[[Path, LazyRehearser], T],
    done: Callable[[T], None],
) -> list[T]:
    """What comes of each file, in the order of the files, however long each one takes.

    Whatever is raised here, an interruption by the user included, ends all rehearsals first.

    Args:
        files: Protocol files.
        jobs: How many to check at a time.
        rules: Paths of further rules.
        check: Checks one file, in a thread of its own if there are several jobs.
        done: Told of each result, in the order of the files, in the caller's thread.
    """
    results: list[T] = []
    jobs = max(1, min(jobs, len(files)))
    with ExitStack() as stack:
        rehearsers = [stack.enter_context(LazyRehearser(rules)) for _ in range(jobs)]
        if jobs == 1:
            for file in files:
                results.append(check(file, rehearsers[0]))
                done(results[-1])
            return results
        idle: queue.SimpleQueue[LazyRehearser] = queue.SimpleQueue()
        for rehearser in rehearsers:
            idle.put(rehearser)

        def work(file: Path) -> T:
            rehearser = idle.get()
            try:
                return check(file, rehearser)
            finally:
                idle.put(rehearser)

        pool = ThreadPoolExecutor(jobs, "aegis-ot-check")
        try:
            for future in [pool.submit(work, file) for file in files]:
                while not future.done():
                    wait([future], _LISTEN_S)
                results.append(future.result())
                done(results[-1])
        except BaseException:
            for rehearser in rehearsers:
                rehearser.cancel()  # first: an impatient second Ctrl-C may end this block
            pool.shutdown(wait=False, cancel_futures=True)
            raise
        finally:
            pool.shutdown()
    return results
