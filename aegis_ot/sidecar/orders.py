"""What people tell a robot from the page: to pause or stop while it moves, to resume or stop while
it is paused."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from ..run_view.overview import ActionEntry, HoldEntry
from .wire import Action, OrderRequest, WireError

Told = dict[str, Any]


class Orders:
    """The orders and answers of one run. The caller sees to it that threads take turns.

    A stop is a stop: it holds for a robot that moves and for one that is paused, whichever pause it
    was told at, and nothing that is told later takes it back.

    Attributes:
        pending: An order that the robot has not taken up: ``action``, ``by``, ``note``, ``at``.
    """

    def __init__(self, actions: Sequence[ActionEntry], holds: Sequence[HoldEntry]) -> None:
        self.pending: Told | None = None
        self._answers: dict[int, tuple[float, Told]] = {}
        now, monotonic = time.time(), time.monotonic()
        for told in actions:
            if told["action"] != "pause":
                ago = max(0.0, now - told["at"])
                self._answers[told["trajectory"]] = monotonic - ago, _words(told)
        held = max((hold["at"] for hold in holds), default=0.0)
        stop = next((told for told in actions if told["action"] == "stop"), None)
        last = actions[-1] if actions else None
        if stop is None and last and last["action"] == "pause" and last["at"] > held:
            stop = last
        if stop is not None:
            self.pending = _words(stop) | {"at": stop["at"]}

    def require_going_on(self, told: Action | OrderRequest) -> None:
        """A run that is to end is told nothing else.

        Raises:
            WireError: 409, with who has stopped it.
        """
        if self._ending and told.action != "stop":
            assert self.pending is not None
            raise WireError(
                409,
                "stopped",
                f"{self.pending['by']} told the robot to end this run, and that stands.",
                "If it still moves, press stop on its own screen.",
            )

    def order(self, order: OrderRequest, at: float) -> None:
        """A robot that moves is to do this; the last order counts, a stop for good."""
        if not self._ending:
            self.pending = order.model_dump() | {"at": at}

    def taken(self) -> None:
        """The robot is paused, as it was told."""
        if not self._ending:
            self.pending = None

    def answer(self, trajectory: int, action: Action, at: float) -> None:
        """A robot that is paused at this trajectory is to do this. Who presses stop does not ask
        whether the robot is paused there still."""
        self._answers[trajectory] = time.monotonic(), action.model_dump()
        if action.action == "stop":
            self.order(OrderRequest(action="stop", by=action.by, note=action.note), at)

    def answered(self, trajectory: int, within_s: float | None) -> Told | None:
        """The last answer at this trajectory, unless it is older: then it was to another pause.
        A stop is never too old."""
        if self._ending:
            assert self.pending is not None
            return _words(self.pending)
        at, told = self._answers.get(trajectory, (0.0, None))
        if told is None or (within_s is not None and time.monotonic() - at > within_s):
            return None
        return told

    @property
    def _ending(self) -> bool:
        return self.pending is not None and self.pending["action"] == "stop"


def _words(told: Mapping[str, Any]) -> Told:
    return {name: told[name] for name in ("action", "by", "note")}
