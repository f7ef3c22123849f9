"""Checks files side by side, each worker with a rehearsing process of its own."""

from __future__ import annotations

import os
import queue
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import ExitStack
from typing import TypeVar

from .engines import Engine
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
    """Rehearsers, one for each engine, started when the first readable file needs them.

    Attributes:
        cancelled: Set once it does nothing more.
    """

    def __init__(self, rules: tuple[str, ...]) -> None:
        self._rules = rules
        self._lock = threading.Lock()
        self._rehearsers: dict[str, Rehearser] = {}
        self.cancelled = threading.Event()

    def __enter__(self) -> LazyRehearser:
        return self

    def __exit__(self, *_: object) -> None:
        for rehearser in self._rehearsers.values():
            rehearser.__exit__()

    def get(self, engine: Engine) -> Rehearser:
        """The rehearser with this engine; it starts its process with the first task."""
        with self._lock:
            found = self._rehearsers.get(engine.python)
            if found is None:
                found = self._rehearsers[engine.python] = Rehearser(
                    self._rules, engine, lasting=True
                )
                if self.cancelled.is_set():
                    found.cancel()
            return found

    def cancel(self) -> None:
        """End what it does now, and all that it is asked from now on."""
        with self._lock:
            self.cancelled.set()
            for rehearser in self._rehearsers.values():
                rehearser.cancel()


class RehearserPool:
    """Rehearsers that stay alive from one call to the next; close it when no more will come."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: dict[tuple[str, ...], list[LazyRehearser]] = {}

    def take(self, rules: tuple[str, ...]) -> LazyRehearser:
        """One that nobody else has."""
        with self._lock:
            idle = self._idle.get(rules)
            return idle.pop() if idle else LazyRehearser(rules)

    def give(self, rules: tuple[str, ...], rehearser: LazyRehearser) -> None:
        """Put it back."""
        if rehearser.cancelled.is_set():
            rehearser.__exit__(None, None, None)
            return
        with self._lock:
            self._idle.setdefault(rules, []).append(rehearser)

    def close(self) -> None:
        """End all that are idle."""
        with self._lock:
            idle, self._idle = self._idle, {}
        for rehearser in (one for several in idle.values() for one in several):
            rehearser.__exit__(None, None, None)


def check_each(
    items: Sequence[Item],
    jobs: int,
    rules: tuple[str, ...],
    check: Callable[[Item, LazyRehearser], T],
    done: Callable[[T], None] = lambda _: None,
    pool: RehearserPool | None = None,
) -> list[T]:
    """What comes of each item, in the order of the items, however long each one takes.

    Whatever is raised here, an interruption by the user included, ends all rehearsals first.

    Args:
        items: Protocol files, or what stands for them.
        jobs: How many to check at a time.
        rules: Paths of further rules.
        check: Checks one, in a thread of its own if there are several jobs.
        done: Told of each result, in the order of the items, in the caller's thread.
        pool: Lends the rehearsers, and keeps them; without one they end with this call.
    """
    results: list[T] = []
    jobs = max(1, min(jobs, len(items)))
    with ExitStack() as stack:
        lender = pool or RehearserPool()
        if pool is None:
            stack.callback(lender.close)
        rehearsers = [lender.take(rules) for _ in range(jobs)]
        for rehearser in rehearsers:
            stack.callback(lender.give, rules, rehearser)
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

        threads = ThreadPoolExecutor(jobs, "aegis-ot-check")
        try:
            for future in [threads.submit(work, item) for item in items]:
                while not future.done():
                    wait([future], _LISTEN_S)
                results.append(future.result())
                done(results[-1])
        except BaseException:
            for rehearser in rehearsers:
                rehearser.cancel()  # first: an impatient second Ctrl-C may end this block
            threads.shutdown(wait=False, cancel_futures=True)
            raise
        finally:
            threads.shutdown()
    return results
