"""The robot's clock against this machine's, which never jumps (``time.monotonic``)."""

from __future__ import annotations

import time
from collections.abc import Callable

JUMP_S = 0.25
"""Two looks at the robot's clock that differ by more are no drift: somebody set it."""
_LOOKS = 3


class RobotClock:
    """Turns the robot's times into ``time.monotonic``.

    Args:
        ask: The robot's clock now, s since the epoch.
        now: ``time.monotonic``.

    Attributes:
        jumps: How often the robot's clock was seen to be set.
        round_trip_s: Of the look that counts; half of it is how exact a time is.
    """

    def __init__(self, ask: Callable[[], float], now: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._now = now
        self._ahead: float | None = None
        self.jumps = 0
        self.round_trip_s = 0.0

    def look(self) -> None:
        """Compare the clocks, by the quickest of three questions."""
        best: tuple[float, float] | None = None
        for _ in range(_LOOKS):
            before = self._now()
            told = self._ask()
            after = self._now()
            look = (after - before, told - (before + after) / 2)
            best = look if best is None else min(best, look)
        assert best is not None
        self.round_trip_s, ahead = best
        if self._ahead is not None and abs(ahead - self._ahead) > JUMP_S:
            self.jumps += 1
        self._ahead = ahead

    def local(self, robot_s: float) -> float:
        """A time of the robot on ``time.monotonic``, s."""
        if self._ahead is None:
            self.look()
            assert self._ahead is not None
        return robot_s - self._ahead
