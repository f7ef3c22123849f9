"""What can be wrong with a camera's view, in words for the operator."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class TroubleKind(str, Enum):
    """Why a view tells nothing about a well."""

    FROZEN = "frozen"
    DARK = "dark"
    COVERED = "covered"
    BLOWN_OUT = "blown_out"
    BLURRED = "blurred"
    MISAIMED = "misaimed"


_SAID = {
    TroubleKind.FROZEN: (
        "The camera's picture stands still although the robot moved: it repeats an old frame, or "
        "looks past the robot. Unplug it and plug it in again, or restart the stream."
    ),
    TroubleKind.DARK: (
        "The camera's picture is dark: its lens is covered, or the light is off. Uncover it, or "
        "switch the light on."
    ),
    TroubleKind.COVERED: (
        "The camera's picture shows nothing but a plain surface: something covers the lens, or it "
        "looks at a wall. Clear its view of the pipette."
    ),
    TroubleKind.BLOWN_OUT: (
        "The camera's picture is far too bright, and no tip can be seen in it: turn the lamp away, "
        "or lower the camera's exposure."
    ),
    TroubleKind.BLURRED: (
        "The camera's picture is blurred: focus it on the tip, and clean its lens."
    ),
    TroubleKind.MISAIMED: (
        "The camera's view has changed and no tip is in it: it was turned or moved, or something "
        "stands before it. Aim it at the tip again."
    ),
}

_NEVER_SEEN = (
    "No tip is in the camera's picture, in the source or above the destination: it is not aimed at "
    "the pipette, or no tip is on it. Aim the camera so that the whole tip can be seen."
)


@dataclass(frozen=True)
class ViewTrouble:
    """A view that tells nothing.

    Attributes:
        kind: What it is.
        message: What is wrong and what to do, for the operator.
    """

    kind: TroubleKind
    message: str

    @classmethod
    def of(cls, kind: TroubleKind) -> ViewTrouble:
        """In the usual words."""
        return cls(kind, _SAID[kind])

    @classmethod
    def never_seen(cls) -> ViewTrouble:
        """No tip was in view since the run began."""
        return cls(TroubleKind.MISAIMED, _NEVER_SEEN)
