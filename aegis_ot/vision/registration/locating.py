"""Find a run's tips by where the robot says they are.

Until the camera is registered the detector searches each frame, and what it finds is learned from.
Afterwards each tip is projected, and the detector only looks at that place: is a tip there, and how
far from where it should be.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np

from ..types import Axis, Detector, Image, Position, TipDetection
from .fitting import fit
from .registered import ProjectedTip, Registration, Sighting

_SURE = 0.05
"""Standard error up to which a projection is trusted, tip lengths."""

_THERE, _ABSENT = 0.4, 0.25
"""Heat of both ends in a close-up of the right place: from the first on a tip is there, below the
second none is. On rendered development sets tips show 0.56 and more, bare nozzles 0.15 at most."""

_LOOK_NOISE = 1 / 240
"""Standard deviation of an end found in a close-up, frame heights: 2 px of 480."""

_FITS = 0.6
"""Share of the ends that must agree with a registration for it to be used."""

_REFIT = (4, 6, 8, 12, 16, 24, 32, 48, 64)
"""Numbers of sightings at which the camera is fitted anew; what is kept is bounded by the last."""

_MOVED = 4.0
"""Distance from the projected place beyond which an end is somewhere else, standard errors."""

_SAME_LENGTH = 0.1
"""What is found elsewhere is such a tip if its length differs by no more than this, as a share."""

_STRAYS = 5
"""So many tips in a row that stand elsewhere, and the camera counts as moved: it is fitted anew."""


@runtime_checkable
class CloseUpDetector(Detector, Protocol):
    """A detector that can look at one place."""

    def look_at(self, image: Image, axis: Axis) -> TipDetection | None:
        """The likeliest tip at a place, however unlikely; its confidence says how likely."""


@dataclass(frozen=True)
class Located:
    """One frame's tip.

    Attributes:
        detection: The tip, ``None`` where there is none.
        expected: Where it was projected; ``None`` where the detector searched the whole frame.
    """

    detection: TipDetection | None
    expected: ProjectedTip | None = None


class TipLocator:
    """Locates the tips of one camera, frame by frame.

    Args:
        detector: Searches frames, and confirms projected places if it is a
            :class:`CloseUpDetector`; else it alone is used.
        registration: Of the same camera from an earlier run; it is checked before it is believed.
    """

    def __init__(self, detector: Detector, registration: Registration | None = None) -> None:
        self._detector = detector
        self._registration = registration
        self._sightings: list[Sighting] = []
        self._strays = 0

    @property
    def registration(self) -> Registration | None:
        """What is known of the camera; ``None`` before there is enough."""
        return self._registration

    def locate(
        self, image: Image, position: Position | None, tip: str, hidden: bool = False
    ) -> Located:
        """The tip in a frame.

        Args:
            image: Whole frame, BGR.
            position: End of the tip on the deck, mm; ``None``: unknown.
            tip: Kind of tip, a name of :data:`~aegis_ot.vision.tips.TIPS`.
            hidden: Whether labware may hide the tip's lower end.
        """
        detector = self._detector
        if position is None or not isinstance(detector, CloseUpDetector):
            return Located(detector.detect(image))
        expected = self._expected(position, tip)
        if expected is None:
            found = detector.detect(image)
            self._note(image, position, tip, hidden, found)
            return Located(found)
        seen = detector.look_at(image, (expected.collar, expected.orifice))
        absent = seen is None or seen.confidence < _ABSENT
        if seen is None or absent or not self._stands_there(image, expected, seen, hidden):
            found = detector.detect(image)
            if found is None or (absent and not _as_long(found, expected)):
                return Located(None, expected)
            # A tip like this one elsewhere: the camera may have been moved.
            self._strays += 1
            self._note(image, position, tip, hidden, found)
            if self._strays >= _STRAYS:
                self._start_again()
            return Located(found)
        self._strays = 0
        self._note(image, position, tip, hidden, seen)
        if seen.confidence < _THERE:
            return Located(detector.detect(image), expected)
        return Located(_fused(expected, seen, hidden, image.shape[0] * _LOOK_NOISE), expected)

    def _expected(self, position: Position, tip: str) -> ProjectedTip | None:
        known = self._registration
        if known is None or known.inliers < _FITS:
            return None
        tip_there = known.project_tip(position, tip)
        if tip_there is None:
            return None
        length = tip_there.px_per_mm * known.lengths_mm[tip]
        return tip_there if tip_there.sigma_px <= _SURE * length else None

    def _stands_there(
        self, image: Image, expected: ProjectedTip, seen: TipDetection, hidden: bool
    ) -> bool:
        noise = float(np.hypot(expected.sigma_px, image.shape[0] * _LOOK_NOISE))
        ends = [(expected.collar, seen.collar)]
        if not hidden:
            ends.append((expected.orifice, seen.orifice))
        return all(_apart(a, b) <= _MOVED * noise for a, b in ends)

    def _note(
        self,
        image: Image,
        position: Position,
        tip: str,
        hidden: bool,
        found: TipDetection | None,
    ) -> None:
        if found is None or len(self._sightings) >= _REFIT[-1]:
            return
        self._sightings.append(Sighting(position, tip, found.orifice, found.collar, hidden))
        if len(self._sightings) in _REFIT:
            height, width = image.shape[:2]
            start = self._registration if len(self._sightings) > _REFIT[3] else None
            fitted = fit(self._sightings, (width, height), start)
            self._registration = fitted or self._registration

    def _start_again(self) -> None:
        del self._sightings[:-_STRAYS]
        self._registration, self._strays = None, 0


def _as_long(found: TipDetection, expected: ProjectedTip) -> bool:
    length = _apart(expected.orifice, expected.collar)
    return abs(found.length / max(length, 1.0) - 1.0) <= _SAME_LENGTH


def _apart(a: Sequence[float], b: Sequence[float]) -> float:
    return float(np.hypot(a[0] - b[0], a[1] - b[1]))


def _fused(
    expected: ProjectedTip, seen: TipDetection, hidden: bool, noise_px: float
) -> TipDetection:
    """The tip where projection and look put it, each by how sure it is."""
    weight = expected.sigma_px**2 / (expected.sigma_px**2 + noise_px**2)
    collar = _between(expected.collar, seen.collar, weight)
    orifice = _between(expected.orifice, seen.orifice, 0.0 if hidden else weight)
    aside, down = collar[0] - seen.collar[0], collar[1] - seen.collar[1]
    return replace(
        seen,
        x=seen.x + aside,
        y=seen.y + down,
        h=max(seen.h + orifice[1] - seen.orifice[1] - down, 1.0),
        orifice=orifice,
        collar=collar,
    )


def _between(a: Sequence[float], b: Sequence[float], weight: float) -> tuple[float, float]:
    return (a[0] + weight * (b[0] - a[0]), a[1] + weight * (b[1] - a[1]))
