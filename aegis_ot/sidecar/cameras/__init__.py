"""Cameras by name: ``usb:0``, ``http://...``, ``folder:PATH``, ``pattern``, ``simulated``."""

from .freerunning import FreeRunning, Health, Raw, Source
from .registry import camera_health, open_camera

__all__ = ["FreeRunning", "Health", "Raw", "Source", "camera_health", "open_camera"]
