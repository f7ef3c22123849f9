"""The column package as the column reader of a run: what is usual is learned from its normals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .column import (
    ColumnMeasurement,
    Dye,
    Reference,
    TipProfile,
    combine,
    expected_top,
    mean_dye,
    read_column,
)
from .measuring import ColumnReading, TipView
from .scorers.looks import look
from .tips import TipGeometry

T = TypeVar("T")
Rows = NDArray[np.float32]

_MEMORY = 48
_ENOUGH = 4
"""Normal wells from which the run's own spread is taken for real."""

_SEEN = 4.5
"""Evidence (log-likelihood ratio) from which there is a column where none should be."""

_SEEN_AT_FIRST = 20.0
"""The same in the run's first wells: menisci and edges of labware alone do not reach it."""

_NEAR = 0.04
"""A meniscus this close to its expected place is the expected one, tip lengths."""

_GAP_LEAST = 2.0
_GAP_FACTOR = 1.6
_GAP_WELLS = 8
"""A break counts from this strength, and from this multiple of the strongest "break" in this
run's normal columns of about the same volume, once there are so many of them."""

_SAME_COLUMN = {KeyframeKind.POST_DISPENSE: KeyframeKind.DISPENSE}


@dataclass(frozen=True)
class Look:
    """Signals of one frame."""

    profile: TipProfile
    tip: TipGeometry
    light: float = 0.0
    """Median brightness of the whole frame: the pipette covers little of it."""


@dataclass(frozen=True)
class _Found:
    """One column: what the frame says, and how it stands to what is expected.

    Attributes:
        look: The signals.
        measured: The frame's own measurement (its gap, its dye).
        evidence: Evidence by row, what is usual at each row in this run taken off.
        raw: The same with nothing taken off.
        place: Where the expected column should end, tip lengths below the collar.
        near: Largest raw evidence about there; minus infinity where nothing is expected.
        row: Row of the largest evidence elsewhere.
        witness: Largest evidence about there in the ASPIRATE frame, where that has to stand in
            for a frame at another exposure.
    """

    look: Look
    measured: ColumnMeasurement
    evidence: Rows
    raw: Rows
    place: float
    near: float
    row: int
    witness: float | None = None


class MeasuredColumns:
    """Measures the columns of one run with ``aegis_ot.vision.column``.

    Normal wells teach it the reagent's colour, how high columns stand in this run's frames
    against what the tip's geometry says, what every row of an empty tip looks like here (an edge
    of labware behind the tip looks like a meniscus, in every well), and how clearly full tips
    show at all. Where full tips hardly show (water), a tip that looks empty proves nothing, and
    is not read.
    """

    def __init__(self) -> None:
        self._dyes: list[Dye] = []
        self._heights: list[tuple[float, float]] = []
        self._near: list[tuple[float, float]] = []
        self._stray: dict[KeyframeKind, list[float]] = {}
        self._gaps: list[tuple[float, float]] = []
        self._lights: list[float] = []
        self._usual: dict[KeyframeKind, list[Rows]] = {}

    def share_tip(self, other: object) -> None:
        """Learn the tip's geometry together with the reader of another liquid."""
        if isinstance(other, MeasuredColumns):
            self._heights = other._heights

    def look(self, view: TipView) -> Look:
        # Shared with the scorers: each frame is straightened once.
        profile = look(view.image, view.detection, view.pipette).profile
        return Look(profile, view.tip, float(np.median(view.image[::16, ::16])))

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        readings: dict[KeyframeKind, ColumnReading] = {}
        for kind, found in self._find(looks, expected).items():
            reading = self._reading(kind, found, expected.get(kind, 0.0))
            if reading is not None:
                readings[kind] = reading
        return readings

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        for kind, found in self._find(looks, expected).items():
            volume = expected.get(kind, 0.0)
            _keep(self._lights, found.look.light)
            rows = found.raw.copy()
            u = found.measured.profile.u
            if volume > 0:
                rows[np.abs(u - found.place) < 2 * _NEAR] = np.nan
                _keep(self._near, (volume, found.near))
                self._learn_height(found, volume)
                _keep(self._dyes, found.measured.dye)
                if found.measured.gap is not None:
                    _keep(self._gaps, (volume, found.measured.gap.strength))
            _keep(self._usual.setdefault(kind, []), rows)
            apart = found.evidence[np.isfinite(rows)]
            _keep(self._stray.setdefault(kind, []), float(apart.max(initial=0.0)))

    def _learn_height(self, found: _Found, volume: float) -> None:
        u, tip = found.measured.profile.u, found.look.tip
        close = np.abs(u - found.place) < (_NEAR if len(self._heights) >= _ENOUGH else 2 * _NEAR)
        if not close.any() or found.near <= 0:
            return
        row = int(np.argmax(np.where(close, found.raw, -np.inf)))
        length = (1.0 - float(u[row])) * tip.length_mm
        wanted = float(tip.height_of(volume))
        _keep(self._heights, (length, max(wanted, 1.0)))

    @property
    def _scale(self) -> float:
        ratios = [length / wanted for length, wanted in self._heights]
        return float(np.median(ratios)) if len(ratios) >= 2 else 1.0

    def _find(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> dict[KeyframeKind, _Found]:
        reference = Reference(dye=mean_dye(self._dyes), height_scale=self._scale)
        found: dict[KeyframeKind, _Found] = {}
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
            first = looks.get(kind)
            if not isinstance(first, Look):
                continue
            volume = expected.get(kind, 0.0)
            measured = read_column(first.profile, first.tip, volume, reference)
            raw = measured.evidence
            partner = _SAME_COLUMN.get(kind)
            second = looks.get(partner) if partner else None
            if (
                partner is not None
                and isinstance(second, Look)
                and math.isclose(expected.get(partner, -1.0), volume)
            ):
                support = read_column(second.profile, second.tip, volume, reference).evidence
                if support.shape == raw.shape:
                    raw = combine(raw, support)
            evidence = raw - self._usual_rows(kind, raw)
            u = first.profile.u
            place, near = 1.0, -math.inf
            elsewhere = np.ones(len(u), dtype=bool)
            if volume > 0:
                place = expected_top(first.tip, volume, reference)
                close = np.abs(u - place) < _NEAR
                near = float(raw[close].max(initial=-math.inf))
                elsewhere = ~close
            row = int(np.argmax(np.where(elsewhere, evidence, -np.inf)))
            witness = None
            if volume > 0 and self._off_exposure(first):
                witness = self._at_aspirate(looks, expected, volume, place, reference)
            found[kind] = _Found(first, measured, evidence, raw, place, near, row, witness)
        return found

    def _off_exposure(self, look: Look) -> bool:
        if len(self._lights) < _ENOUGH:
            return False
        ratio = look.light / max(float(np.median(self._lights)), 1.0)
        return not 1 / 1.4 < ratio < 1.4

    def _at_aspirate(
        self,
        looks: Mapping[KeyframeKind, object],
        expected: Mapping[KeyframeKind, float],
        volume: float,
        place: float,
        reference: Reference,
    ) -> float | None:
        """Evidence of the ASPIRATE frame where the column should end."""
        look = looks.get(KeyframeKind.ASPIRATE)
        same = math.isclose(expected.get(KeyframeKind.ASPIRATE, -1.0), volume)
        if not isinstance(look, Look) or not same:
            return None
        rows = read_column(look.profile, look.tip, volume, reference).evidence
        return float(rows[np.abs(look.profile.u - place) < _NEAR].max(initial=-math.inf))

    def _usual_rows(self, kind: KeyframeKind, like: Rows) -> Rows:
        """What is usual at each row where no column ends, and near it; never negative."""
        known = [rows for rows in self._usual.get(kind, []) if rows.shape == like.shape]
        if len(known) < _ENOUGH:
            return np.zeros_like(like)
        stack = np.stack(known)
        seen = np.isfinite(stack).sum(axis=0) >= 3
        filled = np.where(np.isfinite(stack), stack, 0.0)
        usual = np.where(seen, np.percentile(filled, 85, axis=0), 0.0)
        wide = cv2.dilate(np.maximum(usual, 0.0)[:, None], np.ones((7, 1), np.uint8))[:, 0]
        return np.asarray(wide, dtype=np.float32)

    def _reading(
        self, kind: KeyframeKind, found: _Found, expected_ul: float
    ) -> ColumnReading | None:
        top = self._top(found, expected_ul, self._limit(kind))
        if top is None:
            # Nothing speaks for a column where none should be, in a liquid that hardly shows.
            return ColumnReading(0.0, math.inf, vague=True) if expected_ul <= 0 else None
        tip = found.look.tip
        height = max((1.0 - top) * tip.length_mm / self._scale, 0.0)
        volume = float(tip.volume_of(height))
        spread = self._spread_mm
        if expected_ul > 0 and abs(top - found.place) < _NEAR:
            # A meniscus seen where it is due is no farther off than the search reaches.
            reach = _NEAR * tip.length_mm
            spread = float(np.clip(spread, reach / 3, reach / 2))
        sigma = float(tip.volume_of(height + spread)) - volume
        if len(self._heights) < _ENOUGH:
            # The tip's inside is known to some per cent only, until the run has shown it.
            sigma = float(np.hypot(sigma, 0.1 * max(volume, expected_ul)))
        gap, gap_sigma = self._gap(found, tip, height) if volume > 0 else (0.0, sigma)
        return ColumnReading(max(volume - gap, 0.0), sigma, gap, gap_sigma, 1.0 - top)

    def _limit(self, kind: KeyframeKind) -> float:
        """Evidence from which a column stands where none should: more than any normal showed."""
        stray = self._stray.get(kind, [])
        if len(stray) < _ENOUGH:
            return _SEEN_AT_FIRST
        # Not the largest: a failed well that passed unseen must not blind the reader for good.
        most = max(_SEEN, float(np.percentile(stray, 95)) + 4.0)
        # A column left over shows less than a full one, but of that order.
        most = max(most, 0.5 * float(np.median([near for _, near in self._near] or [0.0])))
        # A handful of wells has not shown the worst that is normal here.
        return most + (_SEEN_AT_FIRST - _SEEN) / len(stray)

    def _top(self, found: _Found, expected_ul: float, seen: float) -> float | None:
        """Where the column ends, 1 for none, or ``None`` if that cannot be told here."""
        u = found.measured.profile.u
        strongest = float(found.evidence[found.row])
        clear = self._clear
        if expected_ul <= 0:
            if strongest >= seen:
                # Colour says that there is liquid better than where it ends, and a low end
                # explains less of what is seen: the highest end that is nearly as likely.
                likely = np.flatnonzero(found.evidence >= max(seen, strongest - 3.0))
                return float(u[likely[0]])
            return 1.0 if clear else None
        # Short columns show less than tall ones: only wells of about this volume compare.
        alike = [near for volume, near in self._near if volume <= 1.5 * expected_ul]
        weakest = 0.0
        if len(alike) >= _ENOUGH:
            middle = float(np.median(alike))
            weakest = min(alike) - 1.0 - 0.5 * (middle - min(alike))
        blank = clear and found.near < 0
        if found.near >= min(weakest, 3.0) or (found.near >= strongest and not blank):
            close = np.abs(u - found.place) < _NEAR
            return float(u[int(np.argmax(np.where(close, found.raw, -np.inf)))])
        if strongest >= max(seen, found.near + seen):
            return float(u[found.row])
        if found.witness is not None:
            # A camera overexposes a frame now and then, and nothing is to be seen in it.
            return found.place if found.witness >= _SEEN else None
        return 1.0 if clear and len(alike) >= _ENOUGH and found.near < 0 else None

    @property
    def _clear(self) -> bool:
        """Whether full tips show well in this run."""
        shown = [near for _, near in self._near]
        return len(shown) >= _ENOUGH and float(np.median(shown)) >= 2 * _SEEN

    @property
    def _spread_mm(self) -> float:
        """How far the meniscus of normal wells stands from where it should, mm."""
        if len(self._heights) < _ENOUGH:
            return 1.0
        scale = self._scale
        residuals = np.array([length - scale * wanted for length, wanted in self._heights])
        return max(1.48 * float(np.median(np.abs(residuals - np.median(residuals)))), 0.5)

    def _gap(self, found: _Found, tip: TipGeometry, height: float) -> tuple[float, float]:
        """Air in the column and its uncertainty; nothing unless it stands out in this run."""
        gap = found.measured.gap
        volume = float(tip.volume_of(height))
        alike = [g for other, g in self._gaps if 0.7 < other / max(volume, 1e-6) < 1.4]
        if gap is None or not self._clear or len(alike) < _GAP_WELLS:
            return 0.0, 0.0
        mm = tip.length_mm / self._scale
        low, high = (1.0 - gap.bottom) * mm, (1.0 - gap.top) * mm
        air = float(tip.volume_of(min(high, height))) - float(tip.volume_of(max(low, 0.0)))
        # Few wells have not shown the worst that is normal.
        factor = _GAP_FACTOR + 1.5 / len(alike)
        limit = max(_GAP_LEAST, factor * float(np.max(alike)))
        if air <= 0 or gap.strength < limit:
            return 0.0, 0.0
        return air, air * limit / gap.strength / 8.0


def _keep(kept: list[T], value: T) -> None:
    kept.append(value)
    del kept[:-_MEMORY]
