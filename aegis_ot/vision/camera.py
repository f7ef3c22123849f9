"""What every camera offers: the next frame exposed after a moment.

Real cameras run freely into a ring buffer (``aegis_ot.sidecar``); the simulated one renders
what the simulated pipette would show (``aegis_ot.simulation``).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from ..vocabulary import Keyframe

if TYPE_CHECKING:
    from .types import Image


@dataclass(frozen=True)
class Frame:
    """One camera frame.

    Attributes:
        jpeg: The encoded frame, as it is stored.
        image: The decoded frame.
        exposed_at: When its exposure began, on the workstation's ``time.monotonic`` clock, s.
        simulated: Whether it is drawn or replayed: it shows nothing of what the robot did.
    """

    jpeg: bytes
    image: Image
    exposed_at: float
    simulated: bool = False


SIMULATED_KINDS = frozenset({"simulated", "pattern", "folder", "video"})
"""Kinds of cameras whose frames are drawn or replayed: no figure on them is a real one."""


class Camera(Protocol):
    """A source of frames."""

    kind: str
    """Short name for health reports: ``"usb"``, ``"http"``, ``"simulated"``, ``"folder"``."""

    def announce(self, keyframe: Keyframe) -> None:
        """A keyframe is about to be captured. Real cameras have no use for it."""

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """The first frame whose exposure began at or after ``moment`` (``time.monotonic``, s).

        Raises:
            CameraError: No such frame within ``timeout`` seconds, or it cannot be decoded.
        """

    def close(self) -> None:
        """Give the device back. Idempotent."""
