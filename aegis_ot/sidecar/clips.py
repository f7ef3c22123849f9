"""The seconds around a bad well as a short video, from the camera's ring of recent frames."""

from __future__ import annotations

import logging
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

import cv2

from ..errors import StoreError
from ..vision.camera import Camera
from ..vision.types import Image
from .cameras import BoundCameras, FreeRunning
from .cameras.codec import decode_jpeg
from .cameras.history import CLIP_EVERY_S
from .cameras.raw import Raw
from .store import Store

log = logging.getLogger(__name__)

AFTER_S = 3.0
"""What is shown of the time after the verdict, s; before it, what the camera's ring holds."""
_WIDTH = 640


class Clips:
    """Keeps a clip with each delivery that people are told of. Safe to use from threads.

    Args:
        camera: Only one that runs by itself has frames to show.
        store: Where clips are kept, beside the frames.
        kept: Called when one was.
    """

    def __init__(self, camera: Camera, store: Store, kept: Callable[[], None]) -> None:
        self._camera = camera
        self._store = store
        self._kept = kept
        self._timers: dict[tuple[str, int], threading.Timer] = {}
        self._lock = threading.Lock()

    def take(self, run: str, trajectory: int) -> None:
        """Something happened at this delivery: keep what led to it, and what follows."""
        source = self._source(run)
        with self._lock:
            if source is None or (run, trajectory) in self._timers:
                return
            timer = threading.Timer(AFTER_S, self._keep, (run, trajectory, source))
            timer.daemon = True
            self._timers[run, trajectory] = timer
            timer.start()

    def close(self) -> None:
        """Take no more. Idempotent."""
        with self._lock:
            for timer in self._timers.values():
                timer.cancel()

    def _source(self, run: str) -> FreeRunning | None:
        camera = (
            self._camera.of_run(run) if isinstance(self._camera, BoundCameras) else self._camera
        )
        return camera if isinstance(camera, FreeRunning) else None

    def _keep(self, run: str, trajectory: int, source: FreeRunning) -> None:
        try:
            video = encode(source.recent())
            if video:
                self._store.keep_clip(run, trajectory, video)
                self._kept()
        except (StoreError, cv2.error) as error:  # a clip is no reason to trouble anybody
            log.warning("No clip of delivery %d of run %s: %s", trajectory, run, error)
        finally:
            with self._lock:
                self._timers.pop((run, trajectory), None)


def encode(frames: Sequence[Raw]) -> bytes:
    """Frames as a WebM video (VP8), which every browser plays; empty without frames."""
    images = [image for raw in frames if (image := _image(raw)) is not None]
    if not images:
        return b""
    height, width = images[0].shape[:2]
    size = (min(width, _WIDTH) // 2 * 2, round(height * min(1.0, _WIDTH / width)) // 2 * 2)
    with tempfile.TemporaryDirectory(prefix="aegis-ot-clip-") as folder:
        path = Path(folder) / "clip.webm"
        code = cv2.VideoWriter.fourcc(*"VP80")
        writer = cv2.VideoWriter(str(path), code, 1 / CLIP_EVERY_S, size)
        if not writer.isOpened():
            return b""  # an OpenCV without this codec
        for image in images:
            writer.write(cv2.resize(image, size, interpolation=cv2.INTER_AREA))
        writer.release()
        return path.read_bytes()


def _image(raw: Raw) -> Image | None:
    if raw.jpeg is None:
        return raw.image
    try:
        return decode_jpeg(raw.jpeg)
    except Exception:  # a spoiled frame among sound ones
        return None
