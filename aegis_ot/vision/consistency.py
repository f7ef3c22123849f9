"""Detections of one run put right by what cannot change within it.

A detector takes a shaft for a tip now and then, or a meniscus for a collar. Two facts of a run
speak against it: one kind of tip before one camera keeps its length, a few per cent of
perspective aside, and TRANSIT and POST_DISPENSE show the same tip above the same well.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace

import cv2
import numpy as np

from ..vocabulary import KeyframeKind
from .types import FREE, Image, TipDetection

_ENOUGH = 3
"""Agreeing trajectories from which the run's tip is known."""

_MEMORY = 24
_SAME_LENGTH = 0.12
"""Lengths in one run differ by less than this, as a fraction."""

_PERSPECTIVE = 0.2
"""The same where both free frames show it: from the first row of a plate to the last a tip comes
nearer to the camera."""

_MATCH = 0.6
"""Correlation from which the collar of one free frame is found again in the other."""

_FAINT = 0.2
"""Confidence of a faint tip that a sure one in another frame confirms. Bare shafts reach 0.41 on
rendered frames, so two faint ones confirm nothing: both may be the same shaft."""

_REACH = 0.35
"""The free tip's orifice stays within this many tip lengths, up or down, of its usual height."""

_SAME_END = 0.15
"""An orifice this close to its usual height, tip lengths, is the tip's: a bare shaft ends most of a
tip higher, and a meniscus that was taken for the collar does not move the other end."""

_CLEARLY = 0.6
"""What looks like a tip less than this times as clearly as the run's tips do is none."""

_EXPOSURE = 1.4
"""A frame this many times brighter or darker than the others shows no tip that they show."""


class TipConsistency:
    """What the tip of one run looks like, learned from detections that agree with each other."""

    def __init__(self) -> None:
        self._lengths: deque[float] = deque(maxlen=_MEMORY)
        self._heights = {kind: deque[float](maxlen=_MEMORY) for kind in FREE}
        self._confidences: deque[float] = deque(maxlen=_MEMORY)

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
        pair = {kind: found for kind in FREE if (found := detections.get(kind)) is not None}
        lengths = [found.length for found in pair.values()]
        agree = len(pair) == len(FREE) and abs(lengths[0] / lengths[1] - 1.0) <= _SAME_LENGTH
        if self._known:
            within, end = (_PERSPECTIVE, _REACH) if agree else (_SAME_LENGTH, _SAME_END)
            for kind, found in detections.items():
                if found is not None and not self._plausible(found, kind, within):
                    settled[kind] = self._collar_mended(found, kind, end)
        if agree and all(settled[kind] is pair[kind] for kind in FREE):
            self._learn(pair)
        if agree or len(pair) < len(FREE):
            return settled
        good, bad = sorted(FREE, key=lambda kind: self._strangeness(pair[kind]))
        if settled[good] is not None and settled[bad] is pair[bad]:
            settled[bad] = None
        if settled[good] is not None and settled[bad] is None and set(FREE) <= set(frames):
            settled[bad] = find_again(pair[good], frames[good], frames[bad])
        return settled

    def recognise(
        self,
        guess: Callable[[Image], TipDetection | None],
        detections: Mapping[KeyframeKind, TipDetection | None],
        frames: Mapping[KeyframeKind, Image],
    ) -> dict[KeyframeKind, TipDetection]:
        """Faint tips in the free frames that are where and as long as this run's tip is.

        Both free frames have to show one, above the same place: something behind a bare shaft
        that looks like it would have to be there twice.

        Args:
            guess: The likeliest tip in a frame, however faint.
            detections: What was found so far.
            frames: The frames.
        """
        if not self._known or any(kind not in frames for kind in FREE):
            return {}
        missing = [kind for kind in FREE if detections.get(kind) is None]
        if not missing:
            return {}
        guesses = {kind: guess(frames[kind]) for kind in missing}
        before, after = (guesses.get(kind) or detections.get(kind) for kind in FREE)
        if before is None or after is None:
            return {}
        aside = abs(before.orifice[0] - after.orifice[0]) / float(np.median(self._lengths))
        faint = {kind: found for kind, found in guesses.items() if found is not None}
        usual = all(
            self._plausible(found, kind) and self._ends_as_usual(found, kind)
            for kind, found in zip(FREE, (before, after), strict=True)
        )
        return faint if usual and aside <= _SAME_END else {}

    def clearly_absent(self, guesses: Collection[TipDetection | None]) -> bool:
        """Whether the likeliest tips of frames without one are clearly fainter than this run's.

        In a view in which the tips themselves are hardly to be seen, not to see one proves nothing.
        """
        if not self._confidences:
            return True
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
        lights = [_light(frames[other]) for other in neighbours if other in frames]
        ratio = (_light(frames[kind]) + 1) / (float(np.median(lights)) + 1) if lights else 1.0
        if not 1 / _EXPOSURE < ratio < _EXPOSURE:
            return True
        clear = len(self._confidences) >= _ENOUGH
        return clear and min(found.confidence for found in shown) >= min(self._confidences)

    @property
    def _known(self) -> bool:
        return len(self._lengths) >= _ENOUGH

    def _plausible(
        self, found: TipDetection, kind: KeyframeKind, within: float = _SAME_LENGTH
    ) -> bool:
        usual = float(np.median(self._lengths))
        if abs(found.length / usual - 1.0) > within:
            # Labware hides part of a tip in a well; only there may it look shorter.
            return kind not in FREE and found.length < usual
        return kind not in FREE or self._off_end(found, kind) <= _REACH

    def _collar_mended(
        self, found: TipDetection, kind: KeyframeKind, end: float
    ) -> TipDetection | None:
        """The tip with its usual length, if its lower end is about where it should be."""
        if kind not in FREE or self._off_end(found, kind) > end:
            return None
        x, y = found.orifice
        share = float(np.median(self._lengths)) / max(found.length, 1.0)
        collar = (x + share * (found.collar[0] - x), y + share * (found.collar[1] - y))
        rise = collar[1] - found.collar[1]
        return replace(found, y=found.y + rise, h=max(found.h - rise, 1.0), collar=collar)

    def _ends_as_usual(self, found: TipDetection, kind: KeyframeKind) -> bool:
        return self._off_end(found, kind) <= _SAME_END

    def _off_end(self, found: TipDetection, kind: KeyframeKind) -> float:
        """How far the orifice is above or below its usual height, tip lengths."""
        usual = float(np.median(self._heights[kind]))
        return abs(found.orifice[1] - usual) / float(np.median(self._lengths))

    def _strangeness(self, found: TipDetection) -> float:
        if not self._known:
            return -found.confidence
        return abs(found.length / float(np.median(self._lengths)) - 1.0)

    def _learn(self, pair: Mapping[KeyframeKind, TipDetection]) -> None:
        self._lengths.append(float(np.mean([one.length for one in pair.values()])))
        for kind, found in pair.items():
            self._heights[kind].append(found.orifice[1])
            self._confidences.append(found.confidence)


def _light(image: Image) -> float:
    return float(np.median(image[::16, ::16]))


def second_look(
    guess: Callable[[Image], TipDetection | None],
    detections: Mapping[KeyframeKind, TipDetection | None],
    frames: Mapping[KeyframeKind, Image],
) -> dict[KeyframeKind, TipDetection]:
    """Faint tips to believe in the free frames: those that the other one surely shows.

    Args:
        guess: The likeliest tip in a frame, however faint.
        detections: What the detector was sure of.
        frames: The frames.
    """
    found: dict[KeyframeKind, TipDetection] = {}
    for kind, other in (FREE, FREE[::-1]):
        partner = detections.get(other)
        if kind in frames and detections.get(kind) is None and partner is not None:
            faint = guess(frames[kind])
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


def once_each(
    guess: Callable[[Image], TipDetection | None],
) -> Callable[[Image], TipDetection | None]:
    """The same, asked once for each frame: it costs as much as finding the tip."""
    known: dict[int, TipDetection | None] = {}

    def remembered(image: Image) -> TipDetection | None:
        if id(image) not in known:
            known[id(image)] = guess(image)
        return known[id(image)]

    return remembered
