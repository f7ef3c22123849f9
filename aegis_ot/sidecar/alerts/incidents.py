"""Trouble that befell runs, kept with them. Trouble of the store is kept once it works again."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, field

from ...errors import StoreError
from ...run_view.overview import IncidentEntry
from ..journal import event
from ..store import Store


@dataclass
class Incidents:
    """Begins and ends the incidents of all runs. Safe to use from threads.

    Args:
        store: Where they are kept. A full disk cannot be told in it; then it waits here.
    """

    store: Store
    _waiting: dict[tuple[str, str], tuple[str, float]] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def begin(self, run: str, kind: str, seen: str) -> bool:
        """Trouble began; whether it is new, and not the one that goes on."""
        with self._lock:
            try:
                new = self.store.begin_incident(run, kind, seen)
            except StoreError:
                new = (run, kind) not in self._waiting
                self._waiting.setdefault((run, kind), (seen, time.time()))
        if new:
            event("incident", run=run, kind=kind, seen=seen)
        return new

    def waiting(self, run: str) -> list[IncidentEntry]:
        """Trouble that lasts and could not be kept, as :meth:`.Store.incidents` gives it."""
        with self._lock:
            return [
                {"kind": kind, "text": seen, "at": at, "ended": None}
                for (whose, kind), (seen, at) in self._waiting.items()
                if whose == run
            ]

    def end(self, run: str, kind: str) -> bool:
        """Trouble is over; whether there was any. Raises StoreError if that cannot be kept."""
        with self._lock:
            known = self._waiting.get((run, kind))
            if known is not None:
                self.store.add_incident(run, kind, *known, ended=time.time())
                del self._waiting[run, kind]
            over = self.store.end_incidents(run, kind) or known is not None
        if over:
            event("over", run=run, kind=kind)
        return over

    def note(self, run: str, kind: str, seen: str) -> None:
        """Trouble that is over by now. Raises StoreError if it cannot be kept."""
        now = time.time()
        self.store.add_incident(run, kind, seen, now, ended=now)
        event("incident", run=run, kind=kind, seen=seen, lasted_s=0.0)
