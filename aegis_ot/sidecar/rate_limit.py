"""How much one address may ask: a client that goes wild must not keep the robots waiting."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable

PER_SECOND = 400.0
"""Requests of one address that are answered for as long as it likes, about half of what a sidecar
can. A robot that holds asks seven times a second; who waits for each answer stays below."""
AT_ONCE = 2000
"""Requests that may come in a burst."""
MOST_KNOWN = 1000
"""Addresses that are remembered: a flood of them must not fill memory."""


class RateLimit:
    """A bucket of requests for each address, filled at an even pace.

    Args:
        per_second, at_once: See :data:`PER_SECOND` and :data:`AT_ONCE`.
        now: A clock, s.
    """

    def __init__(
        self,
        per_second: float = PER_SECOND,
        at_once: float = AT_ONCE,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._per_second, self._at_once, self._now = per_second, at_once, now
        self._left: OrderedDict[str, tuple[float, float]] = OrderedDict()
        self._lock = threading.Lock()

    def takes(self, who: str) -> bool:
        """Whether a further request of this address is answered."""
        now = self._now()
        with self._lock:
            left, last = self._left.pop(who, (self._at_once, now))
            left = min(self._at_once, left + (now - last) * self._per_second)
            taken = left >= 1.0
            self._left[who] = (left - 1.0 if taken else left, now)
            while len(self._left) > MOST_KNOWN:
                self._left.popitem(last=False)
        return taken
