"""A camera that never stops: a thread fills a ring buffer, keyframes pick from it."""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from ...errors import CameraError
from ...vision.camera import SIMULATED_KINDS, Frame
from ...vocabulary import Keyframe
from .history import CLIP_EVERY_S, History
from .raw import Raw

log = logging.getLogger(__name__)

RING = 16
"""Frames kept. A keyframe takes the first one after it, so a few are enough."""
FIRST_PAUSE = 0.25
LONGEST_PAUSE = 5.0
STALE = 5.0
"""A camera that gave nothing for so long is not well, s."""


class Source(Protocol):
    """An open device. Used by one thread."""

    def read(self) -> Raw:
        """The next frame, as soon as there is one. Raises CameraError when the device is gone."""

    def close(self) -> None:
        """Give the device back."""


@dataclass(frozen=True)
class Health:
    """How a camera is: ``detail`` says what is wrong, in one sentence."""

    ok: bool
    detail: str = ""


class FreeRunning:
    """A :class:`~aegis_ot.vision.camera.Camera` over a source that runs by itself.

    A source that fails is opened again, after 0.25 s, 0.5 s ... 5 s.

    Args:
        kind: Short name for health reports.
        open_source: Opens the device; may raise CameraError.
    """

    def __init__(self, kind: str, open_source: Callable[[], Source]) -> None:
        self.kind = kind
        self.undecodable = 0
        """Frames that were wanted and could not be decoded."""
        self._open_source = open_source
        self._ring: deque[Raw] = deque(maxlen=RING)
        self._history: History | None = None
        self._recent = History(CLIP_EVERY_S)
        self._news = threading.Condition()
        self._closed = threading.Event()
        self._trouble = ""
        self._last_frame: float | None = None
        self._thread = threading.Thread(target=self._run, name=f"camera-{kind}", daemon=True)
        self._thread.start()

    def announce(self, keyframe: Keyframe) -> None:
        """A real camera has no use for it."""

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """The first decodable frame whose exposure began at or after ``moment``.

        Raises:
            CameraError: None came in time, saying whether the camera is gone, silent, or sends
                frames that cannot be decoded.
        """
        deadline = time.monotonic() + timeout
        tried = moment
        first = True
        spoiled = 0
        while (raw := self._next(tried, first, deadline)) is not None:
            try:
                return replace(raw.finished(), simulated=self.kind in SIMULATED_KINDS)
            except CameraError as error:
                log.warning("Camera %s: %s", self.kind, error)
                self.undecodable += 1
                spoiled += 1
                tried, first = raw.exposed_at, False
        raise CameraError(self._why_not(timeout, spoiled))

    def remember(self) -> None:
        """From now on keep frames for moments that are told of late (watch mode)."""
        with self._news:
            self._history = self._history or History()

    def recent(self) -> list[Raw]:
        """The last seconds, a few frames each, for a clip."""
        with self._news:
            return list(self._recent)

    def health(self) -> Health:
        """Whether frames are coming."""
        with self._news:
            if self._closed.is_set():
                return Health(False, "The camera is closed.")
            if self._trouble:
                return Health(False, self._trouble)
            if self._last_frame is None:
                return Health(False, "The camera has not sent a frame yet.")
            silent = time.monotonic() - self._last_frame
        if silent > STALE:
            return Health(False, f"The camera has sent nothing for {silent:.0f} s.")
        return Health(True, f"{self.undecodable} undecodable frames" if self.undecodable else "")

    def close(self) -> None:
        """Stop the thread and give the device back. Idempotent."""
        self._closed.set()
        with self._news:
            self._news.notify_all()
        # A device that hangs in its driver must not keep the sidecar from ending.
        self._thread.join(1.0)

    def _next(self, moment: float, inclusive: bool, deadline: float) -> Raw | None:
        with self._news:
            while not self._closed.is_set():
                for raw in self._history or self._ring:
                    if raw.exposed_at > moment or (inclusive and raw.exposed_at == moment):
                        return raw
                left = deadline - time.monotonic()
                if left <= 0:
                    return None
                self._news.wait(left)
        return None

    def _why_not(self, timeout: float, spoiled: int) -> str:
        if spoiled:
            return (
                f"The {self.kind} camera sent {spoiled} frames after the trigger, "
                "but none could be decoded."
            )
        if self._closed.is_set():
            return "The camera is closed."
        if self._trouble:
            return f"The {self.kind} camera gave no frame: {self._trouble}"
        said = f"The {self.kind} camera gave no frame within {timeout:g} s of the trigger"
        if self.health().ok:
            # Pictures come, but none was surely exposed after the trigger.
            return f"{said} that is surely of a later moment: see what aegis-ot doctor says of it."
        return f"{said}."

    def _run(self) -> None:
        pause = FIRST_PAUSE
        while not self._closed.is_set():
            source: Source | None = None
            try:
                source = self._open_source()
                while not self._closed.is_set():
                    raw = source.read()
                    pause = FIRST_PAUSE
                    self._put(raw)
            except Exception as error:
                # Whatever the driver raises, the camera must come back by itself.
                self._fail(error)
            finally:
                if source is not None:
                    source.close()
            self._closed.wait(pause)
            pause = min(2 * pause, LONGEST_PAUSE)

    def _put(self, raw: Raw) -> None:
        # Encoded before anybody has to wait for it; this thread alone puts frames in.
        kept = raw.encoded() if self._recent.wants(raw) else None
        with self._news:
            self._ring.append(raw)
            if kept is not None:
                self._recent.put(kept)
            if self._history is not None:
                self._history.put(raw)
            self._last_frame = time.monotonic()
            self._trouble = ""
            self._news.notify_all()

    def _fail(self, error: Exception) -> None:
        text = str(error) or type(error).__name__
        with self._news:
            if text != self._trouble:
                log.warning("Camera %s: %s", self.kind, text)
            self._trouble = text
