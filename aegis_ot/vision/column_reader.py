"""The column reader of a run: its own empty and filled tips tell what liquid looks like here."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..vocabulary import KeyframeKind
from .column import WetAndDry, Wetness, ceiling, column_left
from .column_look import Look
from .drawn import drawn_top
from .measuring import ColumnReading, SeenColumn, TipView
from .scorers.looks import look
from .tip_scale import NEAR, TipScale
from .tips import TipGeometry
from .types import FREE
from .usual import LEFT, Usual, alike

Well = tuple[Mapping[KeyframeKind, object], Mapping[KeyframeKind, float]]
"""Looks and expected volumes of one trajectory."""

_EVIDENCE = 5.0
"""Log-likelihood ratio from which rows are believed to be wet, or dry, against expectation."""

_SHORTEST = 0.05
"""Fewest rows that are believed against expectation, tip lengths."""

_SHARES = np.arange(0.1, 1.01, 0.1)
"""Shares of the column's height that are tried for the smallest column that would be seen."""

_GAP_SHARE = 0.3
"""Air fills the bore: wetness of a break at most."""

_GAP_BORE_PX = 4.0
"""Narrowest bore in which a break is looked for, px: a tip that is laid down one pixel beside its
place shows wall for liquid in a narrower one."""

_REACH = (0.05, 0.15)
"""How far from its expected place a normal column may end, before the run has shown how high its
columns stand: tip lengths, and share of the column's own."""

_FIRST_VAGUE = ColumnReading(0.0, math.inf, vague=True)


class MeasuredColumns:
    """Measures the columns of one run, pipette and liquid.

    Normal wells teach it what each row of an empty and of a filled tip looks like before this
    camera (:class:`~.column.WetAndDry`), how far frames of normal wells stray from that
    (:class:`~.usual.Usual`), and how high columns stand in this run's frames against what the
    tip's geometry says (:class:`~.tip_scale.TipScale`). Where liquid hardly shows, a tip that
    looks empty proves nothing, and is read as vague.
    """

    def __init__(self) -> None:
        self._contrast = WetAndDry()
        self._usual = Usual()
        self._scale = TipScale()
        # Of ends that are seen to the row; those that templates tell are off from them.
        self._seen_scale = TipScale()
        self._fullest = 0.0

    def share_tip(self, other: object) -> None:
        """Learn the tip's geometry together with the reader of another liquid."""
        if isinstance(other, MeasuredColumns):
            self._scale, self._seen_scale = other._scale, other._seen_scale

    def expect_heights(self, factors: Mapping[str, float]) -> None:
        """How high columns stood in earlier runs, over what the geometry says, by tip."""
        self._scale.expect(factors)
        self._seen_scale.expect(factors)

    def look(self, view: TipView) -> Look:
        self._contrast.prepare()
        # Shared with the scorers: each frame is straightened once.
        profile = look(view.image, view.detection, view.tip, shape=view.shape).profile
        return Look(profile, view.tip, float(np.median(view.image[::16, ::16])))

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        readings: dict[KeyframeKind, ColumnReading] = {}
        drawn = expected.get(KeyframeKind.TRANSIT, 0.0)
        for kind in FREE:
            seen = looks.get(kind)
            if isinstance(seen, Look):
                most = drawn if kind is KeyframeKind.POST_DISPENSE else 0.0
                reading = self._reading(seen, expected.get(kind, 0.0), most)
                if reading is not None:
                    readings[kind] = reading
        full = readings.get(KeyframeKind.TRANSIT)
        if full is not None:
            readings[KeyframeKind.TRANSIT] = replace(full, seen=self._seen(looks, expected, full))
        left = self._pair(looks, expected)
        after = readings.get(KeyframeKind.POST_DISPENSE, _FIRST_VAGUE)
        if left is not None and after.vague:
            readings[KeyframeKind.POST_DISPENSE] = replace(left, excess=after.excess)
        return readings

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        shown = self._drawn_top(looks, expected)
        for kind in FREE:
            seen = looks.get(kind)
            if not isinstance(seen, Look):
                continue
            comparable = self._usual.comparable(seen.light)
            self._usual.note_light(seen.light)
            volume = expected.get(kind, 0.0)
            wet = self._wetness(seen) if comparable else None
            if not comparable or (wet is not None and not volume and self._holds_some(seen, wet)):
                continue
            if volume and shown is not None:
                self._seen_scale.note(seen.tip, shown, volume)
            if wet is not None:
                self._learn_usual(seen, wet, volume)
            self._take(seen, volume)

    def _seen(
        self,
        looks: Mapping[KeyframeKind, object],
        expected: Mapping[KeyframeKind, float],
        read: ColumnReading,
    ) -> SeenColumn | None:
        top, full = self._drawn_top(looks, expected), looks.get(KeyframeKind.TRANSIT)
        if top is None or not isinstance(full, Look) or not self._seen_scale.known:
            return None
        volume = self._seen_scale.volume(full.tip, top)
        sigma = self._seen_scale.sigma_ul(full.tip, top, volume)
        return SeenColumn(max(volume - read.gap_ul, 0.0), sigma, 1.0 - top)

    def _drawn_top(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> float | None:
        before, after = (looks.get(kind) for kind in FREE)
        drawn, kept = (expected.get(kind, 0.0) for kind in FREE)
        if not isinstance(before, Look) or not isinstance(after, Look) or drawn <= 0 or kept > 0:
            return None
        place = self._seen_scale.place(before.tip, drawn)
        return drawn_top(before, after, place, _REACH[0] + _REACH[1] * (1.0 - place))

    def _holds_some(self, empty: Look, wet: Wetness) -> bool:
        """Whether an emptied tip of a well that passed is clearly not empty: it teaches nothing."""
        place = self._scale.place(empty.tip, 0.0)
        found = wet.column(ceiling(empty.tip), empty.lowest)
        return self._against(wet, found, place, empty) >= _EVIDENCE

    def read_beside(
        self,
        looks: Mapping[KeyframeKind, object],
        expected: Mapping[KeyframeKind, float],
        others: Sequence[Well],
    ) -> Mapping[KeyframeKind, ColumnReading]:
        """Read a well with what ``others`` alone teach: the well itself may have been learned."""
        return self._taught_by(others).read(looks, expected)

    def wetness_beside(
        self, looks: Mapping[KeyframeKind, object], others: Sequence[Well]
    ) -> dict[KeyframeKind, Wetness]:
        """How wet each row of a well's free frames is, by what ``others`` alone teach."""
        reader = self._taught_by(others)
        seen = {kind: look for kind in FREE if isinstance(look := looks.get(kind), Look)}
        wets = {kind: reader._wetness(look) for kind, look in seen.items()}
        return {kind: wet for kind, wet in wets.items() if wet is not None}

    def place(self, tip: TipGeometry, volume_ul: float) -> float:
        """Where a column of this volume ends in this run's frames, u."""
        return self._scale.place(tip, volume_ul)

    def forget(self, kept: Sequence[Well]) -> None:
        """Keep what these wells teach, and nothing else."""
        self._contrast = self._taught_by(kept)._contrast
        self._usual = self._usual.anew()

    def _taught_by(self, wells: Sequence[Well]) -> MeasuredColumns:
        reader = MeasuredColumns()
        reader._scale, reader._fullest = self._scale, self._fullest
        for looks, expected in wells:
            for kind in FREE:
                seen, volume = looks.get(kind), expected.get(kind, 0.0)
                if not isinstance(seen, Look) or not self._usual.comparable(seen.light):
                    continue
                wet = None if volume else reader._wetness(seen)
                if wet is None or not reader._holds_some(seen, wet):
                    reader._take(seen, volume)
        return reader

    def _take(self, seen: Look, volume: float) -> None:
        top = self._scale.place(seen.tip, volume)
        # While the tip's inside is known to some per cent only, rows near the top are unsure.
        self._contrast.learn(seen.profile, top, self._scale.margin(top))

    def _learn_usual(self, seen: Look, wet: Wetness, volume: float) -> None:
        tip, end = seen.tip, seen.lowest
        top = self._scale.place(tip, volume)
        if volume > 0:
            self._fullest = max(self._fullest, volume)
            share, weight = wet.mean(top + 0.02, end)
            gap, _, _ = wet.longest_gap(top + 0.05, min(end, seen.wide_down_to(_GAP_BORE_PX)))
            self._usual.note_full(share if weight > 0 else None, gap, wet.misfit)
            found = wet.column(ceiling(tip), end)
            reach = NEAR if self._scale.known else _REACH[0] + _REACH[1] * (1.0 - top)
            if abs(found - top) < reach and wet.power > 4 and wet.bracketed(found, NEAR):
                self._scale.note(tip, found, volume)
            return
        heights = LEFT * (1.0 - self._scale.place(tip, self._fullest))
        told = [wet.mean(1.0 - height, end) for height in heights]
        if any(weight > 0 for _, weight in told):
            self._usual.note_empty([share if weight > 0 else math.nan for share, weight in told])

    def _reading(self, seen: Look, expected_ul: float, most_ul: float) -> ColumnReading | None:
        """Read one frame; ``most_ul``: no more than that can be in the tip, 0 if not known."""
        wet = self._wetness(seen)
        if wet is None or not self._usual.readable(wet, seen.light):
            return None
        if not self._usual.fits(wet):
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
        clear = 0.5 / self._usual.variance(wet, bore, full=full) >= _EVIDENCE
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
        if most_ul > volume and found != place and not wet.known(top, found):
            # It ends somewhere in rows that no other well showed: most likely where it was drawn.
            # That there is one is as sure as its known part.
            sigma *= most_ul / max(volume, 1e-6)
            volume, found = most_ul, top
        gap, gap_sigma = self._gap(wet, found, seen) if volume > 0 and full else (0.0, 0.0)
        tested = self._usual.tested(full=full)
        return ColumnReading(
            max(volume - gap, 0.0), sigma, gap, gap_sigma, 1.0 - found,
            excess=excess, tested=tested,
        )  # fmt: skip

    def _least_seen(self, wet: Wetness, seen: Look, top: float) -> float:
        """Smallest column, of those up to ``top`` (u), that an empty tip's rows rule out, µL."""
        for share in _SHARES:
            upper = 1.0 - share * (1.0 - top)
            if upper < seen.lowest:
                bore = seen.bore_px(upper, seen.lowest)
                variance = self._usual.variance(wet, bore, full=False, height=float(share))
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
        usual = self._usual.variance(wet, bore, full=not too_much, height=height)
        variance = (1.0 / weight + usual) * self._usual.strain(wet)
        towards = share - 0.5 if too_much else 0.5 - share
        return max(towards / variance, 0.0)

    def _gap(self, wet: Wetness, top: float, seen: Look) -> tuple[float, float]:
        """Air in the column and its uncertainty, µL; nothing unless it stands out in this run."""
        tip, end = seen.tip, min(seen.lowest, seen.wide_down_to(_GAP_BORE_PX))
        strength, upper, lower = wet.longest_gap(top + 0.05, end)
        limit = self._usual.gap_limit(wet)
        share, _ = wet.mean(upper - 1e-6, lower + 1e-6)
        if limit is None or strength < limit or share > _GAP_SHARE:
            return 0.0, 0.0
        air = self._scale.volume(tip, upper) - self._scale.volume(tip, lower)
        return air, air * limit / strength / 8.0

    def _pair(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> ColumnReading | None:
        """What this trajectory shows by itself of a column left after its dispense."""
        before, after = (looks.get(kind) for kind in FREE)
        full = expected.get(KeyframeKind.TRANSIT, 0.0)
        if not isinstance(before, Look) or not isinstance(after, Look) or full <= 0:
            return None
        if not alike(before.light, after.light) or expected.get(FREE[1], 0.0) > 0:
            return None
        tip = before.tip
        highest = self._scale.place(tip, full) + NEAR
        top = column_left(before.profile, after.profile, tip, highest, ceiling(tip))
        if top is None:
            return None
        volume = self._scale.volume(tip, top)
        sigma = self._scale.sigma_ul(tip, top, volume)
        return ColumnReading(volume, sigma, top=1.0 - top)

    def _wetness(self, seen: Look) -> Wetness | None:
        wet = self._contrast.read(seen.profile, ceiling(seen.tip) - 0.03)
        return wet if wet is not None and wet.weight.any() else None
