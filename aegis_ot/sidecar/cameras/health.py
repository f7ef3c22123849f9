"""What a camera says of itself."""

from __future__ import annotations

from typing import cast

from ...vision.camera import Camera
from .freerunning import Health


def camera_health(camera: Camera) -> Health:
    """What the camera says of itself; one that says nothing is taken to be well."""
    health = getattr(camera, "health", None)
    return cast(Health, health()) if callable(health) else Health(True)
