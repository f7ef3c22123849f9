"""What people tell a robot from the page: to pause or stop while it moves, to resume or stop while
it is paused."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from .wire import Action, Order

Told = dict[str, Any]


class Orders:
    """The orders and answers of one run. The caller sees to it that threads take turns.

    Args:
        actions: What was told before a restart, oldest first.
        holds: What the robot did.

    Attributes:
        pending: An order that the robot has not taken up: ``action``, ``by``, ``note``, ``at``.
    """

    def __init__(self, actions: Sequence[Told], holds: Sequence[Told]) -> None:
        self.pending: Told | None = None
        self._answers: dict[int, tuple[float, Told]] = {}
        now, monotonic = time.time(), time.monotonic()
        for told in actions:
            said = {name: told[name] for name in ("action", "by", "note")}
            if told["action"] != "pause":
                ago = max(0.0, now - told["at"])
                self._answers[told["trajectory"]] = monotonic - ago, said
        held = max((hold["at"] for hold in holds), default=0.0)
        if actions and actions[-1]["action"] != "resume" and actions[-1]["at"] > held:
            last = actions[-1]
            self.pending = {name: last[name] for name in ("action", "by", "note", "at")}

    def order(self, order: Order) -> None:
        """A robot that moves is to do this; the last order counts."""
        self.pending = order.model_dump() | {"at": time.time()}

    def taken(self) -> None:
        """The robot does it."""
        self.pending = None

    def answer(self, trajectory: int, action: Action) -> None:
        """A robot that is paused at this trajectory is to do this."""
        self._answers[trajectory] = time.monotonic(), action.model_dump()

    def answered(self, trajectory: int, within_s: float | None) -> Told | None:
        """The last answer at this trajectory, unless it is older: then it was to another pause."""
        at, told = self._answers.get(trajectory, (0.0, None))
        if told is None or (within_s is not None and time.monotonic() - at > within_s):
            return None
        return told
