"""What is told of one run: it counts at once, and is written as soon as the store takes it."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import StoreError
from ..run_view.overview import DecisionEntry
from ..vocabulary import Verdict
from .journal import event
from .store import Store
from .wire import Action, Decision, Finish, HoldReport, OrderRequest, RecoveryReport

log = logging.getLogger(__name__)

TRY_EVERY_S = 2.0


@dataclass(frozen=True)
class PendingRecord:
    """One of them.

    Attributes:
        kind: ``"verdict"``, ``"decision"``, ``"action"``, ``"hold"``, ``"abandon"``,
            ``"recovery"``, ``"incident"`` or ``"end"``.
        row: As the run's overview shows it once it is written.
        write: Writes it; raises StoreError.
    """

    kind: str
    row: Mapping[str, Any]
    write: Callable[[], object]


class RunRecord:
    """Writes it down, oldest first. Safe to use from threads.

    Args:
        run: Identifier of the run.
        store: Where to.
        failed: Told why, whenever something could not be written.
        changed: Called whenever there is something new to show.
    """

    def __init__(
        self,
        run: str,
        store: Store,
        failed: Callable[[StoreError], None],
        changed: Callable[[], None],
    ) -> None:
        self._run, self._store = run, store
        self._failed, self._changed = failed, changed
        self._waiting: list[PendingRecord] = []
        self._lock = threading.Lock()
        self._timer: threading.Timer | None = None
        self._closed = False

    def verdict(self, verdict: Verdict, evidence: dict[str, Any]) -> None:
        """The analyser's."""
        row = {"verdict": verdict, "evidence": evidence, "at": time.time()}
        self.keep(PendingRecord("verdict", row, lambda: self._store.add_verdict(verdict, evidence)))

    def abandon(self, trajectory: int, reason: str) -> None:
        """A delivery was given up."""
        row = {"trajectory": trajectory, "reason": reason}
        self._keep("abandon", row, lambda: self._store.abandon(self._run, trajectory, reason))

    def recovery(self, told: RecoveryReport) -> None:
        """What the robot does by itself about a failed delivery."""
        at = time.time()
        row = told.model_dump() | {"at": at}
        self._keep("recovery", row, lambda: self._store.add_recovery(self._run, told, at))

    def outage(self, kind: str, said: str, lasted_s: float) -> None:
        """For how long, until now, the robot was not served."""
        at = time.time()
        row = {"kind": kind, "text": said, "at": at - lasted_s, "ended": at}
        told = (self._run, kind, said, at - lasted_s, at)
        self._keep("incident", row, lambda: self._store.add_incident(*told))
        event("incident", run=self._run, kind=kind, seen=said, lasted_s=round(lasted_s, 1))

    def hold(self, hold: HoldReport) -> None:
        """How a hold ended."""
        at = time.time()
        row = hold.model_dump() | {"at": at}
        self._keep("hold", row, lambda: self._store.add_hold(self._run, hold, at))

    def end(self, finish: Finish) -> None:
        """How the run ended."""
        at = time.time()

        def write() -> None:
            self._store.finish(self._run, finish, at)
            if finish.layer1 is not None:
                self._store.add_layer1(self._run, finish.layer1.model_dump())

        self._keep("end", {"at": at, **finish.model_dump(exclude={"layer1"})}, write)

    def decision(self, trajectory: int, decision: Decision, row: DecisionEntry) -> None:
        """What a person made of a verdict; ``row`` as the overview shows it."""
        told = (self._run, trajectory, decision, row["at"])
        shown = {**row, "trajectory": trajectory}
        self._keep("decision", shown, lambda: self._store.add_decision(*told))
        event("decision", run=self._run, trajectory=trajectory, outcome=row["outcome"],
              by=decision.by)  # fmt: skip

    def action(self, trajectory: int, told: Action | OrderRequest, at: float) -> None:
        """What a person told the robot."""
        row = told.model_dump(mode="json") | {"at": at, "trajectory": trajectory}
        self._keep("action", row, lambda: self._store.add_action(self._run, trajectory, told, at))

    def _keep(self, kind: str, row: Mapping[str, Any], write: Callable[[], object]) -> None:
        self._changed()
        self.keep(PendingRecord(kind, row, write))
        self._changed()

    def __len__(self) -> int:
        return len(self._waiting)

    def rows(self, kind: str) -> list[Mapping[str, Any]]:
        """What waits of a kind."""
        return [record.row for record in list(self._waiting) if record.kind == kind]

    def keep(self, record: PendingRecord) -> None:
        """Write it now, after all that came before, or as soon as that can be done."""
        with self._lock:
            self._waiting.append(record)
        try:
            self.write()
        except StoreError as error:
            log.error("Not yet on record (%s): %s", record.kind, error)
            self._failed(error)

    def write(self) -> None:
        """Write what waits.

        Raises:
            StoreError: There is no room; it is tried again every two seconds.
        """
        with self._lock:
            try:
                while self._waiting:
                    self._waiting[0].write()
                    del self._waiting[0]
            except StoreError:
                if self._timer is None and not self._closed:
                    self._timer = threading.Timer(TRY_EVERY_S, self._again)
                    self._timer.daemon = True
                    self._timer.start()
                raise

    def close(self) -> None:
        """Try a last time. Idempotent."""
        self._closed = True
        if self._timer is not None:
            self._timer.cancel()
        try:
            self.write()
        except StoreError as error:
            log.error("%d records of a run are lost: %s", len(self._waiting), error)

    def _again(self) -> None:
        self._timer = None
        try:
            self.write()
        except StoreError:
            return
        self._changed()
