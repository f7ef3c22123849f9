"""Takes the frame of a keyframe, makes sure that it tells something, and tells when none does."""

from __future__ import annotations

import contextlib
import logging
import math
import threading
import time
from typing import Any

from ..errors import AegisError, CameraError
from ..vision.camera import Camera, Frame
from ..vision.view import ViewWatch
from ..vocabulary import Keyframe
from .alerts import Alerts, Notice
from .cameras import BoundCameras, FreeRunning, Health, camera_health

log = logging.getLogger(__name__)


class Grabber:
    """One camera as all runs use it.

    Args:
        camera: Where frames come from.
        timeout_s: Longest wait for a frame, s.
        alerts: Told when the camera gives no frame that tells anything, and when it does again.

    Attributes:
        last: The last frame that counted.
    """

    def __init__(self, camera: Camera, timeout_s: float, alerts: Alerts) -> None:
        self.last: Frame | None = None
        self._camera = camera
        self._timeout_s = timeout_s
        self._alerts = alerts
        self._said = ""
        self._in_trouble: set[str] = set()
        # A camera that is told what to show must not hear of another keyframe in between.
        # One that runs by itself serves everyone at once.
        self._lock: contextlib.AbstractContextManager[Any] = (
            contextlib.nullcontext()
            if isinstance(camera, (FreeRunning, BoundCameras))
            else threading.Lock()
        )

    def health(self) -> Health:
        """How the camera is, by its own word and by the last capture."""
        health = camera_health(self._camera)
        if health.ok and self._said:
            return Health(False, self._said)
        return health

    def grab(
        self, keyframe: Keyframe, moment: float, view: ViewWatch | None, until: float = math.inf
    ) -> Frame:
        """The first frame exposed at or after a moment that tells something.

        Args:
            keyframe: What it is for.
            moment: ``time.monotonic``, s.
            view: Looks at each frame; ``None``: every one counts.
            until: How long the robot surely stands still, ``time.monotonic``, s.

        Raises:
            CameraError: There is none in time.
        """
        try:
            with self._lock:
                self._camera.announce(keyframe)
                frame = self._usable(keyframe, moment, view, until)
        except Exception as error:
            if not isinstance(error, AegisError):
                log.exception("The camera failed")
                error = CameraError(f"The camera failed: {type(error).__name__}: {error}")
            self._said = str(error)
            self._in_trouble.add(keyframe.run)
            self._alerts.tell(
                Notice(
                    keyframe.run,
                    "camera",
                    "the camera gives no frame that tells anything",
                    str(error),
                )
            )
            raise error from None
        self._said = ""
        self.last = frame
        if keyframe.run in self._in_trouble:
            self._in_trouble.discard(keyframe.run)
            self._alerts.over(keyframe.run, "camera")
        return frame

    def _usable(
        self, keyframe: Keyframe, moment: float, view: ViewWatch | None, until: float
    ) -> Frame:
        """A frame that tells something; a second one is taken before that is given up."""
        trouble = None
        for again in (True, False):
            frame = self._camera.frame_after(moment, self._timeout_s)
            _check_frame(frame, moment)
            if frame.exposed_at > until:
                raise CameraError(
                    f"The camera's frame came {frame.exposed_at - until:.2f} s after the robot may "
                    "have gone on: it is too slow."
                )
            trouble = None if view is None else view.look(keyframe, frame.image, again=again)
            if trouble is None:
                return frame
            moment = frame.exposed_at + 1e-6
        raise CameraError("" if trouble is None else trouble.message)


def _check_frame(frame: Frame, moment: float) -> None:
    if not frame.jpeg or frame.image.ndim != 3:
        raise CameraError("The camera gave an empty frame.")
    if frame.exposed_at < moment:
        age = time.monotonic() - frame.exposed_at
        raise CameraError(f"The camera gave an old frame, exposed {age:.2f} s ago.")
