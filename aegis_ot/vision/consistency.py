"""What the frames of one trajectory say of each other's tip: it is one tip, and hangs in one place.

TRANSIT and POST_DISPENSE show the same tip above the same well, so a faint one in the one is
believed beside a sure one in the other; and tips fall off and do not come back.
"""

from __future__ import annotations

import functools
from collections import deque
from collections.abc import Callable, Collection, Mapping

import numpy as np

from ..vocabulary import KeyframeKind
from .types import FREE, Detector, GuessingDetector, Image, TipDetection

Guess = Callable[[KeyframeKind], TipDetection | None]
"""The likeliest tip in one frame of a trajectory, however faint."""

_ENOUGH = 3
"""Sightings that agree from which it is known how clearly a run's tips are seen."""

_MEMORY = 24
_SAME_LENGTH = 0.12
"""Lengths of one tip in two frames differ by less than this, as a fraction."""

_FAINT = 0.2
"""Confidence of a faint tip that a sure one in another frame confirms. Bare shafts reach 0.41 on
rendered frames, so two faint ones confirm nothing: both may be the same shaft."""

_REACH = 0.35
"""The free tip's orifice is as high in both frames, within this many tip lengths."""

_SAME_END = 0.15
"""An end this close to its known place, tip lengths, is the tip's: a bare shaft ends most of a tip
higher."""

_CLEARLY = 0.6
"""What looks like a tip less than this times as clearly as the run's tips do is none."""

_EXPOSURE = 1.4
"""A frame this many times brighter or darker than the others shows no tip that they show."""


class TipConsistency:
    """How clearly the tips of one run are seen, learned from detections that agree."""

    def __init__(self) -> None:
        self._confidences: deque[float] = deque(maxlen=_MEMORY)

    def note(self, detections: Mapping[KeyframeKind, TipDetection | None]) -> None:
        """Learn from a trajectory, if both free frames show a tip of one length."""
        pair = [found for kind in FREE if (found := detections.get(kind)) is not None]
        if len(pair) == len(FREE) and _as_long(*pair):
            self._confidences.extend(found.confidence for found in pair)

    def clearly_absent(self, guesses: Collection[TipDetection | None]) -> bool:
        """Whether the likeliest tips of frames without one are clearly fainter than this run's.

        In a view in which the tips themselves are hardly to be seen, not to see one proves nothing;
        nor before one was seen at all: the camera may not see where they hang.
        """
        if not self._confidences:
            return False
        limit = _CLEARLY * float(np.median(self._confidences))
        return all(guess is None or guess.confidence < limit for guess in guesses)

    def excuses(
        self,
        kind: KeyframeKind,
        detections: Mapping[KeyframeKind, TipDetection | None],
        frames: Mapping[KeyframeKind, Image],
    ) -> bool:
        """Whether a tip that was not found in one frame is on the pipette all the same.

        It is if a later frame shows it, for tips fall off and do not come back. It is if the
        two other frames above the destination show it, and this one is exposed otherwise than
        they are, or they show it as clearly as this run's tips are seen.
        """
        order = list(KeyframeKind)
        if any(detections.get(later) is not None for later in order[order.index(kind) + 1 :]):
            return True
        neighbours = [other for other in order if other not in (kind, KeyframeKind.ASPIRATE)]
        shown = [found for other in neighbours if (found := detections.get(other)) is not None]
        if len(shown) < len(neighbours) or kind not in frames:
            return False
        if not self.lit_alike(kind, frames):
            return True
        clear = len(self._confidences) >= _ENOUGH
        return clear and min(found.confidence for found in shown) >= min(self._confidences)

    def lit_alike(self, kind: KeyframeKind, frames: Mapping[KeyframeKind, Image]) -> bool:
        """Whether a frame is about as bright as the others above the destination."""
        neighbours = [other for other in frames if other not in (kind, KeyframeKind.ASPIRATE)]
        lights = [_light(frames[other]) for other in neighbours]
        ratio = (_light(frames[kind]) + 1) / (float(np.median(lights)) + 1) if lights else 1.0
        return 1 / _EXPOSURE < ratio < _EXPOSURE


def _light(image: Image) -> float:
    return float(np.median(image[::16, ::16]))


def guesses_in(detector: Detector, frames: Mapping[KeyframeKind, Image]) -> Guess | None:
    """The likeliest tip in each frame, however faint; looked for once: it costs as much as finding
    the tip. ``None`` where the detector cannot say."""
    if not isinstance(detector, GuessingDetector):
        return None
    look = detector.best_guess
    return functools.cache(lambda kind: look(frames[kind]) if kind in frames else None)


def second_look(
    guess: Guess, detections: Mapping[KeyframeKind, TipDetection | None]
) -> dict[KeyframeKind, TipDetection]:
    """Faint tips to believe in the free frames: those that the other one surely shows.

    Args:
        guess: See :func:`guesses_in`.
        detections: What the detector was sure of.
    """
    found: dict[KeyframeKind, TipDetection] = {}
    for kind, other in (FREE, FREE[::-1]):
        partner = detections.get(other)
        if detections.get(kind) is None and partner is not None:
            faint = guess(kind)
            if faint is not None and confirms(faint, partner, _FAINT):
                found[kind] = faint
    return found


def confirms(guess: TipDetection | None, partner: TipDetection, least: float) -> bool:
    """Whether a detection below the detector's threshold is believable beside its partner.

    Args:
        guess: The likeliest tip in one free frame.
        partner: The tip in the other free frame of the same trajectory.
        least: Confidence below which nothing is believed.
    """
    return (
        guess is not None
        and guess.confidence >= least
        and _as_long(guess, partner)
        and abs(guess.orifice[1] - partner.orifice[1]) <= _REACH * partner.length
    )


def stands_at(found: TipDetection, there: TipDetection) -> bool:
    """Whether a tip that was found stands where one is known to."""
    ends = ((found.orifice, there.orifice), (found.collar, there.collar))
    return all(np.hypot(a[0] - b[0], a[1] - b[1]) <= _SAME_END * there.length for a, b in ends)


def _as_long(one: TipDetection, other: TipDetection) -> bool:
    return abs(one.length / other.length - 1.0) <= _SAME_LENGTH
