"""A pause of the watch, on the sidecar's page: told there, and answered from there."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable

from ..errors import LinkError, RobotError
from ..runtime.courier import Courier

_EVERY_S = 0.5
_DOES = {"resume": "play", "stop": "stop"}


class PagePauses:
    """The pauses of one watched run.

    Args:
        courier: Speaks to the sidecar.
        act: Has the robot ``"play"`` or ``"stop"`` the run; may raise RobotError.
    """

    def __init__(self, courier: Courier, act: Callable[[str], object]) -> None:
        self._courier = courier
        self._act = act
        self._number: int | None = None
        self._began = 0.0
        self._answered: Callable[[float, str], None] = lambda paused_s, where: None
        self._next = 0.0
        self._on_page = False

    def begin(self, trajectory: int, why: str = "verdict") -> None:
        """The robot was paused: because of a delivery, or because a person said so
        (``"operator"``)."""
        self._number, self._began, self._on_page = trajectory, time.monotonic(), False
        self._answered = self._courier.report_hold(trajectory, 0.0, why, "pause")

    def look_around(self) -> None:
        """Do what a person said on the page, twice a second at most."""
        if self._number is None or self._on_page or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + _EVERY_S
        with contextlib.suppress(LinkError, RobotError):
            action = self._courier.action(self._number, time.monotonic() - self._began)
            if action in _DOES:
                self._act(_DOES[action])
                self._on_page = True

    def is_over(self) -> None:
        """The run goes on, or has ended: tell how long it was paused, and where it was answered."""
        if self._number is None:
            return
        self._number = None
        self._answered(time.monotonic() - self._began, "page" if self._on_page else "robot")
