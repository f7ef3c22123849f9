"""Cameras by name: USB, RTSP, HTTP, folder, video, the robot's own, a test pattern, simulated.

Door: :func:`open_camera` for one, :func:`open_cameras` for all that the settings name.
"""

from .bound import BoundCameras
from .freerunning import FreeRunning, Health
from .health import camera_health
from .registry import open_camera, open_cameras

__all__ = [
    "BoundCameras",
    "FreeRunning",
    "Health",
    "camera_health",
    "open_camera",
    "open_cameras",
]
