"""What the robot has to say that needs no camera: kept in order until the sidecar takes it."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from ..errors import SidecarRefused
from ..http_client import SLICE_S
from .sidecar_client import RunUnknown, SidecarClient

REQUEST_S = 2.0
"""Longest wait for an answer that needs no camera, s."""


class Outbox:
    """Messages of one run, for people's eyes.

    Args:
        link: To the sidecar.
        run: Identifier of the run.
        register: Says, until a moment of ``time.monotonic`` (s), which run this is, to a sidecar
            that does not know it.

    Attributes:
        run: May change when it registers.
    """

    def __init__(self, link: SidecarClient, run: str, register: Callable[[float], None]) -> None:
        self._link = link
        self.run = run
        self._register = register
        self._messages: deque[Callable[[float], None]] = deque()

    def abandon(self, number: int, reason: str) -> None:
        """A trajectory is given up."""
        self.report(f"trajectories/{number}/abandon", {"reason": reason})

    def report(self, what: str, body: Mapping[str, Any]) -> None:
        """A report of :meth:`.SidecarClient.report`."""
        self._messages.append(lambda most: self._link.report(self.run, what, body, most))

    def flush(self, deadline: float) -> None:
        """Send what there is until a moment of ``time.monotonic``, s; the rest stays.

        Raises:
            LinkError: One was not taken; one that was refused is dropped.
        """
        while self._messages and (left := deadline - time.monotonic()) > 0:
            try:
                self._messages[0](min(left, REQUEST_S))
            except RunUnknown:
                self._register(deadline)
                self._messages[0](max(SLICE_S, deadline - time.monotonic()))
            except SidecarRefused:
                pass  # it never will be taken, and what comes after it need not wait
            self._messages.popleft()
