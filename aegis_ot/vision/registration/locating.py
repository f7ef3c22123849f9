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

from ..tips import TIPS
from ..types import Axis, Detector, Image, Position, TipDetection
from .ends import Glimpse, seen_again
from .fitting import fit
from .registered import ProjectedTip, Registration, Sighting

_SURE = 0.05
"""Standard error up to which a projection is trusted, tip lengths."""

_THERE = 0.4
"""Heat of both ends in a close-up of the right place from which a tip is there. On rendered
development sets tips show 0.56 and more, bare nozzles 0.15 at most."""

_LOOK_NOISE = 1 / 240
"""Standard deviation of an end found in a close-up, frame heights: 2 px of 480."""

_FITS = 0.6
"""Share of the ends that must agree with a registration for it to be used."""

_TRUE_LENGTH = 0.08
"""Difference of a fitted from the maker's length, as a share, beyond which the pose is doubted, or
the tip is another: the detector works alone."""

_ENOUGH = 8
"""Sightings from which a registration is believed: two wells. One well's places lie so few and so
close that a wrong pose may fit them, and tips that the detector finds would be turned down."""

_REFIT = (8, 12, 16, 24, 32)
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
        self._glimpses: list[Glimpse] = []
        self._strays = 0
        self.times_moved = 0
        """How often the camera was found to stand elsewhere."""

    @property
    def is_registered(self) -> bool:
        """Whether tips are projected, and not searched."""
        known = self._registration
        return known is not None and any(_is_true(known, tip) for tip in known.lengths_mm)

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
        if seen is not None:
            ends = self._ends_there(image, expected, seen, hidden)
            if all(ends) and seen.confidence >= _THERE:
                self._strays = 0
                self._note(image, position, tip, hidden, seen)
                noise = image.shape[0] * _LOOK_NOISE
                return Located(_fused(expected, seen, hidden, noise), expected)
            if any(ends) and seen.confidence >= _THERE:
                # This tip, and one of its ends badly seen.
                return Located(_laid(expected, seen), expected)
        found = detector.detect(image)
        if found is None:
            return Located(None, expected)
        if any(self._ends_there(image, expected, found, hidden)):
            return Located(_laid(expected, found), expected)
        if not _as_long(found, expected):
            return Located(None, expected)
        # A tip like this one elsewhere: the camera may have been moved.
        self._strays += 1
        self._note(image, position, tip, hidden, found)
        if self._strays >= _STRAYS:
            self._start_again()
        return Located(found)

    def _expected(self, position: Position, tip: str) -> ProjectedTip | None:
        known = self._registration
        if known is None or not _is_true(known, tip):
            return None
        tip_there = known.project_tip(position, tip)
        if tip_there is None:
            return None
        length = tip_there.px_per_mm * known.lengths_mm[tip]
        return tip_there if tip_there.sigma_px <= _SURE * length else None

    def _ends_there(
        self, image: Image, expected: ProjectedTip, seen: TipDetection, hidden: bool
    ) -> tuple[bool, ...]:
        """Whether each visible end is where it was projected, collar first."""
        noise = float(np.hypot(expected.sigma_px, image.shape[0] * _LOOK_NOISE))
        ends = [(expected.collar, seen.collar)]
        if not hidden:
            ends.append((expected.orifice, seen.orifice))
        return tuple(_apart(a, b) <= _MOVED * noise for a, b in ends)

    def _note(
        self,
        image: Image,
        position: Position,
        tip: str,
        hidden: bool,
        found: TipDetection | None,
    ) -> None:
        if found is None or len(self._glimpses) >= _REFIT[-1]:
            return
        sighting = Sighting(position, tip, found.orifice, found.collar, hidden)
        self._glimpses.append(Glimpse.of(image, sighting))
        if len(self._glimpses) in _REFIT:
            height, width = image.shape[:2]
            self._fit((width, height))

    def _fit(self, size: tuple[int, int]) -> None:
        start = self._registration if len(self._glimpses) > _REFIT[1] else None
        fitted = fit([each.sighting for each in self._glimpses], size, start)
        detector = self._detector
        if fitted is not None and isinstance(detector, CloseUpDetector):
            anew = seen_again(fitted, self._glimpses, detector) if _is_good(fitted) else None
            if anew is not None:
                again = fit([each.sighting for each in anew], size, fitted)
                if again is not None and again.inliers >= fitted.inliers:
                    fitted, self._glimpses = again, anew
        self._registration = fitted or self._registration

    def _start_again(self) -> None:
        del self._glimpses[:-_STRAYS]
        self._registration, self._strays = None, 0
        self.times_moved += 1


def _is_good(known: Registration) -> bool:
    return known.inliers >= _FITS and known.sightings >= _ENOUGH


def _is_true(known: Registration, tip: str) -> bool:
    """Whether it is good, and a kind of tip as long in it as its maker says."""
    true = TIPS[tip].length_mm
    return _is_good(known) and abs(known.lengths_mm.get(tip, true) / true - 1.0) <= _TRUE_LENGTH


def _laid(expected: ProjectedTip, seen: TipDetection) -> TipDetection:
    """What was seen, with the ends where they were projected."""
    (x0, y0), (x1, y1) = expected.collar, expected.orifice
    half = seen.w / 2
    left, right = min(x0, x1) - half, max(x0, x1) + half
    return replace(
        seen, x=left, y=y0, w=right - left, h=max(y1 - y0, 1.0),
        orifice=expected.orifice, collar=expected.collar,
    )  # fmt: skip


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
