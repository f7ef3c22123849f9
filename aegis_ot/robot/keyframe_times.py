"""When the four keyframes of an unguarded run were: read from the times of its commands.

The robot does not stand still for them. An aspirate or a dispense is one command with its travel;
where TRANSIT and POST_DISPENSE lie within it, or within the next, is reckoned.
"""

from __future__ import annotations

import time
import uuid
from dataclasses import replace

from ..runtime import SidecarClient
from ..runtime.sidecar_client import Acknowledgement
from ..vocabulary import Keyframe, KeyframeKind
from .server_answers import Command

DESCENT_S = 0.2
"""From the top of a well to where it is dispensed, about, s."""
RISE_S = 0.2
"""From there to the top again, about, s."""
REACH_S = 11.0
"""A moment that is longer ago is lost: the sidecar keeps frames for 12 s."""


def moment_before(kind: KeyframeKind, last_completed: float) -> float:
    """Of a keyframe that was due when the last command was over, s on the robot's clock."""
    return last_completed + (RISE_S if kind is KeyframeKind.POST_DISPENSE else 0.0)


def moment_of_transit(command: Command) -> float | None:
    """When the tip was above the well into which ``command`` delivers, s on the robot's clock."""
    if command.completed is None:
        return None
    volume, rate = command.params.get("volume"), command.params.get("flowRate")
    plunger = float(volume) / float(rate) if volume and rate else 0.0
    moment = command.completed - plunger - DESCENT_S
    return moment if command.started is None else max(moment, command.started)


class PastLink(SidecarClient):
    """To a sidecar that is asked for frames of moments that are over.

    Attributes:
        moments: ``time.monotonic`` by sequence number of a keyframe, s.
        lost: Keyframes whose moment was too long ago.
    """

    def __init__(self, url: str, token: str | None) -> None:
        super().__init__(url, token, lambda: None, uuid.uuid4().hex)
        self.moments: dict[int, float] = {}
        self.lost = 0

    def keyframe(self, keyframe: Keyframe, timeout_s: float, ago_s: float = 0.0) -> Acknowledgement:
        """As in :class:`SidecarClient`; one whose moment is out of reach goes as late."""
        moment = self.moments.get(keyframe.sequence)
        ago = 0.0 if moment is None else time.monotonic() - moment
        if moment is None or not -REACH_S < ago < REACH_S:
            self.lost += not keyframe.late
            return super().keyframe(replace(keyframe, late=True), timeout_s)
        return super().keyframe(keyframe, timeout_s, ago)
