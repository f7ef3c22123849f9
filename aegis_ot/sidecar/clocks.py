"""Notices that a clock was set: against the monotonic one it runs on evenly otherwise."""

from __future__ import annotations

LEAP_S = 5.0
"""A clock that is ahead or behind by less may drift."""


class ClockWatch:
    """Looks at one wall clock now and then."""

    def __init__(self) -> None:
        self._offset: float | None = None
        self._suspected: float | None = None

    def look(self, clock: float, monotonic: float) -> float:
        """By how much it was set, s; 0 if it was not.

        A leap counts when the next look confirms it: between the two clocks of one look the
        machine may have paused.

        Args:
            clock: What it says, seconds since the epoch.
            monotonic: When that was, ``time.monotonic``, s.
        """
        offset = clock - monotonic
        before, suspected = self._offset, self._suspected
        self._suspected = None
        if before is None or abs(offset - before) < LEAP_S:
            self._offset = offset
            return 0.0
        if suspected is None or abs(offset - suspected) >= LEAP_S:
            self._suspected = offset
            return 0.0
        self._offset = offset
        return offset - before


def tell_leap(whose: str, seconds: float) -> str:
    """``"The robot's clock was set 3600 s ahead, or it slept so long."``"""
    way = "ahead, or it slept so long" if seconds > 0 else "back"
    return (
        f"The {whose}'s clock was set {abs(seconds):.0f} s {way}; times in this run leap with it."
    )
