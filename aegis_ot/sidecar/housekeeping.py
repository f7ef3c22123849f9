"""Keeps the store in order: closes runs that ended without a word, removes old ones."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from ..errors import StoreError
from .config import RetentionSettings
from .journal import event
from .store import Store

log = logging.getLogger(__name__)

EVERY_S = 600.0
_GB = 1e9


@dataclass(frozen=True)
class Tidied:
    """What was done.

    Attributes:
        closed: Runs that were closed as silent.
        removed: Runs that were removed, oldest first.
        freed: What their frames took, bytes.
    """

    closed: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    freed: int = 0


def tidy(store: Store, settings: RetentionSettings, now: float, pretend: bool = False) -> Tidied:
    """Close silent runs, then remove what is too old, then the oldest until the size is kept.

    A run that has not ended is never removed.

    Args:
        store: The store.
        settings: How long and how much is kept.
        now: Seconds since the epoch.
        pretend: Only say what would be done.

    Raises:
        StoreError: The store cannot be read or written.
    """
    closed = tuple(
        run for run, heard in store.last_words().items() if now - heard > 3600 * settings.silent_h
    )
    for run in () if pretend else closed:
        store.close_silent(run, f"The robot has said nothing for {settings.silent_h:g} h.")
        event("silent", run=run)
    old, freed = _too_much(store, settings, now)
    for run in () if pretend else old:
        store.forget(run)
        event("removed", run=run)
    return Tidied(closed, old, freed)


def _too_much(store: Store, settings: RetentionSettings, now: float) -> tuple[tuple[str, ...], int]:
    if settings.days is None and settings.gigabytes is None:
        return (), 0
    ended = [row for row in reversed(store.runs()) if row["finished"]]
    sizes = {row["run"]: store.size(row["run"]) for row in ended}
    total = sum(sizes.values())
    removed, freed = [], 0
    for row in ended:
        age_d = (now - row["finished"]["at"]) / 86_400
        too_old = settings.days is not None and age_d > settings.days
        too_big = settings.gigabytes is not None and total - freed > settings.gigabytes * _GB
        if too_old or too_big:
            removed.append(str(row["run"]))
            freed += sizes[row["run"]]
    return tuple(removed), freed


class Housekeeper:
    """Tidies at once and then every ten minutes, in a thread of its own.

    Args:
        store: The store.
        settings: How long and how much is kept.
        changed: Called when something was done.
    """

    def __init__(
        self, store: Store, settings: RetentionSettings, changed: Callable[[Tidied], None]
    ) -> None:
        self._store, self._settings, self._changed = store, settings, changed
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._work, name="housekeeper", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the thread. Idempotent."""
        self._closed.set()
        self._thread.join(5.0)

    def _work(self) -> None:
        while True:
            try:
                done = tidy(self._store, self._settings, time.time())
                if done.closed or done.removed:
                    self._changed(done)
            except StoreError as error:
                log.warning("The store could not be tidied: %s", error)
            except Exception:
                log.exception("The store could not be tidied")
            if self._closed.wait(EVERY_S):
                return
