"""What one trajectory shows of its own delivery, in absolute terms.

TRANSIT and POST_DISPENSE show the same tip above the same well, loaded and emptied. A liquid that
shows and leaves the tip changes every row that it filled, from its top down to the orifice, in
proportion to the bore's width there. No normal well, no template and no name of the reagent is
needed for that, so it holds for the first well of a run, and for all wells of a run that go wrong
in the same way, or ever more so.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .column import ceiling
from .column.contrast import change_between
from .column_look import Look, Looks
from .drawn import LONGEST_END, PLAIN, ROW_LEAST_PX, ROWS_LEAST, across
from .tip_scale import TipScale
from .usual import alike

_BORE_LEAST_PX = 4.0
"""Of the upper rows on average: a narrower bore tells as little as a row narrower than
:data:`.drawn.ROW_LEAST_PX`."""

_UNSEEN_MOST = 0.2
"""Share of the delivery that may stand in rows too narrow to tell, for the others to prove it."""

_LEFT_LEAST = 0.2
"""Share of the delivery that must have stayed to be called so."""

_SURE = 3.5
"""Change from which the rows below must show it too."""

_ELSEWHERE = 0.35
"""Change where no liquid stood, as a share of that where it did, from which something else changed:
the light, or what is behind the tip."""

_EMPTIED, _LEFT = 0.5, 0.3
"""Change of the lower half, as a share of what the upper rows let expect: at least the first where
the liquid left, at most the second where it stayed."""

_UPPER = (3, 6)
"""Parts of the rows of which the uppermost must show that liquid left; the smaller one where most
of the column stayed."""

_SECTIONS = 12

_GAP_SURE, _GAP_SURE_WIDE, _GAP_WIDE_PX = 8.5, 6.0, 6.0
"""Change of the upper rows from which a gap would show, and from which it would in a bore at least
so wide, px: in a narrow one a speck on the wall takes the place of a gap."""

_GAP_CHANGE = 0.33
"""Share of what the column's rows change that those of a gap change at most. Columns without one
show 0.5 at least; with one of 8 % of their volume 0.25 at most, but up to 0.46 from a webcam or
a corner of the deck, where the gap is then not told; on simulated frames."""

_GAP_LENGTH, _GAP_WITHIN = 0.05, 0.8
"""Shortest gap, and the part of the column above the narrow end in which it is looked for, as
shares of the column."""


class Shown(str, Enum):
    """What the two frames show."""

    EMPTIED = "emptied"
    """Liquid stood where it should, and left."""
    GAP = "gap"
    """It left, but for a stretch within the column in which there was none."""
    LEFT = "left"
    """Its upper part left, and its lower part stayed."""
    NOTHING = "nothing"
    """No liquid is seen to leave: none did, or it cannot be seen."""
    FAINT = "faint"
    """The same, of a liquid that is not seen to leave in most wells: that is no sign."""
    UNKNOWN = "unknown"
    """The frames cannot be compared."""


@dataclass(frozen=True)
class Delivery:
    """What a trajectory shows of its delivery.

    Attributes:
        shown: See :class:`Shown`.
        strength: How plainly the liquid shows, by the width of its bore, 1/mm; of wells of one
            liquid about the same.
        left_ul: What stayed in the tip, µL, where some did.
        gap_ul: Air within the column, µL, where there was some.
        unbroken: Change of the stretch of the column that changed least, as a share of its usual
            rows' change: low where air is enclosed, and in single wells also by chance.
        spoiled: Whether it is unknown because light or background changed between the two frames:
            the next well may well tell.
    """

    shown: Shown
    strength: float = 0.0
    left_ul: float | None = None
    spoiled: bool = False
    gap_ul: float | None = None
    unbroken: float | None = None

    @property
    def unseen(self) -> bool:
        """Whether the frames can be compared, and no liquid is seen to leave."""
        return self.shown in (Shown.NOTHING, Shown.FAINT)


def delivery_of(looks: Looks, expected: Mapping[KeyframeKind, float]) -> Delivery:
    """Compare TRANSIT with POST_DISPENSE.

    Args:
        looks: Of the column reader.
        expected: Liquid that should be in the tip, µL.
    """
    before, after = looks.get(KeyframeKind.TRANSIT), looks.get(KeyframeKind.POST_DISPENSE)
    drawn = expected.get(KeyframeKind.TRANSIT, 0.0)
    kept = expected.get(KeyframeKind.POST_DISPENSE, 0.0)
    unknown = Delivery(Shown.UNKNOWN)
    if before is None or after is None or drawn <= kept:
        return unknown
    if not alike(before.light, after.light):
        return replace(unknown, spoiled=True)
    if len(before.profile.u) != len(after.profile.u):
        return unknown
    scale = TipScale()
    top = max(scale.place(before.tip, drawn), ceiling(before.tip)) + 0.02
    end = min(LONGEST_END, scale.place(before.tip, kept) - 0.02)
    u = before.profile.u.astype(np.float64)
    inside = (u > top) & (u < end)
    inside &= before.bores >= ROW_LEAST_PX
    if int(inside.sum()) < ROWS_LEAST or before.bore_px(top, (top + end) / 2) < _BORE_LEAST_PX:
        return unknown
    lowest = float(before.tip.volume_of((1.0 - u[inside].max()) * before.tip.length_mm))
    if lowest - kept > _UNSEEN_MOST * (drawn - kept):
        return unknown
    found = _compared(before, after, inside, (u > 0.12) & (u < top - 0.07))
    little = found.left_ul is not None and found.left_ul - kept < _LEFT_LEAST * (drawn - kept)
    return replace(unknown, strength=found.strength) if little else found


def _compared(
    before: Look, after: Look, inside: NDArray[np.bool_], above: NDArray[np.bool_]
) -> Delivery:
    u, tip = before.profile.u.astype(np.float64), before.tip
    change = across(change_between(before.profile, after.profile))
    width = np.asarray(tip.inner_radius((1.0 - u) * tip.length_mm), dtype=np.float64)
    rows = np.flatnonzero(inside)
    for part in _UPPER:
        upper = rows[: max(len(rows) // part, 1)]
        mean = change[upper].mean(axis=0)
        strength = float(np.linalg.norm(mean))
        if strength >= PLAIN:
            break
    if strength < PLAIN:
        return Delivery(Shown.NOTHING, strength / float(width[upper].mean()))
    along = change @ (mean / strength)
    if above.any() and abs(float(along[above].mean())) > _ELSEWHERE * strength:
        return Delivery(Shown.UNKNOWN, spoiled=True)
    per_width = strength / float(width[upper].mean())
    share = along / (per_width * width)
    lower = rows[len(rows) // 2 :]
    emptied = float(np.average(share[lower], weights=width[lower]))
    if emptied >= _EMPTIED:
        unbroken = _unbroken(share[rows])
        gap = _gap(share[rows]) if strength >= _GAP_SURE_WIDE else None
        wide = gap is not None and before.bores[rows[gap[1]]] >= _GAP_WIDE_PX
        if gap is None or not (wide or strength >= _GAP_SURE):
            return Delivery(Shown.EMPTIED, per_width, unbroken=unbroken)
        upper_end, lower_end = ((1.0 - u[rows[end]]) * tip.length_mm for end in gap)
        air = float(tip.volume_of(upper_end)) - float(tip.volume_of(lower_end))
        return Delivery(Shown.GAP, per_width, gap_ul=air, unbroken=unbroken)
    if emptied > _LEFT or strength < _SURE:
        return Delivery(Shown.UNKNOWN, per_width)
    sections = np.array_split(rows, _SECTIONS)
    means = np.array([share[part].mean() for part in sections])
    first = int(np.flatnonzero(means[1:] < 0.5)[0]) + 1
    # What is behind the tip may have changed instead: then these rows change, another way.
    if float(np.median(np.abs(means[first:]))) > _ELSEWHERE * float(means.max()):
        return Delivery(Shown.UNKNOWN, per_width)
    left = float(tip.volume_of((1.0 - u[sections[first][0]]) * tip.length_mm))
    return Delivery(Shown.LEFT, per_width, left)


def _shortest_gap(share: NDArray[np.float64]) -> int:
    return max(4, round(_GAP_LENGTH * len(share)))


def _unbroken(share: NDArray[np.float64]) -> float | None:
    """Least mean change of as many rows as the shortest gap has, as a share of the usual one."""
    length, usual = _shortest_gap(share), float(np.median(share))
    rows = share[2 : int(_GAP_WITHIN * len(share))]
    if len(rows) < length or usual <= 0:
        return None
    return float(np.convolve(rows, np.full(length, 1.0 / length), "valid").min()) / usual


def _gap(share: NDArray[np.float64]) -> tuple[int, int] | None:
    """First and last row of the longest stretch that does not change, if it is a gap."""
    usual = float(np.median(share))
    still = share[: int(_GAP_WITHIN * len(share))] < 0.5 * usual
    ends = np.flatnonzero(np.diff(np.concatenate(([0], still.astype(np.int8), [0]))))
    stretches = sorted(zip(ends[::2], ends[1::2], strict=True), key=lambda pair: pair[0] - pair[1])
    if not stretches:
        return None
    first, past = stretches[0]
    least = _shortest_gap(share)
    if past - first < least or first == 0 or past >= len(still):
        return None
    middle = (first + past) // 2
    core = share[max(middle - least // 2, 0) : middle + (least + 1) // 2]
    return (int(first), int(past)) if float(core.mean()) < _GAP_CHANGE * usual else None
