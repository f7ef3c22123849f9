"""The column reader of a run: its own empty and filled tips tell what liquid looks like here."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..vocabulary import KeyframeKind
from .column import Deliveries, TipShape, WetAndDry, Wetness, at_one_place, ceiling
from .column_look import Look, Looks
from .drawn import drawn_top
from .measuring import ColumnReading, SeenColumn
from .scorers.looks import look, look_again
from .tip_scale import NEAR, TipScale
from .tips import TipGeometry
from .types import FREE, Image, TipDetection
from .usual import IN_ANY_LIGHT, LEFT, Usual, alike

Volumes = Mapping[KeyframeKind, float]
Well = tuple[Looks, Volumes]
"""Looks and expected volumes of one trajectory."""

_EVIDENCE = 5.0
"""Log-likelihood ratio from which rows are believed to be wet, or dry, against expectation."""

_SHORTEST = 0.05
"""Fewest rows that are believed against expectation, tip lengths."""

_SHARES = np.arange(0.1, 1.01, 0.1)
"""Shares of the column's height that are tried for the smallest column that would be seen."""

_REACH = (0.05, 0.15)
"""How far from its expected place a normal column may end, before the run has shown how high its
columns stand: tip lengths, and share of the column's own."""

_FIRST_VAGUE = ColumnReading(0.0, math.inf, vague=True)


class MeasuredColumns:
    """Measures the columns of one run, pipette and liquid.

    Normal wells teach it what each row of an empty and of a filled tip looks like before this
    camera (:class:`~.column.WetAndDry`), what changes when it leaves
    (:class:`~.column.Deliveries`), how far frames of normal wells stray from that
    (:class:`~.usual.Usual`), and how high columns stand in this run's frames against what the
    tip's geometry says (:class:`~.tip_scale.TipScale`). Where liquid hardly shows, a tip that
    looks empty proves nothing, and is read as vague.
    """

    def __init__(self) -> None:
        self._contrast = WetAndDry()
        self._deliveries = Deliveries()
        # Of frames read alone, and of those that are compared with TRANSIT.
        self._usuals = {False: Usual(), True: Usual()}
        self._scale = TipScale()
        # Of ends that are seen to the row; those that templates tell are off from them.
        self._seen_scale = TipScale()
        self._fullest = 0.0

    @property
    def _usual(self) -> Usual:
        return self._usuals[False]

    def share_tip(self, other: MeasuredColumns) -> None:
        """Learn the tip's geometry together with the reader of another liquid."""
        self._scale, self._seen_scale = other._scale, other._seen_scale

    def expect_heights(self, factors: Mapping[str, float]) -> None:
        """How high columns stood in earlier runs, over what the geometry says, by tip."""
        self._scale.expect(factors)
        self._seen_scale.expect(factors)

    def look(
        self,
        frames: Mapping[KeyframeKind, Image],
        kind: KeyframeKind,
        detection: TipDetection,
        tip: TipGeometry,
        shape: TipShape | None = None,
        before: TipDetection | None = None,
    ) -> Look:
        """What is needed of one frame, taken as soon as it arrives: frames are not kept.

        ``shape``: the tip's outline, once the run has shown which it is. ``before``: the tip in
        TRANSIT, where it hangs at one place with this one; both are laid by that frame's axis.
        """
        self._contrast.prepare()
        self._deliveries.prepare()
        # Shared with the scorers: each frame is straightened once.
        full = None
        if before is not None:
            full = look(frames, KeyframeKind.TRANSIT, before, tip, shape=shape)
        if full is None or full.washed_out:
            seen = look(frames, kind, detection, tip, shape=shape)
        else:
            seen = look_again(frames, detection, tip, full)
        light = float(np.median(frames[kind][::16, ::16]))
        return Look(seen.profile, tip, light, (seen.collar, seen.orifice))

    def read(self, looks: Looks, expected: Volumes) -> Mapping[KeyframeKind, ColumnReading]:
        """Readings of one trajectory; a keyframe that cannot be read is left out."""
        readings: dict[KeyframeKind, ColumnReading] = {}
        drawn = expected.get(KeyframeKind.TRANSIT, 0.0)
        for kind in FREE:
            seen = looks.get(kind)
            if seen is None:
                continue
            most = drawn if kind is KeyframeKind.POST_DISPENSE else 0.0
            for wet in self._wetnesses(kind, looks, expected):
                reading = self._reading(wet, seen, expected.get(kind, 0.0), most)
                if reading is not None:
                    readings[kind] = reading
                if reading is not None and not reading.vague:
                    break
        full = readings.get(KeyframeKind.TRANSIT)
        if full is not None:
            readings[KeyframeKind.TRANSIT] = replace(full, seen=self._seen(looks, expected))
        return readings

    def learn(self, looks: Looks, expected: Volumes) -> None:
        """This trajectory was normal: calibrate on it."""
        shown = self._drawn_top(looks, expected)
        for kind in FREE:
            seen = looks.get(kind)
            if seen is None:
                continue
            comparable = self._usual.comparable(seen.light)
            for usual in self._usuals.values():
                usual.note_light(seen.light)
            volume = expected.get(kind, 0.0)
            wets = self._wetnesses(kind, looks, expected) if comparable else []
            if not comparable or (wets and not volume and self._holds_some(seen, wets[0])):
                continue
            if volume and shown is not None:
                self._seen_scale.note(seen.tip, shown, volume)
            for wet in wets:
                self._learn_usual(seen, wet, volume)
            self._take(kind, looks, expected)

    def _seen(self, looks: Looks, expected: Volumes) -> SeenColumn | None:
        top, full = self._drawn_top(looks, expected), looks.get(KeyframeKind.TRANSIT)
        if top is None or full is None or not self._seen_scale.known:
            return None
        volume = self._seen_scale.volume(full.tip, top)
        sigma = self._seen_scale.sigma_ul(full.tip, top, volume)
        return SeenColumn(volume, sigma, 1.0 - top)

    def _drawn_top(self, looks: Looks, expected: Volumes) -> float | None:
        before, after = (looks.get(kind) for kind in FREE)
        drawn, kept = (expected.get(kind, 0.0) for kind in FREE)
        if before is None or after is None or drawn <= 0 or kept > 0:
            return None
        place = self._seen_scale.place(before.tip, drawn)
        return drawn_top(before, after, place, _REACH[0] + _REACH[1] * (1.0 - place))

    def _holds_some(self, empty: Look, wet: Wetness) -> bool:
        """Whether an emptied tip of a well that passed is clearly not empty: it teaches nothing."""
        place = self._scale.place(empty.tip, 0.0)
        found = wet.column(ceiling(empty.tip), empty.lowest)
        return self._against(wet, found, place, empty) >= _EVIDENCE

    def read_beside(
        self, looks: Looks, expected: Volumes, others: Sequence[Well]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        """Read a well with what ``others`` alone teach: the well itself may have been learned."""
        return self._taught_by(others).read(looks, expected)

    def wetness_beside(
        self, looks: Looks, expected: Volumes, others: Sequence[Well]
    ) -> dict[KeyframeKind, Wetness]:
        """How wet each row of a well's free frames is, by what ``others`` alone teach."""
        reader = self._taught_by(others)
        seen = [kind for kind in FREE if kind in looks]
        wets = {kind: reader._wetnesses(kind, looks, expected) for kind in seen}
        return {kind: told[0] for kind, told in wets.items() if told}

    def wetness(self, looks: Looks, expected: Volumes) -> dict[KeyframeKind, tuple[float, ...]]:
        """Mean wetness of a trajectory's free frames, 0 dry to 1, below each of the heights
        :data:`~.usual.LEFT` of the full column; ``nan`` where nothing is known."""
        told: dict[KeyframeKind, tuple[float, ...]] = {}
        for kind in FREE:
            seen = looks.get(kind)
            wets = [] if seen is None else self._wetnesses(kind, looks, expected)
            if wets and seen is not None:
                column = 1.0 - self._scale.place(seen.tip, expected.get(KeyframeKind.TRANSIT, 0.0))
                means = [wets[0].mean(1.0 - height * column, seen.lowest) for height in LEFT]
                told[kind] = tuple(share if weight > 0 else math.nan for share, weight in means)
        return told

    def place(self, tip: TipGeometry, volume_ul: float) -> float:
        """Where a column of this volume ends in this run's frames, u."""
        return self._scale.place(tip, volume_ul)

    def forget(self, kept: Sequence[Well]) -> None:
        """Keep what these wells teach, and nothing else."""
        taught = self._taught_by(kept)
        self._contrast, self._deliveries = taught._contrast, taught._deliveries
        self._usuals = {paired: usual.anew() for paired, usual in self._usuals.items()}

    def _taught_by(self, wells: Sequence[Well]) -> MeasuredColumns:
        reader = MeasuredColumns()
        reader._scale, reader._fullest = self._scale, self._fullest
        for looks, expected in wells:
            for kind in FREE:
                seen, volume = looks.get(kind), expected.get(kind, 0.0)
                if seen is None or not self._usual.comparable(seen.light):
                    continue
                wets = [] if volume else reader._wetnesses(kind, looks, expected)
                if not wets or not reader._holds_some(seen, wets[0]):
                    reader._take(kind, looks, expected)
        return reader

    def _take(self, kind: KeyframeKind, looks: Looks, expected: Volumes) -> None:
        seen = looks[kind]
        top = self._scale.place(seen.tip, expected.get(kind, 0.0))
        # While the tip's inside is known to some per cent only, rows near the top are unsure.
        margin = self._scale.margin(top)
        self._contrast.learn(seen.profile, top, margin)
        before = _loaded(kind, looks, expected)
        if before is not None and alike(before.light, seen.light):
            full = self._scale.place(seen.tip, expected[KeyframeKind.TRANSIT])
            margin = self._scale.margin(full)
            self._deliveries.learn_pair(before.profile, seen.profile, full, margin)

    def _learn_usual(self, seen: Look, wet: Wetness, volume: float) -> None:
        tip, end = seen.tip, seen.lowest
        top = self._scale.place(tip, volume)
        if volume > 0:
            self._fullest = max(self._fullest, volume)
            share, weight = wet.mean(top + 0.02, end)
            self._usuals[wet.paired].note_full(share if weight > 0 else None, wet.misfit)
            found = wet.column(ceiling(tip), end)
            reach = NEAR if self._scale.known else _REACH[0] + _REACH[1] * (1.0 - top)
            if abs(found - top) < reach and wet.power > 4 and wet.bracketed(found, NEAR):
                self._scale.note(tip, found, volume)
            return
        if wet.paired:
            self._usuals[True].note_pair(wet.misfit)
        heights = LEFT * (1.0 - self._scale.place(tip, self._fullest))
        told = [wet.mean(1.0 - height, end) for height in heights]
        if any(weight > 0 for _, weight in told):
            self._usuals[wet.paired].note_empty(
                [share if weight > 0 else math.nan for share, weight in told]
            )

    def _reading(
        self, wet: Wetness, seen: Look, expected_ul: float, most_ul: float
    ) -> ColumnReading | None:
        """Read one frame; ``most_ul``: no more than that can be in the tip, 0 if not known."""
        if not self._usuals[wet.paired].readable(wet, seen.light):
            return None
        if not self._usuals[wet.paired].fits(wet):
            return None if expected_ul > 0 else _FIRST_VAGUE
        tip, end = seen.tip, seen.lowest
        place, highest = self._scale.place(tip, expected_ul), ceiling(tip)
        if most_ul > expected_ul:
            top = self._scale.place(tip, most_ul)
            highest = max(highest, top - self._scale.margin(top))
        found = wet.column(highest, end)
        full = expected_ul > 0
        top = self._scale.place(tip, max(expected_ul, most_ul))
        bore = seen.bore_px(min(top, end), end)
        clear = 0.5 / self._usuals[wet.paired].variance(wet, bore, full=full) >= _EVIDENCE
        against = self._against(wet, found, place, seen)
        excess = against if found < place else 0.0
        if against < _EVIDENCE:
            found = place
            if not clear:
                return None if full else replace(_FIRST_VAGUE, excess=excess)
        volume = self._scale.volume(tip, found) if found != place else expected_ul
        sigma = self._scale.sigma_ul(tip, found, max(volume, expected_ul))
        if not full and found == place:
            sigma = max(sigma, 0.5 * self._least_seen(wet, seen, top))
        # Two frames at one place show an end by itself, where rows next above it are known.
        upper = max(top, found - NEAR) if wet.paired else top
        if most_ul > volume and found != place and not wet.known(upper, found):
            # It ends somewhere in rows that no other well showed: most likely where it was drawn.
            # That there is one is as sure as its known part.
            sigma *= most_ul / max(volume, 1e-6)
            volume, found = most_ul, top
        tested = self._usuals[wet.paired].tested(full=full)
        return ColumnReading(volume, sigma, 1.0 - found, False, excess, None, tested, wet.paired)

    def _least_seen(self, wet: Wetness, seen: Look, top: float) -> float:
        """Smallest column, of those up to ``top`` (u), that an empty tip's rows rule out, µL."""
        for share in _SHARES:
            upper = 1.0 - share * (1.0 - top)
            if upper < seen.lowest:
                bore = seen.bore_px(upper, seen.lowest)
                variance = self._usuals[wet.paired].variance(
                    wet, bore, full=False, height=float(share)
                )
                if 0.5 / variance >= _EVIDENCE:
                    return self._scale.volume(seen.tip, upper)
        return self._scale.volume(seen.tip, top)

    def _against(self, wet: Wetness, found: float, place: float, seen: Look) -> float:
        """How far the rows between the column's end and its expected end say that it is off."""
        end = seen.lowest
        if abs(min(found, end) - min(place, end)) < _SHORTEST:
            return 0.0
        too_much = found < place
        upper, lower = min(found, place), min(max(found, place), end)
        share, weight = wet.mean(upper - 1e-6, lower)
        if weight <= 0:
            return 0.0
        bore = seen.bore_px(upper, lower)
        fullest = max(1.0 - self._scale.place(seen.tip, self._fullest), _SHORTEST)
        height = (1.0 - upper) / fullest if lower >= end else None
        usual = self._usuals[wet.paired].variance(wet, bore, full=not too_much, height=height)
        variance = 1.0 / weight + usual
        towards = share - 0.5 if too_much else 0.5 - share
        return max(towards / variance, 0.0)

    def _wetnesses(self, kind: KeyframeKind, looks: Looks, expected: Volumes) -> list[Wetness]:
        """How wet a frame's rows are, the surest first: after the dispense by what changed since
        TRANSIT, where both stand at one place; then by what the run's tips look like."""
        seen = looks[kind]
        low, paired, before = ceiling(seen.tip) - 0.03, None, _loaded(kind, looks, expected)
        if before is not None:
            full = self._scale.place(seen.tip, expected[KeyframeKind.TRANSIT])
            full = max(full + self._scale.margin(full), low)
            paired = self._deliveries.read_pair(before.profile, seen.profile, full)
            if paired is not None and not alike(before.light, seen.light):
                paired = paired if paired.power >= IN_ANY_LIGHT else None
        told = (paired, self._contrast.read(seen.profile, low))
        return [wet for wet in told if wet is not None and wet.weight.any()]


def _loaded(kind: KeyframeKind, looks: Looks, expected: Volumes) -> Look | None:
    """TRANSIT's look, where ``kind`` is the emptied tip and can be compared with it row by row."""
    before, after = (looks.get(kind) for kind in FREE)
    drawn, kept = (expected.get(kind, 0.0) for kind in FREE)
    if kind is not KeyframeKind.POST_DISPENSE or drawn <= 0 or kept > 0:
        return None
    if before is None or after is None:
        return None
    if before.axis is None or after.axis is None:
        return None
    return before if at_one_place(before.axis, after.axis) else None
