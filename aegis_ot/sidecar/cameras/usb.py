"""A USB camera, through OpenCV."""

from __future__ import annotations

import time

import cv2
import numpy as np

from ...errors import CameraError
from ..config import CameraSettings
from .freerunning import Raw


class UsbSource:
    """One ``cv2.VideoCapture``.

    OpenCV does not tell when a frame was exposed. It is taken to have begun ``latency`` seconds
    before the frame arrived, which errs towards a later frame, never an earlier one.

    Args:
        index: Number of the device.
        settings: Size and rate to ask for.
        latency: Longest time from the start of an exposure to the frame's arrival, s.

    Raises:
        CameraError: There is no such device, or it is in use.
    """

    def __init__(self, index: int, settings: CameraSettings, latency: float) -> None:
        self._index = index
        self._latency = latency
        self._device = cv2.VideoCapture(index)
        if not self._device.isOpened():
            self._device.release()
            raise CameraError(
                f"USB camera {index} cannot be opened: not plugged in, or used by another program."
            )
        wanted = (
            (cv2.CAP_PROP_FRAME_WIDTH, settings.width),
            (cv2.CAP_PROP_FRAME_HEIGHT, settings.height),
            (cv2.CAP_PROP_FPS, settings.fps),
            # Old frames in the driver's queue would only be late.
            (cv2.CAP_PROP_BUFFERSIZE, 1),
        )
        for prop, value in wanted:
            if value is not None:
                self._device.set(prop, value)

    def read(self) -> Raw:
        """The next frame. Raises CameraError when the device is gone."""
        ok, image = self._device.read()
        if not ok or image is None:
            raise CameraError(f"USB camera {self._index} stopped sending frames.")
        return Raw(time.monotonic() - self._latency, image=np.asarray(image, dtype=np.uint8))

    def close(self) -> None:
        """Give the device back."""
        self._device.release()
