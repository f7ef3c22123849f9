"""Cameras that OpenCV opens: USB by number or path, RTSP streams, video files."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from ...errors import CameraError
from ...vision.types import Image
from ...vocabulary import without_secrets
from ..config import CameraSettings
from .raw import Raw

_MANUAL, _AUTOMATIC = 1, 3
"""What V4L2 calls the two modes of exposure."""

_SETTLE_FRAMES = 45
"""Frames after which automatic exposure, white balance and focus have settled."""

_LOCKS: tuple[tuple[str, int, int, int], ...] = (
    ("exposure", cv2.CAP_PROP_AUTO_EXPOSURE, _MANUAL, cv2.CAP_PROP_EXPOSURE),
    ("white_balance", cv2.CAP_PROP_AUTO_WB, 0, cv2.CAP_PROP_WB_TEMPERATURE),
    ("focus", cv2.CAP_PROP_AUTOFOCUS, 0, cv2.CAP_PROP_FOCUS),
)
"""Setting, what switches its automatic off, the value for that, and what it is set by."""


def quiet_opencv() -> None:
    """Its own lines about a camera that is not there say nothing that ours do not."""
    cv2.setLogLevel(0)
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")


class UsbSource:
    """One USB camera.

    OpenCV does not tell when a frame was exposed. It is taken to have begun ``latency`` seconds
    before the frame arrived, which errs towards a later frame, never an earlier one.

    Exposure, white balance and focus are set to what the settings say, or, with ``lock``, kept at
    what the camera itself had settled on after a second or two. A driver that knows none of them
    leaves them as they are.

    Args:
        which: Number of the device, or its path, as ``/dev/v4l/by-id/...``, which stays the same
            when cameras are plugged in elsewhere.
        settings: Size and rate to ask for, and what to lock.
        latency: Longest time from the start of an exposure to the frame's arrival, s.

    Raises:
        CameraError: There is no such device, or it is in use.
    """

    def __init__(self, which: int | str, settings: CameraSettings, latency: float) -> None:
        self._name = f"USB camera {which}"
        self._latency = latency
        self._settings = settings
        self._frames = 0
        self._device = _opened(
            _device(which),
            cv2.CAP_V4L2 if sys.platform == "linux" else cv2.CAP_ANY,
            f"{self._name} cannot be opened: not plugged in, or used by another program.",
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
        for name, automatic, off, prop in _LOCKS:
            value = getattr(settings, name)
            if value is not None:
                self._device.set(automatic, off)
                self._device.set(prop, value)

    def read(self) -> Raw:
        """The next frame. Raises CameraError when the device is gone."""
        image = _frame(self._device, f"{self._name} stopped sending frames.")
        arrived = time.monotonic()
        self._frames += 1
        if self._settings.lock and self._frames == _SETTLE_FRAMES:
            self._keep()
        return Raw(arrived - self._latency, image=image)

    def close(self) -> None:
        """Give the device back."""
        self._device.release()

    def _keep(self) -> None:
        """Hold what the camera's automatic has found."""
        for name, automatic, off, prop in _LOCKS:
            if getattr(self._settings, name) is None:
                found = self._device.get(prop)
                self._device.set(automatic, off)
                if found > 0:
                    self._device.set(prop, found)


class RtspSource:
    """A network camera's RTSP stream.

    Args:
        url: ``rtsp://`` or ``rtsps://``, with user name and password if need be; they are never
            shown.
        latency: Longest time from the start of an exposure to the frame's arrival, s.

    Raises:
        CameraError: It cannot be reached, or sends no video.
    """

    def __init__(self, url: str, latency: float) -> None:
        self._shown = without_secrets(url)
        self._latency = latency
        self._device = _opened(
            url, cv2.CAP_FFMPEG, f"{self._shown} cannot be reached, or sends no video."
        )
        self._device.set(cv2.CAP_PROP_BUFFERSIZE, 1)

    def read(self) -> Raw:
        """The next frame. Raises CameraError when the stream ends."""
        image = _frame(self._device, f"{self._shown} ended the stream.")
        return Raw(time.monotonic() - self._latency, image=image)

    def close(self) -> None:
        """End the connection."""
        self._device.release()


class VideoSource:
    """A video file, for trying a set-up again: played at its own rate, over and over.

    Args:
        path: The file.

    Raises:
        CameraError: It cannot be read.
    """

    def __init__(self, path: Path) -> None:
        self._name = path.name
        self._device = _opened(str(path), cv2.CAP_ANY, f"The video {path} cannot be read.")
        rate = self._device.get(cv2.CAP_PROP_FPS)
        self._period = 1.0 / rate if 0 < rate <= 240 else 1 / 30
        self._due = time.monotonic()

    def read(self) -> Raw:
        """The next frame, when it is due. Raises CameraError at the video's end."""
        image = _frame(self._device, f"The video {self._name} is over.")
        self._due += self._period
        time.sleep(max(0.0, self._due - time.monotonic()))
        return Raw(self._due, image=image)

    def close(self) -> None:
        """Close the file."""
        self._device.release()


def _device(which: int | str) -> int | str:
    """OpenCV's V4L2 opens numbers and ``/dev/videoN``: a link is followed to one."""
    return which if isinstance(which, int) else str(Path(which).resolve())


def _opened(what: int | str, backend: int, trouble: str) -> Any:
    quiet_opencv()
    device = cv2.VideoCapture(what, backend)
    if not device.isOpened():
        device.release()
        raise CameraError(trouble)
    return device


def _frame(device: Any, trouble: str) -> Image:
    ok, image = device.read()
    if not ok or image is None:
        raise CameraError(trouble)
    return np.asarray(image, dtype=np.uint8)
