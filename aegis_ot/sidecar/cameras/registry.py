"""From a camera's name to the camera."""

from __future__ import annotations

from pathlib import Path
from typing import cast

from ...errors import AegisError, ConfigurationError
from ...vision.camera import Camera
from ...vocabulary import without_secrets
from ..config import CameraSettings, SidecarConfig
from .bound import Bound, BoundCameras
from .capture import RtspSource, UsbSource, VideoSource
from .folder import FolderCamera
from .freerunning import FreeRunning
from .http import HttpSource

NAMES = (
    "usb:NUMBER, usb:/dev/PATH, http://ADDRESS, https://ADDRESS, rtsp://ADDRESS, folder:PATH, "
    "video:PATH, robot:http://ADDRESS, pattern or simulated"
)

USB_LATENCY = 0.07
"""Exposure, readout and transfer of a webcam at 30 frames/s: about two frames, s."""
HTTP_LATENCY = 0.2
"""The same with encoding and network, s."""
RTSP_LATENCY = 0.5
"""The same with a video encoder's own delay, s."""


def open_camera(settings: CameraSettings) -> Camera:
    """Open the camera that ``settings.spec`` names. Free-running ones start by themselves.

    Raises:
        ConfigurationError: No such kind of camera, or its address makes no sense.
        CameraError: A folder without frames.
    """
    spec = settings.spec.strip()
    kind, _, rest = spec.partition(":")
    address = rest.startswith("//") and len(rest) > 2
    number = kind == "usb" and rest.isdecimal() and len(rest) <= 3
    if number or (kind == "usb" and rest.startswith("/")):
        which = int(rest) if number else rest
        latency = _latency(settings, USB_LATENCY)
        return FreeRunning("usb", lambda: UsbSource(which, settings, latency))
    if kind in ("rtsp", "rtsps") and address:
        latency = _latency(settings, RTSP_LATENCY)
        return FreeRunning("rtsp", lambda: RtspSource(spec, latency))
    if kind in ("http", "https") and address:
        latency = _latency(settings, HTTP_LATENCY)
        return FreeRunning("http", lambda: HttpSource(spec, latency))
    if kind == "robot" and rest.startswith(("http://", "https://")):
        latency = _latency(settings, HTTP_LATENCY)
        url = f"{rest.rstrip('/')}/camera/picture"
        return FreeRunning("robot", lambda: HttpSource(url, latency, robot=True))
    if kind == "folder" and rest:
        return FolderCamera(Path(rest).expanduser())
    if kind == "video" and rest:
        return FreeRunning("video", lambda: VideoSource(Path(rest).expanduser()))
    if spec == "pattern":
        from .pattern import PatternSource

        return FreeRunning("pattern", lambda: PatternSource(settings.fps))
    if spec == "simulated":
        return _simulated()
    raise ConfigurationError(
        f"There is no camera called {without_secrets(settings.spec)!r}; use {NAMES}."
    )


def open_cameras(config: SidecarConfig) -> Camera:
    """The one camera of the settings, or all those that are bound to robots and mounts.

    Raises:
        ConfigurationError, CameraError: As :func:`open_camera`.
    """
    if not config.cameras:
        return open_camera(config.camera)
    opened: list[Bound] = []
    try:
        for one in config.cameras:
            opened.append(Bound(open_camera(one), without_secrets(one.spec), one.robot, one.mount))
    except AegisError:
        for bound in opened:
            bound.camera.close()
        raise
    return BoundCameras(opened)


def _latency(settings: CameraSettings, usual: float) -> float:
    return usual if settings.latency_s is None else settings.latency_s


def _simulated() -> Camera:
    from ... import simulation

    make = getattr(simulation, "SimulatedCamera", None)
    if make is None:
        raise ConfigurationError("This installation has no simulated camera.")
    return cast(Camera, make())
