"""From a camera's name to the camera."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

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
    opener = OPENERS.get(kind)
    camera = opener(spec, rest, settings) if opener else None
    if camera is None:
        raise ConfigurationError(
            f"There is no camera called {without_secrets(settings.spec)!r}; use {NAMES}."
        )
    return camera


def _usb(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    number = rest.isdecimal() and len(rest) <= 3
    if not (number or rest.startswith("/")):
        return None
    which = int(rest) if number else rest
    latency = _latency(settings, USB_LATENCY)
    return FreeRunning("usb", lambda: UsbSource(which, settings, latency))


def _rtsp(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if not _is_address(rest):
        return None
    latency = _latency(settings, RTSP_LATENCY)
    return FreeRunning("rtsp", lambda: RtspSource(spec, latency))


def _http(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if not _is_address(rest):
        return None
    latency = _latency(settings, HTTP_LATENCY)
    return FreeRunning("http", lambda: HttpSource(spec, latency))


def _robot(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if not rest.startswith(("http://", "https://")):
        return None
    latency = _latency(settings, HTTP_LATENCY)
    url = f"{rest.rstrip('/')}/camera/picture"
    return FreeRunning("robot", lambda: HttpSource(url, latency, robot=True))


def _folder(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    return FolderCamera(Path(rest).expanduser()) if rest else None


def _video(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if not rest:
        return None
    return FreeRunning("video", lambda: VideoSource(Path(rest).expanduser()))


def _pattern(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if spec != "pattern":
        return None
    from .pattern import PatternSource

    return FreeRunning("pattern", lambda: PatternSource(settings.fps))


def _simulated(spec: str, rest: str, settings: CameraSettings) -> Camera | None:
    if spec != "simulated":
        return None
    from ...simulation import SimulatedCamera

    return SimulatedCamera()


Opener = Callable[[str, str, CameraSettings], "Camera | None"]
OPENERS: Mapping[str, Opener] = {
    "usb": _usb,
    "http": _http,
    "https": _http,
    "rtsp": _rtsp,
    "rtsps": _rtsp,
    "folder": _folder,
    "video": _video,
    "robot": _robot,
    "pattern": _pattern,
    "simulated": _simulated,
}
"""By what stands before the first colon: opens from the whole name and what follows that colon;
``None`` where it makes no sense."""


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


def _is_address(rest: str) -> bool:
    return rest.startswith("//") and len(rest) > 2
