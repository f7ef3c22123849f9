"""Frames of the last seconds, for runs whose moments are told of after they are over."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

from .raw import Raw

HISTORY_S = 12.0
"""How far back a moment may lie, s. At 30 frames/s and 200 kB each that is 70 MB."""


CLIP_EVERY_S = 0.2
"""From one frame of a clip to the next, s: 12 s take some 12 MB."""


class History:
    """Keeps frames for ``HISTORY_S``, encoded: a decoded one takes 6 MB.

    Args:
        every_s: Least time from one to the next, s; what comes between is passed over.
    """

    def __init__(self, every_s: float = 0.0) -> None:
        self._every_s = every_s
        self._frames: deque[Raw] = deque()

    def wants(self, raw: Raw) -> bool:
        """Whether it is time for another frame."""
        return not self._frames or raw.exposed_at - self._frames[-1].exposed_at >= self._every_s

    def __iter__(self) -> Iterator[Raw]:
        return iter(self._frames)

    def put(self, raw: Raw) -> None:
        """The newest frame; those that are too old go."""
        self._frames.append(raw.encoded())
        while self._frames[0].exposed_at < raw.exposed_at - HISTORY_S:
            self._frames.popleft()
