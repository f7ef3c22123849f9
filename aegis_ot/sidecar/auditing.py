"""The look back at each run that has ended: one after another, in a thread of its own."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, Protocol

from ..errors import AegisError
from .background import BackgroundWorker
from .journal import event
from .store import Store

log = logging.getLogger(__name__)

ASKS_S = 0.5
"""How often it is asked whether all verdicts of an ended run are in, s."""


class Auditor(Protocol):
    """Reads a run again, without taking time from the runs that go on."""

    def audit(self, run: str) -> dict[str, Any]:
        """The audit of a finished run, as plain JSON. Raises AegisError where there is none."""

    def stop(self) -> None:
        """End the audit that is under way; it raises AegisError. Idempotent."""


class Audits(BackgroundWorker[str]):
    """Audits runs as they end, and keeps what was found.

    Args:
        auditor: Does the work.
        store: Where the results are kept.
        settled: Whether all that a run's robot sent has been judged.
        done: Called when one has been kept.
    """

    def __init__(
        self,
        auditor: Auditor,
        store: Store,
        settled: Callable[[str], bool],
        done: Callable[[], None],
    ) -> None:
        self._auditor, self._store, self._settled, self._done = auditor, store, settled, done
        super().__init__("audits")

    def add(self, run: str) -> None:
        """A run has ended. Never blocks."""
        self._tasks.put(run)

    def close(self, timeout: float = 5.0) -> None:
        """End the thread, and the audit in hand. Idempotent."""
        self._closing.set()
        self._auditor.stop()
        super().close(timeout)

    def _do(self, task: str) -> None:
        if self._closing.is_set():
            return
        if not self._settled(task):
            self._closing.wait(ASKS_S)
            self._tasks.put(task)  # others need not wait for its last verdicts
            return
        try:
            if not self._store.verdicts(task):
                return  # nothing was watched
            found = self._auditor.audit(task)
            self._store.add_audit(task, found)
            event("audit", run=task, suspects=sum(s["stands_out"] for s in found["suspects"]))
            self._done()
        except AegisError as error:
            if not self._closing.is_set():
                log.warning("Run %s was not audited: %s", task, error)
