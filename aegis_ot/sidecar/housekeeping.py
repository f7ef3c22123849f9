"""Keeps the store in order: closes runs that ended without a word, removes old ones."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from ..errors import StoreError
from .background import BackgroundWorker
from .config import RetentionSettings
from .journal import event
from .store import SILENT, Store

log = logging.getLogger(__name__)

EVERY_S = 600.0
_SURE_S = 7 * 86_400.0
"""A run that was closed as silent may go on after a long pause: it is not removed sooner, s."""
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


def tidy(
    store: Store,
    settings: RetentionSettings,
    ages: Mapping[str, float] | None = None,
    pretend: bool = False,
) -> Tidied:
    """Close silent runs, then remove what is too old, then the oldest until the size is kept.

    A run that has not ended is never removed.

    Args:
        store: The store.
        settings: How long and how much is kept.
        ages: By run, since it ended, or its robot was heard of, s. By default only the time counts
            in which a sidecar was at work: a wall clock may be wrong by years.
        pretend: Only say what would be done.

    Raises:
        StoreError: The store cannot be read or written.
    """
    running = store.unfinished()
    known = store.ages() if ages is None else ages
    closed = tuple(run for run in running if known.get(run, 0.0) > 3600 * settings.silent_h)
    for run in () if pretend else closed:
        store.forget_torn(run)
        store.close_silent(run, f"The robot has said nothing for {settings.silent_h:g} h.")
        event("silent", run=run)
    known = {run: 0.0 if run in closed else age for run, age in known.items()}
    old, freed = _too_much(store, settings, known)
    for run in () if pretend else old:
        store.forget(run)
        event("removed", run=run)
    return Tidied(closed, old, freed)


def _too_much(
    store: Store, settings: RetentionSettings, ages: Mapping[str, float]
) -> tuple[tuple[str, ...], int]:
    if settings.days is None and settings.gigabytes is None:
        return (), 0
    ended = [row for row in reversed(store.runs()) if row["finished"]]
    ended.sort(key=lambda row: -ages.get(row["run"], 0.0))
    sizes = {row["run"]: store.size(row["run"]) for row in ended}
    total = sum(sizes.values())
    removed, freed = [], 0
    for row in ended:
        age = ages.get(row["run"], 0.0)
        if row["finished"]["outcome"] == SILENT and age < _SURE_S:
            continue
        too_old = settings.days is not None and age > settings.days * 86_400
        too_big = settings.gigabytes is not None and total - freed > settings.gigabytes * _GB
        if too_old or too_big:
            removed.append(str(row["run"]))
            freed += sizes[row["run"]]
    return tuple(removed), freed


class Housekeeper(BackgroundWorker[float]):
    """Tidies at once and then every ten minutes, in a thread of its own.

    Args:
        store: The store.
        settings: How long and how much is kept.
        changed: Called when something was done.
        heard: Runs whose robots said something in the last so many seconds.
    """

    def __init__(
        self,
        store: Store,
        settings: RetentionSettings,
        changed: Callable[[Tidied], None],
        heard: Callable[[float], Iterable[str]],
    ) -> None:
        self._store, self._settings, self._changed = store, settings, changed
        self._heard = heard
        self._pause_s = 0.0
        super().__init__("housekeeper")

    def look(self) -> None:
        """Once: who is there still, then what is too old. Raises StoreError."""
        self._store.count_time(self._heard(2 * EVERY_S))
        done = tidy(self._store, self._settings)
        if done.closed or done.removed:
            self._changed(done)

    def _next(self) -> float | None:
        pause, self._pause_s = self._pause_s, EVERY_S
        return None if self._closing.wait(pause) else pause

    def _do(self, task: float) -> None:
        try:
            self.look()
        except StoreError as error:
            log.warning("The store could not be tidied: %s", error)
