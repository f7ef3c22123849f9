"""The column reader of a run: its own empty and filled tips tell what liquid looks like here."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from ..vocabulary import KeyframeKind
from .column import TipProfile, WetAndDry, Wetness, ceiling, column_left
from .measuring import ColumnReading, TipView
from .scorers.looks import look
from .tips import TipGeometry

T = TypeVar("T")
Well = tuple[Mapping[KeyframeKind, object], Mapping[KeyframeKind, float]]
"""Looks and expected volumes of one trajectory."""

_MEMORY = 32
_ENOUGH = 3
"""Normal wells from which the run's own spread is taken for real."""

_EVIDENCE = 5.0
"""Log-likelihood ratio from which rows are believed to be wet, or dry, against expectation."""

_NEAR = 0.04
"""A meniscus this close to its expected place is the expected one, tip lengths."""

_ORIFICE = (0.06, 8.0)
"""What is left out next to the orifice, tip lengths and px: its rim glints, and a drop hangs."""

_SHORTEST = 0.05
"""Fewest rows that are believed against expectation, tip lengths."""

_LEFT = np.array([0.25, 0.5, 0.75, 1.0])
"""Shares of the column's height that are tried for what normal wells show of a column left."""

_PRIOR_WEIGHT = 3.0
_PRIOR = (1.5, 0.1, 0.35)
"""Standard deviation of a frame's wetness before the run has shown it: the first over the root
of the liquid's power, within the other two. What moves a whole frame (what is behind the tip,
the lamp, a film on the wall) is about the same for all liquids, so a plain one stands out more."""

_LEAST_SD = 0.06

_GAP_LEAST = 2.5
_GAP_FACTOR = 2.0
_GAP_FIRST = 8.0
_GAP_FAINT = 25.0
_GAP_SHARE = 0.3
"""A break counts from this strength, from this multiple of the strongest that this run's normal
columns showed, and while they are few from more; and air fills the bore."""

_EXPOSURE = 1.4
"""A frame this many times brighter or darker than the run's others cannot be compared."""

_FIRST_VAGUE = ColumnReading(0.0, math.inf, vague=True)


@dataclass(frozen=True)
class Look:
    """Signals of one frame.

    Attributes:
        profile: Of the tip.
        tip: Its geometry.
        light: Median brightness of the whole frame: the pipette covers little of it.
    """

    profile: TipProfile
    tip: TipGeometry
    light: float = 0.0


@dataclass
class _Usual:
    """What this run's normal wells showed of themselves, each judged before it was learned."""

    lights: list[float] = field(default_factory=list)
    dry: list[float] = field(default_factory=list)
    wet: list[float] = field(default_factory=list)
    gaps: list[float] = field(default_factory=list)


class MeasuredColumns:
    """Measures the columns of one run, pipette and liquid.

    Normal wells teach it what each row of an empty and of a filled tip looks like before this
    camera (:class:`~.column.WetAndDry`), how far frames of normal wells stray from that, and how
    high columns stand in this run's frames against what the tip's geometry says. Where liquid
    hardly shows, a tip that looks empty proves nothing, and is read as vague.
    """

    def __init__(self) -> None:
        self._contrast = WetAndDry()
        self._usual = _Usual()
        self._heights: list[tuple[float, float]] = []
        self._fullest = 0.0

    def share_tip(self, other: object) -> None:
        """Learn the tip's geometry together with the reader of another liquid."""
        if isinstance(other, MeasuredColumns):
            self._heights = other._heights

    def look(self, view: TipView) -> Look:
        self._contrast.prepare()
        # Shared with the scorers: each frame is straightened once.
        profile = look(view.image, view.detection, view.pipette).profile
        return Look(profile, view.tip, float(np.median(view.image[::16, ::16])))

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        readings: dict[KeyframeKind, ColumnReading] = {}
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
            seen = looks.get(kind)
            if isinstance(seen, Look) and not self._off_exposure(seen):
                reading = self._reading(kind, seen, expected.get(kind, 0.0))
                if reading is not None:
                    readings[kind] = reading
        left = self._pair(looks, expected)
        after = readings.get(KeyframeKind.POST_DISPENSE, _FIRST_VAGUE)
        if left is not None and after.vague:
            readings[KeyframeKind.POST_DISPENSE] = left
        return readings

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
            seen = looks.get(kind)
            if not isinstance(seen, Look):
                continue
            off = self._off_exposure(seen)
            _keep(self._usual.lights, seen.light)
            if off:
                continue
            volume = expected.get(kind, 0.0)
            wet = self._wetness(seen)
            if wet is not None:
                self._learn_usual(kind, seen, wet, volume)
            self._take(seen, volume)

    def read_beside(
        self,
        looks: Mapping[KeyframeKind, object],
        expected: Mapping[KeyframeKind, float],
        others: Sequence[Well],
    ) -> Mapping[KeyframeKind, ColumnReading]:
        """Read a well with what ``others`` alone teach: the well itself may have been learned."""
        return self._taught_by(others).read(looks, expected)

    def forget(self, kept: Sequence[Well]) -> None:
        """Keep what these wells teach, and nothing else."""
        self._contrast = self._taught_by(kept)._contrast
        self._usual = _Usual(lights=self._usual.lights)

    def _taught_by(self, wells: Sequence[Well]) -> MeasuredColumns:
        reader = MeasuredColumns()
        reader._heights, reader._fullest = self._heights, self._fullest
        for looks, expected in wells:
            for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
                seen = looks.get(kind)
                if isinstance(seen, Look) and not self._off_exposure(seen):
                    reader._take(seen, expected.get(kind, 0.0))
        return reader

    def _take(self, seen: Look, volume: float) -> None:
        top = self._place(seen.tip, volume)
        # While the tip's inside is known to some per cent only, rows near the top are unsure.
        margin = _NEAR if len(self._heights) >= _ENOUGH else 0.03 + 0.12 * (1.0 - top)
        self._contrast.learn(seen.profile, top, margin)

    def _learn_usual(self, kind: KeyframeKind, seen: Look, wet: Wetness, volume: float) -> None:
        tip, end = seen.tip, _lowest(seen.profile)
        top = self._place(tip, volume)
        if volume > 0:
            self._fullest = max(self._fullest, volume)
            share, weight = wet.mean(top + 0.02, end)
            if weight > 0:
                _keep(self._usual.wet, share - 1.0)
            _keep(self._usual.gaps, wet.longest_gap(top + 0.05, end)[0])
            found = wet.column(ceiling(tip), end)
            reach = _NEAR if len(self._heights) >= _ENOUGH else 0.05 + 0.15 * (1.0 - top)
            if abs(found - top) < reach and wet.power > 4:
                _keep(
                    self._heights,
                    ((1.0 - found) * tip.length_mm, max(float(tip.height_of(volume)), 1.0)),
                )
        else:
            # The worst of a few columns that could have been left, for the worst is looked for.
            heights = _LEFT * (1.0 - self._place(tip, self._fullest))
            shares = [
                share
                for share, weight in (wet.mean(1.0 - height, end) for height in heights)
                if weight > 0
            ]
            if shares:
                _keep(self._usual.dry, max(max(shares), 0.0))

    def _reading(self, kind: KeyframeKind, seen: Look, expected_ul: float) -> ColumnReading | None:
        wet = self._wetness(seen)
        if wet is None:
            return None
        tip, end = seen.tip, _lowest(seen.profile)
        place = self._place(tip, expected_ul)
        found = wet.column(ceiling(tip), end)
        clear = 0.5 / self._variance(wet, full=expected_ul > 0) >= _EVIDENCE
        if not self._contradicts(wet, found, place, end):
            found = place
            if not clear:
                return _FIRST_VAGUE if expected_ul <= 0 else None
        return self._volume(wet, found, place, expected_ul, tip, end)

    def _contradicts(self, wet: Wetness, found: float, place: float, end: float) -> bool:
        """Whether the rows between the column's end and its expected end say that it is off."""
        if abs(min(found, end) - min(place, end)) < _SHORTEST:
            return False
        too_much = found < place
        share, weight = wet.mean(min(found, place) - 1e-6, min(max(found, place), end))
        if weight <= 0:
            return False
        variance = self._variance(wet, full=not too_much) + 1.0 / weight
        towards = share - 0.5 if too_much else 0.5 - share
        return towards / variance >= _EVIDENCE

    def _variance(self, wet: Wetness, *, full: bool) -> float:
        """Of a normal frame's mean wetness."""
        scale, low, high = _PRIOR
        prior = float(np.clip(scale / math.sqrt(max(wet.power, 1e-3)), low, high)) ** 2
        known = self._usual.wet if full else self._usual.dry
        total = _PRIOR_WEIGHT * prior + float(np.sum(np.square(known)))
        return max(total / (_PRIOR_WEIGHT + len(known)), _LEAST_SD**2)

    def _volume(
        self, wet: Wetness, top: float, place: float, expected_ul: float, tip: TipGeometry,
        end: float,
    ) -> ColumnReading:  # fmt: skip
        height = max((1.0 - top) * tip.length_mm / self._scale, 0.0)
        volume = float(tip.volume_of(height)) if top != place else expected_ul
        spread = self._spread_mm
        sigma = float(tip.volume_of(height + spread)) - float(tip.volume_of(height))
        if len(self._heights) < _ENOUGH:
            # The tip's inside is known to some per cent only, until the run has shown it.
            sigma = float(np.hypot(sigma, 0.04 * max(volume, expected_ul)))
        gap, gap_sigma = 0.0, 0.0
        if volume > 0 and expected_ul > 0:
            gap, gap_sigma = self._gap(wet, top, end, tip)
        return ColumnReading(max(volume - gap, 0.0), sigma, gap, gap_sigma, 1.0 - top)

    def _gap(self, wet: Wetness, top: float, end: float, tip: TipGeometry) -> tuple[float, float]:
        """Air in the column and its uncertainty, µL; nothing unless it stands out in this run."""
        strength, upper, lower = wet.longest_gap(top + 0.05, end)
        known = self._usual.gaps
        limit = max(_GAP_LEAST, _GAP_FACTOR * max(known, default=0.0) + 1.0)
        # A liquid that shows faintly is full of what looks like gaps.
        limit = (limit + _GAP_FIRST / max(len(known), 1)) * (1.0 + _GAP_FAINT / max(wet.power, 1.0))
        share, _ = wet.mean(upper - 1e-6, lower + 1e-6)
        if len(known) < _ENOUGH or strength < limit or share > _GAP_SHARE:
            return 0.0, 0.0
        mm = tip.length_mm / self._scale
        air = float(tip.volume_of((1.0 - upper) * mm)) - float(tip.volume_of((1.0 - lower) * mm))
        return air, air * limit / strength / 8.0

    def _pair(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> ColumnReading | None:
        """What this trajectory shows by itself of a column left after its dispense."""
        before = looks.get(KeyframeKind.TRANSIT)
        after = looks.get(KeyframeKind.POST_DISPENSE)
        full = expected.get(KeyframeKind.TRANSIT, 0.0)
        if not isinstance(before, Look) or not isinstance(after, Look) or full <= 0:
            return None
        same_light = 1 / _EXPOSURE < (before.light + 1) / (after.light + 1) < _EXPOSURE
        if not same_light or expected.get(KeyframeKind.POST_DISPENSE, 0.0) > 0:
            return None
        tip = before.tip
        top = column_left(
            before.profile, after.profile, tip, self._place(tip, full) + _NEAR, ceiling(tip)
        )
        if top is None:
            return None
        height = (1.0 - top) * tip.length_mm / self._scale
        volume = float(tip.volume_of(height))
        sigma = float(tip.volume_of(height + 1.0)) - volume
        return ColumnReading(volume, sigma, top=1.0 - top)

    def _wetness(self, seen: Look) -> Wetness | None:
        wet = self._contrast.read(seen.profile, ceiling(seen.tip) - 0.03)
        return wet if wet is not None and wet.weight.any() else None

    def _place(self, tip: TipGeometry, volume_ul: float) -> float:
        """Where a column of this volume should end, u."""
        if volume_ul <= 0:
            return 1.0
        return 1.0 - self._scale * float(tip.height_of(volume_ul)) / tip.length_mm

    def _off_exposure(self, seen: Look) -> bool:
        if len(self._usual.lights) < _ENOUGH:
            return False
        ratio = (seen.light + 1) / (float(np.median(self._usual.lights)) + 1)
        return not 1 / _EXPOSURE < ratio < _EXPOSURE

    @property
    def _scale(self) -> float:
        ratios = [length / wanted for length, wanted in self._heights]
        return float(np.median(ratios)) if len(ratios) >= 2 else 1.0

    @property
    def _spread_mm(self) -> float:
        """How far the meniscus of normal wells stands from where it should, mm."""
        if len(self._heights) < _ENOUGH:
            return 1.0
        scale = self._scale
        residuals = np.array([length - scale * wanted for length, wanted in self._heights])
        return max(1.48 * float(np.median(np.abs(residuals - np.median(residuals)))), 0.4)


def _lowest(profile: TipProfile) -> float:
    """Down to where a column can be told from the orifice's own glints, u."""
    return 1.0 - max(_ORIFICE[0], _ORIFICE[1] / max(profile.length, 1.0))


def _keep(kept: list[T], value: T) -> None:
    kept.append(value)
    del kept[:-_MEMORY]
