"""The robot's clock against this machine's, which never jumps (``time.monotonic``)."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable

from ..errors import RobotError

JUMP_S = 0.25
"""Two looks at the robot's clock that differ by more are no drift: somebody set it."""
_LOOKS = 3
_EVERY_S = 5.0
_SLACK_S = 0.75
"""How far the end of a command may lie outside the two looks between which it was seen, s."""


class RobotClock:
    """Turns the robot's times into ``time.monotonic``.

    Args:
        ask: The robot's clock now, s since the epoch.

    Attributes:
        jumps: How often the robot's clock was seen to be set.
        round_trip_s: Of the look that counts; half of it is how exact a time is.
    """

    def __init__(self, ask: Callable[[], float]) -> None:
        self._ask = ask
        self._ahead: float | None = None
        self.jumps = 0
        self.round_trip_s = 0.0

    def look(self) -> None:
        """Compare the clocks, by the quickest of three questions."""
        best: tuple[float, float] | None = None
        for _ in range(_LOOKS):
            before = time.monotonic()
            told = self._ask()
            after = time.monotonic()
            look = (after - before, told - (before + after) / 2)
            best = look if best is None else min(best, look)
        assert best is not None
        doubt_s = (self.round_trip_s + best[0]) / 2
        self.round_trip_s, ahead = best
        if self._ahead is not None and abs(ahead - self._ahead) > JUMP_S + doubt_s:
            self.jumps += 1
        self._ahead = ahead

    def local(self, robot_s: float) -> float:
        """A time of the robot on ``time.monotonic``, s."""
        if self._ahead is None:
            self.look()
            assert self._ahead is not None
        return robot_s - self._ahead


class WatchedClock:
    """A robot's clock during one run, compared now and then.

    Args:
        ask: As for :class:`RobotClock`.
        says: Told that somebody set the clock.
    """

    def __init__(self, ask: Callable[[], float], says: Callable[[str], None]) -> None:
        self._clock = RobotClock(ask)
        self._says = says
        self._next = 0.0
        self._followed_since: float | None = None

    def local(self, robot_s: float) -> float:
        """A time of the robot on ``time.monotonic``, s."""
        return self._clock.local(robot_s)

    def look(self) -> None:
        """Compare the clocks."""
        self._next = time.monotonic() + _EVERY_S
        jumps = self._clock.jumps
        with contextlib.suppress(RobotError):  # the follower tells of a lost connection
            self._clock.look()
        if self._clock.jumps > jumps:
            self._says(
                "The robot's clock was set, or this computer slept: a delivery may have no frames."
            )

    def look_around(self, followed: bool) -> None:
        """Between two looks at the run; ``followed``: nothing of it has been missed."""
        if time.monotonic() >= self._next:
            self.look()
        if followed:
            self._followed_since = time.monotonic()

    def is_plausible(self, completed: float) -> bool:
        """Whether a command ended between the last look and now: else a clock was set meanwhile."""
        since = self._followed_since
        if since is None:
            return True
        for again in (True, False):
            local = self.local(completed)
            if since - _SLACK_S <= local <= time.monotonic() + _SLACK_S:
                return True
            if again:
                self.look()
        return False
