"""A test pattern that runs by itself, for benchmarks and for trying a set-up without a camera."""

from __future__ import annotations

import threading
import time

import numpy as np

from .codec import encode_jpeg
from .raw import Raw

WIDTH, HEIGHT = 640, 480
DISTINCT = 30
EXPOSURE = 0.01
"""What a webcam takes under bench lighting, s."""


class PatternSource:
    """Frames of 640x480 px at a fixed rate, a bar moving through them. Not a pipette.

    A frame is exposed for :data:`EXPOSURE` seconds and handed out at the end of it.
    """

    def __init__(self, fps: float = 30.0) -> None:
        self._period = 1.0 / fps
        self._frames = [_pattern(number) for number in range(DISTINCT)]
        self._number = 0
        self._due = time.monotonic()
        self._stop = threading.Event()

    def read(self) -> Raw:
        """The next frame, when it is due."""
        self._due += self._period
        late = time.monotonic() - self._due
        if late > 1.0:  # the machine slept
            self._due += late
        self._stop.wait(max(0.0, self._due + EXPOSURE - time.monotonic()))
        self._number += 1
        return Raw(self._due, jpeg=self._frames[self._number % DISTINCT])

    def close(self) -> None:
        """Stop waiting."""
        self._stop.set()


def _pattern(number: int) -> bytes:
    rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
    image = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    image[..., 0] = columns * 255 // WIDTH
    image[..., 1] = rows * 255 // HEIGHT
    image[..., 2] = 96
    left = number * (WIDTH // DISTINCT)
    image[:, left : left + WIDTH // DISTINCT] = 255
    return encode_jpeg(image)
