"""From a camera's name to the camera."""

from __future__ import annotations

from pathlib import Path
from typing import cast

from ...errors import ConfigurationError
from ...vision.camera import Camera
from ..config import CameraSettings
from .folder import FolderCamera
from .freerunning import FreeRunning, Health

NAMES = "usb:NUMBER, http://ADDRESS, https://ADDRESS, folder:PATH, pattern or simulated"

USB_LATENCY = 0.07
"""Exposure, readout and transfer of a webcam at 30 frames/s: about two frames, s."""
HTTP_LATENCY = 0.2
"""The same with encoding and network, s."""


def open_camera(settings: CameraSettings) -> Camera:
    """Open the camera that ``settings.spec`` names. Free-running ones start by themselves.

    Raises:
        ConfigurationError: No such kind of camera, or its address makes no sense.
        CameraError: A folder without frames.
    """
    spec = settings.spec.strip()
    kind, _, rest = spec.partition(":")
    if kind == "usb" and rest.isdecimal() and len(rest) <= 3:
        from .usb import UsbSource

        latency = USB_LATENCY if settings.latency_s is None else settings.latency_s
        return FreeRunning("usb", lambda: UsbSource(int(rest), settings, latency))
    if kind in ("http", "https") and rest.startswith("//") and len(rest) > 2:
        from .http import HttpSource

        latency = HTTP_LATENCY if settings.latency_s is None else settings.latency_s
        return FreeRunning("http", lambda: HttpSource(spec, latency))
    if kind == "folder" and rest:
        return FolderCamera(Path(rest).expanduser())
    if spec == "pattern":
        from .pattern import PatternSource

        return FreeRunning("pattern", lambda: PatternSource(settings.fps))
    if spec == "simulated":
        return _simulated()
    raise ConfigurationError(f"There is no camera called {settings.spec!r}; use {NAMES}.")


def camera_health(camera: Camera) -> Health:
    """What the camera says of itself; one that says nothing is taken to be well."""
    health = getattr(camera, "health", None)
    return cast(Health, health()) if callable(health) else Health(True)


def _simulated() -> Camera:
    from ... import simulation

    make = getattr(simulation, "SimulatedCamera", None)
    if make is None:
        raise ConfigurationError("This installation has no simulated camera.")
    return cast(Camera, make())
