"""Several cameras, each bound to a robot and a mount."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Sequence
from dataclasses import dataclass

from ...errors import CameraError
from ...vision.camera import Camera, Frame
from ...vocabulary import Keyframe
from .freerunning import FreeRunning, Health
from .health import camera_health


@dataclass(frozen=True)
class Bound:
    """One camera of several.

    Attributes:
        camera: It.
        name: As the settings name it: its address.
        robot: Name of the robot that it looks at; empty: any.
        mount: ``"left"`` or ``"right"``; empty: both.
    """

    camera: Camera
    name: str
    robot: str = ""
    mount: str = ""

    def fits(self, robot: str, mount: str) -> bool:
        """Whether it looks at this mount of this robot."""
        return self.robot in ("", robot) and self.mount in ("", mount)


class BoundCameras:
    """Takes each keyframe with the camera that looks at its pipette.

    Args:
        cameras: At least one. The one that is bound most closely is taken.
    """

    kind = "several"

    def __init__(self, cameras: Sequence[Bound]) -> None:
        # Those that name robot and mount come before those that take whatever comes.
        self._cameras = sorted(cameras, key=lambda one: -bool(one.robot) - bool(one.mount))
        self._robots: dict[str, str] = {}
        self._locks: dict[int, contextlib.AbstractContextManager[object]] = {
            id(one.camera): contextlib.nullcontext()
            if isinstance(one.camera, FreeRunning)
            else threading.Lock()
            for one in cameras
        }
        self._chosen = threading.local()

    @property
    def each(self) -> list[tuple[str, Camera]]:
        """Name and camera, for who looks through one of them."""
        return [(bound.name, bound.camera) for bound in self._cameras]

    def meet(self, run: str, robot: str) -> None:
        """A run is one of the robot of this name."""
        self._robots[run] = robot

    def of_run(self, run: str) -> Camera | None:
        """The first camera that looks at the robot of this run."""
        robot = self._robots.get(run, "")
        return next((one.camera for one in self._cameras if one.robot in ("", robot)), None)

    def announce(self, keyframe: Keyframe) -> None:
        """Choose the camera for this thread's next frame."""
        robot = self._robots.get(keyframe.run, "")
        fitting = (one for one in self._cameras if one.fits(robot, keyframe.mount))
        self._chosen.bound = next(fitting, None)
        self._chosen.missing = f"the {keyframe.mount} mount of {robot or 'a robot without a name'}"
        self._chosen.keyframe = keyframe

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """A frame of the camera chosen by :meth:`announce`; before that, of the first one.

        Raises:
            CameraError: No camera looks at this pipette, or it gives no frame.
        """
        keyframe: Keyframe | None = getattr(self._chosen, "keyframe", None)
        bound: Bound | None = self._cameras[0] if keyframe is None else self._chosen.bound
        if bound is None:
            raise CameraError(
                f"No camera is bound to {self._chosen.missing}. Name one in the sidecar's settings."
            )
        with self._locks[id(bound.camera)]:
            if keyframe is not None:
                bound.camera.announce(keyframe)
            try:
                return bound.camera.frame_after(moment, timeout)
            except CameraError as error:
                raise CameraError(f"Camera {bound.name}: {error}") from error

    def health(self) -> Health:
        """Whether all of them are well; else which is not."""
        for bound in self._cameras:
            health = camera_health(bound.camera)
            if not health.ok:
                return Health(False, f"Camera {bound.name}: {health.detail}")
        return Health(True)

    def remember(self) -> None:
        """Keep frames for moments that are told of late (watch mode)."""
        for bound in self._cameras:
            if isinstance(bound.camera, FreeRunning):
                bound.camera.remember()

    def close(self) -> None:
        """Give all devices back. Idempotent."""
        for bound in self._cameras:
            bound.camera.close()
