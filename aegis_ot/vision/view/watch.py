"""Whether a run's camera shows what it is there to show: asked for each frame before it counts.

A view that tells nothing must never become a verdict: a black picture is no missing tip, and a
picture that repeats itself is no row of good wells. So each frame is looked at as it is captured,
before the robot is told that it may go on.
"""

from __future__ import annotations

from collections import deque

import numpy as np

from ...vocabulary import Keyframe, KeyframeKind
from ..types import FREE, Detector, Image
from .measures import Blocks, ViewMeasures, measure_view
from .troubles import TroubleKind, ViewTrouble

_DARK = 24.0
"""A frame whose brightest parts are darker than this shows nothing, grey levels."""

_PLAIN = 8.0
"""A frame whose contrast is less than this shows nothing, grey levels. Views of a robot have 40."""

_WHITE, _TOO_WHITE = 0.9, 0.3
"""Share of white from which a frame shows nothing; and from which it may hide the tip."""

_BLURRED = 4.0
"""Edges wider than this show no meniscus, px of a frame of 480 lines. Sharp views have 1."""

_BLURRED_SINCE, _BLURRED_TIMES = 2.5, 2.0
"""Edges so wide, px, and so many times as wide as they were in this run, are out of focus."""

_MOVED_MM = 10.0
"""A tip that was moved so far is seen to have moved. Two exposures are never the same to the last
bit, so a picture that is stands still, however little the tip moved."""

_STILL = 2.5
"""Blocks that change by less than this are the sensor's noise, grey levels."""

_STILL_TWICE = 2
"""Moves that such a picture does not show, until it is believed to stand still."""

_ALIKE_WITHIN, _ALIKE_SHARE = 8.0, 0.85
"""A view is the same if so many of its blocks are the same within so many grey levels: a pipette, a
tip rack and a plate more or less are less than that."""

_EXPOSURE = 1.4
"""A frame so many times brighter or darker than the one before cannot be compared with it."""

_REFERENCE = 8
"""Latest good frames that tell what the view is."""


class ViewWatch:
    """Watches the view of one camera in one run.

    What needs the detector is asked of it only while no tip was seen yet, and where the view
    looks unlike what it was: the robot stands still meanwhile.

    Args:
        detector: Finds the tip.
    """

    def __init__(self, detector: Detector) -> None:
        self._detector = detector
        self._good: deque[Blocks] = deque(maxlen=_REFERENCE)
        self._before: Blocks | None = None
        self._edges: deque[float] = deque(maxlen=_REFERENCE)
        self._last: Keyframe | None = None
        self._still = 0
        self._tip_seen = False
        self._strange = False

    def look(self, keyframe: Keyframe, image: Image, *, again: bool = False) -> ViewTrouble | None:
        """What is wrong with the view at this keyframe, if anything.

        Only a frame in which nothing is wrong changes what is known of the view, so that the same
        keyframe may be tried again.

        Args:
            keyframe: Which moment the frame shows.
            image: The frame.
            again: Whether another frame can be had at once; then one that is merely exposed
                unlike those before is refused too.
        """
        seen = measure_view(image)
        kind = self._in_itself(seen) or self._against_time(keyframe, seen)
        if kind is None and again and self._good:
            light = float(np.median(seen.blocks)), float(np.median(self._good[-1]))
            if not 1 / _EXPOSURE < (light[0] + 1) / (light[1] + 1) < _EXPOSURE:
                kind = TroubleKind.BLOWN_OUT if light[0] > light[1] else TroubleKind.DARK
        if kind is not None:
            return ViewTrouble.of(kind)
        return self._aim(keyframe, seen, image)

    def _in_itself(self, seen: ViewMeasures) -> TroubleKind | None:
        """What one frame alone shows."""
        if seen.brightest < _DARK:
            return TroubleKind.DARK
        if seen.clipped > _WHITE:
            return TroubleKind.BLOWN_OUT
        if seen.contrast < _PLAIN:
            return TroubleKind.COVERED
        usual = float(np.median(self._edges)) if self._edges else np.inf
        since = seen.edge_px > max(_BLURRED_SINCE, _BLURRED_TIMES * usual)
        return TroubleKind.BLURRED if since or seen.edge_px > _BLURRED else None

    def _against_time(self, keyframe: Keyframe, seen: ViewMeasures) -> TroubleKind | None:
        """What only a picture that stands still shows: nothing moves though the robot did."""
        before = self._before
        if before is None:
            return None
        if np.array_equal(before, seen.blocks):
            return TroubleKind.FROZEN
        if keyframe.late or not self._moved(keyframe) or _change(before, seen.blocks) >= _STILL:
            return None
        return TroubleKind.FROZEN if self._still + 1 >= _STILL_TWICE else None

    def _aim(self, keyframe: Keyframe, seen: ViewMeasures, image: Image) -> ViewTrouble | None:
        """Whether the tip is in view, where that is in doubt."""
        strange = bool(self._good) and not self._alike(seen.blocks)
        white = seen.clipped > _TOO_WHITE
        if self._tip_seen and not strange and not white:
            self._accept(keyframe, seen, strange=False)
            return None
        if self._detector.detect(image) is not None:
            self._tip_seen = True
            if strange:
                self._good.clear()
            self._accept(keyframe, seen, strange=False)
            return None
        free = keyframe.kind in FREE and not keyframe.late
        # Labware may hide a tip that is in a well; not twice in a row.
        hidden = not free and not self._strange
        if white and not hidden:
            return ViewTrouble.of(TroubleKind.BLOWN_OUT)
        if not self._tip_seen and free:
            return ViewTrouble.never_seen()
        if self._tip_seen and not hidden:
            return ViewTrouble.of(TroubleKind.MISAIMED)
        self._accept(keyframe, seen, strange=strange or white)
        return None

    def _accept(self, keyframe: Keyframe, seen: ViewMeasures, *, strange: bool) -> None:
        if not keyframe.late:
            if self._before is not None and self._moved(keyframe):
                still = _change(self._before, seen.blocks) < _STILL
                self._still = self._still + 1 if still else 0
            self._last = keyframe
        self._before, self._strange = seen.blocks, strange
        if not strange:
            self._good.append(seen.blocks)
            self._edges.append(seen.edge_px)

    def _moved(self, keyframe: Keyframe) -> bool:
        """Whether the tip stands elsewhere than at the keyframe before."""
        last = self._last
        if last is None or last.mount != keyframe.mount:
            return False
        if last.position is not None and keyframe.position is not None:
            return float(np.linalg.norm(np.subtract(last.position, keyframe.position))) > _MOVED_MM
        between = last.kind is KeyframeKind.ASPIRATE and keyframe.kind is KeyframeKind.TRANSIT
        return between and not set(keyframe.sources) & set(keyframe.destinations)

    def _alike(self, blocks: Blocks) -> bool:
        usual = np.median(np.stack(self._good), axis=0)
        return float((_difference(usual, blocks) < _ALIKE_WITHIN).mean()) >= _ALIKE_SHARE


def _difference(before: Blocks, now: Blocks) -> Blocks:
    """Of two frames, block by block, whatever their exposure, grey levels."""
    if before.shape != now.shape:
        return np.full_like(now, 255.0)
    gain = float(np.median((before + 1.0) / (now + 1.0)))
    return np.abs(before - gain * now)


def _change(before: Blocks, now: Blocks) -> float:
    """How much the parts of the picture that changed most changed, grey levels."""
    return float(np.percentile(_difference(before, now), 99.5))
