"""How the camera's view is: for aiming and focusing it, and for ``aegis-ot doctor``."""

from __future__ import annotations

import base64
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np

from ..errors import AegisError, CameraError
from ..run_view.pictures import whole_frame
from ..vision.camera import Camera, Frame
from ..vision.detection import load_detector
from ..vision.types import Detector, Image
from .cameras import BoundCameras, FreeRunning
from .config import SidecarConfig

_DARK, _BLOWN = 16, 250
"""Grey values that hold no detail, of 255."""
_TOO_DARK, _TOO_BRIGHT = 0.15, 0.85
"""Mean brightness, 0 to 1."""
_MOST_LOST = 0.35
"""Share of the picture that may be black, or white."""
_SOFT = 25.0
"""Sharpness of a 640x480 webcam view that is clearly out of focus (simulated and real frames of
the data sets: in focus from about 60 up)."""
_LEAST_TIP = 60
"""A tip shorter than this many pixels cannot be measured."""


@dataclass(frozen=True)
class AimedFrame:
    """One frame, measured.

    Attributes:
        frame: As the camera gave it.
        tip: Box x, y, w, h of the tip, px; ``None`` if none was found.
        confidence: Of the detection, 0 to 1.
        sharpness: Variance of the Laplacian, of the tip where one was found.
        brightness: Mean, 0 to 1.
        dark, blown: Share of pixels without detail.
        advice: What to do, one sentence each; ``["Good."]`` if nothing.
    """

    frame: Frame
    tip: tuple[float, float, float, float] | None
    confidence: float
    sharpness: float
    brightness: float
    dark: float
    blown: float
    advice: list[str] = field(default_factory=list)

    def to_json(self) -> dict[str, object]:
        """With the picture as an address that holds it."""
        height, width = self.frame.image.shape[:2]
        return {
            "picture": "data:image/jpeg;base64," + base64.b64encode(self.frame.jpeg).decode(),
            "width": width,
            "height": height,
            "tip": None if self.tip is None else [round(value, 1) for value in self.tip],
            "confidence": round(self.confidence, 3),
            "sharpness": round(self.sharpness, 1),
            "brightness": round(self.brightness, 3),
            "dark": round(self.dark, 4),
            "blown": round(self.blown, 4),
            "advice": self.advice,
        }


class Aim:
    """Looks through a camera, or through one of several.

    Args:
        config: Names the detector, and how long a frame may take.
        camera: Where frames come from.
        last: The last frame of a run; shown of cameras that only show what a run announces.
    """

    def __init__(
        self, config: SidecarConfig, camera: Camera, last: Callable[[], Frame | None]
    ) -> None:
        self._config = config
        several = camera.each if isinstance(camera, BoundCameras) else [(camera.kind, camera)]
        self.names = [name for name, _ in several]
        self._cameras = [one for _, one in several]
        self._last = last
        self._looking = threading.Lock()
        self._detector: Detector | None = None

    def look(self, number: int = 0) -> AimedFrame:
        """A fresh frame, measured; several askers take turns.

        Raises:
            CameraError: It gives no frame.
            ModelError: The detector cannot be loaded.
        """
        with self._looking:
            frame = self._frame(number)
            if self._detector is None:
                self._detector = load_detector(self._config.cascade.detector or "default")
            return measure(frame, self._detector)

    def picture(self) -> bytes | None:
        """What the first camera sees now, small, as JPEG; ``None`` where it gives nothing."""
        try:
            return whole_frame(self._frame(0, wait_s=1.0).image).jpeg
        except AegisError:
            return None

    def _frame(self, number: int, wait_s: float | None = None) -> Frame:
        camera = self._cameras[number]
        # One that shows what runs announce has nothing of its own to show.
        last = None if isinstance(camera, FreeRunning) else self._last()
        try:
            return last or camera.frame_after(
                time.monotonic(), wait_s or self._config.camera.timeout_s
            )
        except AegisError:
            raise
        except Exception as error:  # whatever a driver raises
            raise CameraError(f"The camera failed: {type(error).__name__}: {error}") from error


def measure(frame: Frame, detector: Detector) -> AimedFrame:
    """Sharpness, light and tip of one frame."""
    image = frame.image
    found = detector.detect(image)
    grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    box = None if found is None else (found.x, found.y, found.w, found.h)
    view = AimedFrame(
        frame,
        box,
        0.0 if found is None else float(found.confidence),
        sharpness(grey, box),
        float(grey.mean()) / 255,
        float(np.mean(grey < _DARK)),
        float(np.mean(grey > _BLOWN)),
    )
    view.advice.extend(_advice(view) or ["Good."])
    return view


def sharpness(grey: Image, box: tuple[float, ...] | None) -> float:
    """Variance of the Laplacian, of the part in a box (x, y, w, h, px) where there is one."""
    if box is not None:
        x, y, w, h = (round(value) for value in box)
        part = grey[max(y, 0) : y + h, max(x, 0) : x + w]
        grey = part if part.size > 64 else grey
    return float(cv2.Laplacian(grey, cv2.CV_64F).var())


def _advice(view: AimedFrame) -> list[str]:
    said = []
    height, width = view.frame.image.shape[:2]
    if view.brightness < _TOO_DARK or view.dark > 1 - _MOST_LOST:
        said.append("The picture is dark: add light, take off a cap, or lengthen the exposure.")
    elif view.brightness > _TOO_BRIGHT or view.blown > _MOST_LOST:
        said.append("The picture is blown out: shorten the exposure, or dim the light.")
    if view.sharpness < _SOFT:
        said.append("The picture is soft: focus on the tip.")
    if view.tip is None:
        said.append("No tip is found: put one on the pipette and bring it into the view.")
        return said
    x, y, w, h = view.tip
    if h < _LEAST_TIP:
        said.append("The tip is small: bring the camera nearer.")
    if x < 2 or y < 2 or x + w > width - 2 or y + h > height - 2:
        said.append("The tip reaches the edge of the picture: move the camera.")
    return said
