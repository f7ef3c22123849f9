"""Frames of the last seconds, for runs whose moments are told of after they are over."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from .codec import encode_jpeg

if TYPE_CHECKING:
    from .freerunning import Raw

HISTORY_S = 12.0
"""How far back a moment may lie, s. At 30 frames/s and 200 kB each that is 70 MB."""


class History:
    """Keeps every frame for ``HISTORY_S``, encoded: a decoded one takes 6 MB."""

    def __init__(self) -> None:
        self._frames: deque[Raw] = deque()

    def __iter__(self) -> Iterator[Raw]:
        return iter(self._frames)

    def put(self, raw: Raw) -> None:
        """The newest frame; those that are too old go."""
        if raw.jpeg is None and raw.image is not None:
            raw = replace(raw, jpeg=encode_jpeg(raw.image), image=None)
        self._frames.append(raw)
        while self._frames[0].exposed_at < raw.exposed_at - HISTORY_S:
            self._frames.popleft()
