"""What counts already and could not be written: safety first, the record after."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import StoreError

log = logging.getLogger(__name__)

TRY_EVERY_S = 2.0


@dataclass(frozen=True)
class Record:
    """One of them.

    Attributes:
        kind: ``"verdict"``, ``"decision"``, ``"action"``, ``"hold"`` or ``"end"``.
        row: As the run's overview shows it once it is written.
        write: Writes it; raises StoreError.
    """

    kind: str
    row: dict[str, Any]
    write: Callable[[], object]


class Unrecorded:
    """Records of one run that wait for room, oldest first. Safe to use from threads.

    Args:
        failed: Told why, whenever one could not be written.
        written: Called when all that waited was written.
    """

    def __init__(self, failed: Callable[[StoreError], None], written: Callable[[], None]) -> None:
        self._failed = failed
        self._written = written
        self._waiting: list[Record] = []
        self._lock = threading.Lock()
        self._timer: threading.Timer | None = None
        self._closed = False

    def __len__(self) -> int:
        return len(self._waiting)

    def rows(self, kind: str) -> list[dict[str, Any]]:
        """What waits of a kind."""
        return [record.row for record in list(self._waiting) if record.kind == kind]

    def keep(self, record: Record) -> None:
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
        self._written()
