"""The look back at each run that has ended: one after another, in a thread of its own."""

from __future__ import annotations

import logging
import queue
import threading
from collections.abc import Callable
from typing import Any, Protocol

from ..errors import AegisError
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


class Audits:
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
        self._runs: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._work, name="audits", daemon=True)
        self._thread.start()

    def add(self, run: str) -> None:
        """A run has ended. Never blocks."""
        self._runs.put(run)

    def close(self) -> None:
        """End the thread, and the audit in hand. Idempotent."""
        self._closed.set()
        self._runs.put("")
        self._auditor.stop()
        self._thread.join(5.0)

    def _work(self) -> None:
        while True:
            run = self._runs.get()
            if self._closed.is_set():
                return
            if not self._settled(run):
                self._closed.wait(ASKS_S)
                self._runs.put(run)  # others need not wait for its last verdicts
                continue
            try:
                if not self._store.verdicts(run):
                    continue  # nothing was watched
                found = self._auditor.audit(run)
                self._store.add_audit(run, found)
                event("audit", run=run, suspects=sum(s["stands_out"] for s in found["suspects"]))
                self._done()
            except AegisError as error:
                if not self._closed.is_set():
                    log.warning("Run %s was not audited: %s", run, error)
            except Exception:
                log.exception("Run %s was not audited", run)
