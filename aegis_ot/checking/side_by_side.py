"""Checks files side by side, each worker with a rehearsing process of its own."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import ExitStack
from types import TracebackType
from typing import TypeVar

from .rehearser import Rehearser

Item = TypeVar("Item")
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
    items: Sequence[Item],
    jobs: int,
    rules: tuple[str, ...],
    check: Callable[[Item, LazyRehearser], T],
    done: Callable[[T], None] = lambda _: None,
) -> list[T]:
    """What comes of each item, in the order of the items, however long each one takes.

    Whatever is raised here, an interruption by the user included, ends all rehearsals first.

    Args:
        items: Protocol files, or what stands for them.
        jobs: How many to check at a time.
        rules: Paths of further rules.
        check: Checks one, in a thread of its own if there are several jobs.
        done: Told of each result, in the order of the items, in the caller's thread.
    """
    results: list[T] = []
    jobs = max(1, min(jobs, len(items)))
    with ExitStack() as stack:
        rehearsers = [stack.enter_context(LazyRehearser(rules)) for _ in range(jobs)]
        if jobs == 1:
            for item in items:
                results.append(check(item, rehearsers[0]))
                done(results[-1])
            return results
        idle: queue.SimpleQueue[LazyRehearser] = queue.SimpleQueue()
        for rehearser in rehearsers:
            idle.put(rehearser)

        def work(item: Item) -> T:
            rehearser = idle.get()
            try:
                return check(item, rehearser)
            finally:
                idle.put(rehearser)

        pool = ThreadPoolExecutor(jobs, "aegis-ot-check")
        try:
            for future in [pool.submit(work, item) for item in items]:
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
