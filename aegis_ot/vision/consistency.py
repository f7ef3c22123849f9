"""Detections of one run put right by what cannot change within it.

A detector takes a shaft for a tip now and then, or a meniscus for a collar. Two facts of a run
speak against it: one kind of tip before one camera keeps its length, a few per cent of
perspective aside, and TRANSIT and POST_DISPENSE show the same tip above the same well.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace

import cv2
import numpy as np

from ..vocabulary import KeyframeKind
from .types import Image, TipDetection

FREE = (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
"""Keyframes in which the tip hangs free above its destination."""

_ENOUGH = 3
"""Agreeing trajectories from which the run's tip is known."""

_MEMORY = 24
_SAME_LENGTH = 0.12
"""Lengths in one run differ by less than this, as a fraction."""

_MATCH = 0.6
"""Correlation from which the collar of one free frame is found again in the other."""

_FAINT = 0.2
"""Confidence of a faint tip that another frame confirms; a bare shaft stays below (0.19 at most
on rendered frames)."""

_REACH = 0.35
"""The free tip's orifice stays within this many tip lengths, up or down, of its usual height."""


class TipConsistency:
    """What the tip of one run looks like, learned from detections that agree with each other."""

    def __init__(self) -> None:
        self._lengths: deque[float] = deque(maxlen=_MEMORY)
        self._heights: deque[float] = deque(maxlen=_MEMORY)

    def settle(
        self,
        detections: Mapping[KeyframeKind, TipDetection | None],
        frames: Mapping[KeyframeKind, Image],
    ) -> dict[KeyframeKind, TipDetection | None]:
        """Detections as they can be: implausible ones mended by their partner, or dropped.

        A tip that only one of the free frames shows is not put into the other: it may have
        fallen off.
        """
        settled = dict(detections)
        if self._known:
            for kind, found in detections.items():
                if found is not None and not self._plausible(found, free=kind in FREE):
                    settled[kind] = None
        pair = {kind: found for kind in FREE if (found := detections.get(kind)) is not None}
        if len(pair) < len(FREE):
            return settled
        before, after = (pair[kind] for kind in FREE)
        if abs(before.length / after.length - 1.0) <= _SAME_LENGTH:
            if all(settled[kind] is not None for kind in FREE):
                self._learn(before, after)
            return settled
        good, bad = sorted(FREE, key=lambda kind: self._strangeness(pair[kind]))
        if settled[good] is not None and all(kind in frames for kind in FREE):
            settled[bad] = find_again(pair[good], frames[good], frames[bad])
        return settled

    @property
    def _known(self) -> bool:
        return len(self._lengths) >= _ENOUGH

    def _plausible(self, found: TipDetection, free: bool) -> bool:
        usual = float(np.median(self._lengths))
        if abs(found.length / usual - 1.0) > _SAME_LENGTH:
            # Labware hides part of a tip in a well; only there may it look shorter.
            return not free and found.length < usual
        height = float(np.median(self._heights))
        return not free or abs(found.orifice[1] - height) <= _REACH * usual

    def _strangeness(self, found: TipDetection) -> float:
        if not self._known:
            return -found.confidence
        return abs(found.length / float(np.median(self._lengths)) - 1.0)

    def _learn(self, *found: TipDetection) -> None:
        self._lengths.append(float(np.mean([one.length for one in found])))
        self._heights.append(float(np.mean([one.orifice[1] for one in found])))


def second_look(
    guess: Callable[[Image], TipDetection | None],
    detections: Mapping[KeyframeKind, TipDetection | None],
    frames: Mapping[KeyframeKind, Image],
) -> dict[KeyframeKind, TipDetection]:
    """Faint tips to believe in the free frames: two that show the same one confirm each other.

    Args:
        guess: The likeliest tip in a frame, however faint.
        detections: What the detector was sure of.
        frames: The frames.
    """
    missing = [kind for kind in FREE if kind in frames and detections.get(kind) is None]
    guesses = {kind: guess(frames[kind]) for kind in missing}
    found: dict[KeyframeKind, TipDetection] = {}
    for kind, other in (FREE, FREE[::-1]):
        if kind not in missing:
            continue
        faint, partner = guesses[kind], detections.get(other) or guesses.get(other)
        sure = partner is not None and partner.confidence >= _FAINT
        if faint is not None and partner is not None and sure and confirms(faint, partner, _FAINT):
            found[kind] = faint
    return found


def confirms(guess: TipDetection | None, partner: TipDetection, least: float) -> bool:
    """Whether a detection below the detector's threshold is believable beside its partner.

    Args:
        guess: The likeliest tip in one free frame.
        partner: The tip in the other free frame of the same trajectory.
        least: Confidence below which nothing is believed; above any bare shaft's.
    """
    return (
        guess is not None
        and guess.confidence >= least
        and abs(guess.length / partner.length - 1.0) <= _SAME_LENGTH
        and abs(guess.orifice[1] - partner.orifice[1]) <= _REACH * partner.length
    )


def find_again(tip: TipDetection, here: Image, there: Image) -> TipDetection | None:
    """The tip of one frame in another in which it hangs at about the same place.

    The collar and the shaft's end above it look the same whatever the tip holds; their place in
    the other frame gives the shift.

    Args:
        tip: Detection in ``here``.
        here, there: The frames.
    """
    length = tip.length
    x, y = tip.collar
    left, right = int(x - 0.12 * length), int(x + 0.12 * length) + 1
    upper, lower = int(y - 0.15 * length), int(y + 0.2 * length) + 1
    reach = int(0.3 * length)
    height, width = here.shape[:2]
    if left < 0 or upper < 0 or right > width or lower > height or right - left < 4:
        return None
    template = cv2.cvtColor(here[upper:lower, left:right], cv2.COLOR_BGR2GRAY)
    top, start = max(upper - reach, 0), max(left - reach, 0)
    window = cv2.cvtColor(
        there[top : min(lower + reach, height), start : min(right + reach, width)],
        cv2.COLOR_BGR2GRAY,
    )
    scores = cv2.matchTemplate(window, template, cv2.TM_CCOEFF_NORMED)
    _, best, _, at = cv2.minMaxLoc(scores)
    if best < _MATCH:
        return None
    dx, dy = start + at[0] - left, top + at[1] - upper
    return replace(
        tip,
        x=tip.x + dx,
        y=tip.y + dy,
        orifice=(tip.orifice[0] + dx, tip.orifice[1] + dy),
        collar=(x + dx, y + dy),
    )
