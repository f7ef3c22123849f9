"""Which end of a tip the detector misplaces, told by the tip's known length.

A detector's error may be the same in all frames of a run: it takes the nozzle's lower end for the
collar, or does not see a fine orifice before a bright wall. Such an error is absorbed by a free
length, and the robot's motion alone cannot tell at which end it is. So the tip's true length is
laid both ways, and the frames are asked which of the two axes a close-up agrees with.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from ..column import nozzle_shift, shapes_of
from ..tips import TIPS
from ..types import Axis, Image, TipDetection
from .registered import Registration, Sighting

_AMISS = 0.025, 0.25
"""Difference of the seen from the true length, as a share, from which an end is misplaced; and
beyond which it is no such error, but a wrong pose or another tip."""

_VIEWS = 4, 8
"""Frames with the tip hanging free that are asked, at least and at most."""

_ROOM = 0.7
"""What is kept of a frame around a tip, tip lengths on each side."""

_HEAT = 0.5
"""Worth of a close-up's heat beside distances in tip lengths."""


class CloseUps(Protocol):
    """Looks at one place."""

    def look_at(self, image: Image, axis: Axis) -> TipDetection | None: ...


@dataclass(frozen=True)
class Glimpse:
    """A sighting with what the frame shows around it.

    Attributes:
        sighting: Where a tip was seen.
        around: Part of the frame, BGR.
        left, top: Where that part begins in the frame, px.
    """

    sighting: Sighting
    around: Image
    left: int
    top: int

    @classmethod
    def of(cls, image: Image, sighting: Sighting) -> Glimpse:
        """Keeps a copy of the tip's surroundings."""
        ends = np.array((sighting.orifice, sighting.collar))
        room = _ROOM * float(np.hypot(*(ends[0] - ends[1])))
        rows, columns = image.shape[:2]
        low = np.clip(ends.min(axis=0) - room, 0, (columns - 16, rows - 16)).astype(int)
        high = np.clip(ends.max(axis=0) + room, low + 16, (columns, rows)).astype(int)
        around = image[low[1] : high[1], low[0] : high[0]].copy()
        return cls(sighting, around, int(low[0]), int(low[1]))

    def look(self, detector: CloseUps, axis: Axis) -> TipDetection | None:
        """What a close-up of an axis (frame px) shows, in frame px."""
        (a, b), (c, d) = axis
        here = ((a - self.left, b - self.top), (c - self.left, d - self.top))
        found = detector.look_at(self.around, here)
        if found is None:
            return None
        (x, y), (z, w) = found.collar, found.orifice
        return replace(
            found,
            x=found.x + self.left,
            y=found.y + self.top,
            collar=(x + self.left, y + self.top),
            orifice=(z + self.left, w + self.top),
        )


def seen_again(
    known: Registration, glimpses: Sequence[Glimpse], detector: CloseUps
) -> list[Glimpse] | None:
    """The same glimpses with their ends seen anew where the tips' true lengths put them.

    Returns:
        ``None`` where every kind of tip is seen as long as it is, or too few frames tell.
    """
    shifts = {
        name: shift
        for name in known.lengths_mm
        if (shift := _shift_mm(known, name, glimpses, detector)) is not None
    }
    if not shifts:
        return None
    true = _of_true_length(known, tuple(shifts))
    anew = []
    for glimpse in glimpses:
        sighting = glimpse.sighting
        axis = None
        if sighting.tip in shifts:
            axis = _axis(true, sighting, shifts[sighting.tip])
        found = glimpse.look(detector, axis) if axis is not None else None
        if axis is not None and found is not None:
            # The end that was amiss may be seen amiss again: it is where the length puts it.
            amiss_below = shifts[sighting.tip] != 0.0
            sighting = replace(
                sighting,
                collar=found.collar if amiss_below else axis[0],
                orifice=axis[1] if amiss_below else found.orifice,
            )
        anew.append(replace(glimpse, sighting=sighting))
    return anew


def _shift_mm(
    known: Registration, tip: str, glimpses: Sequence[Glimpse], detector: CloseUps
) -> float | None:
    """How far above its told position a tip's end is in the gauge of ``known``, if any is amiss."""
    lacking = TIPS[tip].length_mm - known.lengths_mm[tip]
    free = [each for each in glimpses if each.sighting.tip == tip and not each.sighting.hidden]
    free = free[-_VIEWS[1] :]
    low, high = (share * TIPS[tip].length_mm for share in _AMISS)
    if not low <= abs(lacking) <= high or len(free) < _VIEWS[0]:
        return None
    true = _of_true_length(known, (tip,))
    # Either the collar is where it was seen, and the orifice farther down, or the other way round.
    return min((-lacking, 0.0), key=lambda shift: _disagreement(true, free, shift, detector))


def _disagreement(
    known: Registration, free: Sequence[Glimpse], shift_mm: float, detector: CloseUps
) -> float:
    """How far from an axis of the true length close-ups see its ends, tip lengths, at the mean."""
    told = []
    for glimpse in free:
        axis = _axis(known, glimpse.sighting, shift_mm)
        found = None if axis is None else glimpse.look(detector, axis)
        if axis is None or found is None:
            told.append(1.0)
            continue
        collar, orifice = (np.array(end) for end in axis)
        length = max(float(np.hypot(*(orifice - collar))), 1.0)
        along = (orifice - collar) / length
        off = abs((np.array(found.collar) - collar) @ along)
        off += abs((np.array(found.orifice) - orifice) @ along)
        corner = np.array((glimpse.left, glimpse.top))
        shape = shapes_of(TIPS[glimpse.sighting.tip])[0]
        nozzle = nozzle_shift(glimpse.around, collar - corner, orifice - corner, shape)
        told.append(float(off) / length + abs(nozzle or 0.0) - _HEAT * found.confidence)
    return float(np.mean(told))


def _of_true_length(known: Registration, tips: Sequence[str]) -> Registration:
    return replace(
        known, lengths_mm={**known.lengths_mm, **{tip: TIPS[tip].length_mm for tip in tips}}
    )


def _axis(known: Registration, sighting: Sighting, shift_mm: float) -> Axis | None:
    x, y, z = sighting.position
    there = known.project_tip((x, y, z + shift_mm), sighting.tip)
    return None if there is None else (there.collar, there.orifice)
