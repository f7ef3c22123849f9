"""A run that is being stopped: every wait of the guard ends for it."""

from __future__ import annotations

import time

from ..adapters.opentrons.run_state import RunState
from ..http_client import SLICE_S

LAST_WORDS_S = 0.25
"""What a stop leaves for telling the sidecar how the run ended, s."""


class Stopping(Exception):
    """Drop everything. Never leaves the runtime room."""


class CancellationToken:
    """Asked during every wait of one run whether it is being stopped."""

    def __init__(self, state: RunState) -> None:
        self._state = state
        self._leaving = False
        self._last_words_until: float | None = None

    def leave(self) -> None:
        """The run is over. A stop now only hastens what is still to be said."""
        self._leaving = True

    def check(self) -> None:
        """Raise :class:`Stopping` if the run is being stopped."""
        if not self._state.stopping:
            return
        if not self._leaving:
            raise Stopping
        now = time.monotonic()
        if self._last_words_until is None:
            self._last_words_until = now + LAST_WORDS_S
        if now >= self._last_words_until:
            raise Stopping

    def rest(self, seconds: float) -> None:
        """Sleep in short slices.

        Raises:
            Stopping: The run is being stopped.
        """
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            self.check()
            time.sleep(min(SLICE_S, left))
        self.check()
