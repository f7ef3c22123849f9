"""A pause of the watch, on the sidecar's page: told there, and answered from there."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable

from ..errors import LinkError, RobotError
from ..runtime.keyframe_sender import KeyframeSender

_EVERY_S = 0.5
_DOES = {"resume": "play", "retry": "retry", "stop": "stop"}


class PagePauses:
    """The pauses of one watched run.

    Args:
        sender: Speaks to the sidecar.
        act: Has the robot ``"play"`` or ``"stop"`` the run, or ``"retry"`` a step that failed; may
            raise RobotError.
    """

    def __init__(self, sender: KeyframeSender, act: Callable[[str], object]) -> None:
        self._sender = sender
        self._act = act
        self._number: int | None = None
        self._began = self._heard = 0.0
        self._answered: Callable[[float, str], None] = lambda paused_s, where: None
        self._next = 0.0
        self._on_page = False

    def begin(self, trajectory: int, why: str = "verdict", text: str = "") -> None:
        """The robot was paused: because of a delivery, because a person said so
        (``"operator"``), or because a step failed (``"recovery"``)."""
        if why == "recovery":  # the robot waits for something else now
            self.is_over()
        self._number, self._began, self._on_page = trajectory, time.monotonic(), False
        self._heard = self._began
        self._answered = self._sender.report_hold(trajectory, 0.0, why, "pause", text)

    def look_around(self) -> None:
        """Do what a person said on the page, twice a second at most."""
        if self._number is None or self._on_page or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + _EVERY_S
        with contextlib.suppress(LinkError, RobotError):
            asked = time.monotonic()
            action = self._sender.action(self._number, asked - self._heard)
            if action in _DOES:
                self._heard = asked  # what it was told so far counts once
                self._act(_DOES[action])
                self._on_page = action != "retry"  # which may fail once more

    def is_over(self) -> None:
        """The run goes on, or has ended: tell how long it was paused, and where it was answered."""
        if self._number is None:
            return
        self._number = None
        self._answered(time.monotonic() - self._began, "page" if self._on_page else "robot")
