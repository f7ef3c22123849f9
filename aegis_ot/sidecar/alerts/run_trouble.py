"""Trouble of one run, told when it begins and when it is over."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ...errors import StoreError
from ...vocabulary import Keyframe, Verdict
from ..clocks import ClockWatch, tell_leap
from .alerts import Alerts
from .notices import Notice

log = logging.getLogger(__name__)

WHAT = {"store": "the store is in trouble", "model": "the vision model does not answer"}
"""Kinds of trouble that last, in words."""


class RunTrouble:
    """Knows which trouble lasts, so that its end is told once."""

    def __init__(self, run: str, alerts: Alerts) -> None:
        self._run = run
        self._alerts = alerts
        self._lasting: set[str] = set()
        self._clocks = {"workstation": ClockWatch(), "robot": ClockWatch()}

    def bad(self, verdict: Verdict) -> None:
        """A verdict that people have to hear of."""
        self._alerts.tell(Notice.of_verdict(verdict))

    def begins(self, kind: str, seen: str) -> None:
        """Trouble of a kind of :data:`WHAT`; saying it again changes nothing."""
        self._lasting.add(kind)
        self._alerts.tell(Notice(self._run, kind, WHAT[kind], seen))

    def is_over(self, kind: str) -> None:
        """It works again.

        Raises:
            StoreError: The end cannot be kept; it counts as lasting.
        """
        if kind in self._lasting:
            self._alerts.over(self._run, kind)
            self._lasting.discard(kind)

    def look_at_clocks(self, keyframe: Keyframe) -> None:
        """Times of a run are those of wall clocks: tell where one was set meanwhile.

        Each is held against its own machine's running time: how long a keyframe was under way
        says nothing about clocks.
        """
        told = {"workstation": (time.time(), time.monotonic())}
        if keyframe.robot_time and keyframe.robot_uptime:
            told["robot"] = (keyframe.robot_time, keyframe.robot_uptime)
        for whose, (clock, when) in told.items():
            leap = self._clocks[whose].look(clock, when)
            if leap:
                self._alerts.note(self._run, "clock", tell_leap(whose, leap))

    @contextmanager
    def at_most_logged(self) -> Iterator[None]:
        """What the store cannot take now is tried again with the next keyframe."""
        try:
            yield
        except StoreError as error:
            log.warning("Run %s: %s", self._run, error)
