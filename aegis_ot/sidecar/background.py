"""Work in a thread of its own: one task after another, and no failure ends it."""

from __future__ import annotations

import logging
import queue
import threading
from typing import Generic, TypeVar

log = logging.getLogger(__name__)

T = TypeVar("T")


class BackgroundWorker(Generic[T]):
    """Takes tasks until it is closed. A subclass says in ``_do`` what it does with one.

    Args:
        name: Of the thread.
        most: How many tasks may wait; 0: any number.
        starts: Whether there is anything to do at all; without, no thread is started.
    """

    def __init__(self, name: str, most: int = 0, starts: bool = True) -> None:
        self._tasks: queue.Queue[T | None] = queue.Queue(most)
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        if starts:
            self._thread = threading.Thread(target=self._work, name=name, daemon=True)
            self._thread.start()

    def close(self, timeout: float = 5.0) -> None:
        """End the thread, for which so many seconds are waited. Idempotent."""
        self._closing.set()
        if self._thread is not None:
            try:
                self._tasks.put(None, timeout=timeout)
            except queue.Full:
                log.warning("%s: tasks were waiting at the end", self._thread.name)
                return
            self._thread.join(timeout)

    def _next(self) -> T | None:
        """The next task; ``None`` ends the thread."""
        return self._tasks.get()

    def _do(self, task: T) -> None:
        raise NotImplementedError

    def _work(self) -> None:
        while (task := self._next()) is not None:
            try:
                self._do(task)
            except Exception:
                log.exception("%s failed: %s", threading.current_thread().name, task)
