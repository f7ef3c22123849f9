"""Liquid in the tip as a reading in µL, and a simple reader that needs no model.

The readers of ``aegis_ot.vision.column`` measure better; this one stands behind the same
protocol and serves where they cannot: it compares the brightness profile along the tip with
the run's own empty tips.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .tips import TipGeometry
from .types import Image, TipDetection

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ColumnReading:
    """The liquid column in one frame.

    Attributes:
        volume_ul: Liquid in the tip, breaks left out, µL.
        sigma_ul: Standard uncertainty of it, µL.
        gap_ul: Air enclosed in the column, µL.
        gap_sigma_ul: Standard uncertainty of that, µL.
        top: Upper end of the column as a fraction of the tip's length above the orifice.
        vague: The tip looks empty, but so might a filled one: no proof either way.
    """

    volume_ul: float
    sigma_ul: float
    gap_ul: float = 0.0
    gap_sigma_ul: float = 0.0
    top: float = 0.0
    vague: bool = False


@dataclass(frozen=True)
class TipView:
    """What a reader gets of one keyframe.

    Attributes:
        kind: Which keyframe.
        image: Whole frame.
        detection: The tip in it.
        tip: Its geometry.
        pipette: Short class of the pipette, ``"p1000"``.
        expected_ul: Liquid that should be in it, µL.
    """

    kind: KeyframeKind
    image: Image
    detection: TipDetection
    tip: TipGeometry
    pipette: str
    expected_ul: float


class ColumnReader(Protocol):
    """Measures the columns of one run; made anew for each run."""

    def look(self, view: TipView) -> object:
        """Extract what is needed from a frame, as soon as it arrives; frames are not kept."""

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        """Readings of one trajectory; a keyframe that cannot be read is left out."""

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        """This trajectory was normal: calibrate on it."""


ROWS = 160
"""Rows of a profile, orifice to collar."""

_MEMORY = 24
_NOISE = 2.0
"""Least standard deviation of a profile's row that is believed, grey levels."""


@dataclass(frozen=True)
class Profile:
    """Contrast of the tip's bore against what is beside it, along the axis.

    Attributes:
        contrast: (ROWS, 3), orifice first, BGR, grey levels at the exposure of the frame.
        light: Median brightness of the whole frame: a measure of its exposure.
        tip: Geometry of the tip.
    """

    contrast: Array
    light: float
    tip: TipGeometry


@dataclass(frozen=True)
class _Step:
    """Where liquid ends, in rows above the orifice, and what is enclosed below."""

    top: float
    noise: float
    gap: tuple[int, int] | None


class ProfileReader:
    """Step fit on the profile's difference from the run's empty tips.

    Each row is projected on the direction in colour space that tells this run's liquid from air
    best (Fisher's linear discriminant, with the scatter of rows that hold air). The column's top
    is where the sum of deviations from "liquid below, air above" is least. Heights are mapped to
    the expected ones by the median offset over this run's normal wells.

    Before the first normal well is known, an empty tip is taken from the same trajectory's
    POST_DISPENSE frame, which reads the difference of the two only.
    """

    def __init__(self) -> None:
        self._empty: list[Array] = []
        self._liquid: list[Array] = []
        self._scatter: list[Array] = []
        self._light: list[float] = []
        self._offsets: dict[KeyframeKind, list[float]] = {}

    def look(self, view: TipView) -> Profile:
        light = float(np.median(view.image[::8, ::8]))
        return Profile(profile(view.image, view.detection, view.tip), light, view.tip)

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        full, last = looks.get(KeyframeKind.TRANSIT), looks.get(KeyframeKind.POST_DISPENSE)
        if isinstance(last, Profile) and expected.get(KeyframeKind.POST_DISPENSE, 0.0) <= 0:
            _keep(self._light, last.light)
            _keep(self._empty, self._exposed(last))
            empty = self._empty_contrast()
            if empty is not None and len(self._empty) > 1:
                _keep(self._scatter, _covariance(self._exposed(last) - empty))
        empty = self._empty_contrast()
        if not isinstance(full, Profile) or empty is None:
            return
        difference = self._exposed(full) - empty
        volume = expected.get(KeyframeKind.TRANSIT, 0.0)
        below, above = _rows_below(full.tip, 0.8 * volume), _rows_below(full.tip, 1.4 * volume)
        free = int(full.tip.free_mm / full.tip.length_mm * ROWS)
        if below >= 5:
            _keep(self._liquid, np.median(difference[:below], axis=0))
        if free - above >= 10:
            _keep(self._scatter, _covariance(difference[above:free]))
        for kind, step in self._steps(looks, expected).items():
            wanted = full.tip.height_of(expected.get(kind, 0.0)) / full.tip.length_mm * ROWS
            self._offsets.setdefault(kind, [])
            _keep(self._offsets[kind], step.top - wanted)

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        readings: dict[KeyframeKind, ColumnReading] = {}
        for kind, step in self._steps(looks, expected).items():
            look = looks[kind]
            if isinstance(look, Profile):
                readings[kind] = self._reading(kind, step, look.tip)
        return readings

    def _steps(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> dict[KeyframeKind, _Step]:
        last = looks.get(KeyframeKind.POST_DISPENSE)
        full = looks.get(KeyframeKind.TRANSIT)
        empty = self._empty_contrast()
        if empty is None and isinstance(last, Profile):
            empty = self._exposed(last)
        if empty is None:
            return {}
        scatter = np.diag([_NOISE**2] * 3)
        if self._scatter:
            scatter = scatter + np.median(self._scatter, axis=0)
        if self._liquid:
            liquid = np.median(self._liquid, axis=0)
        elif isinstance(full, Profile):
            below = _rows_below(full.tip, 0.6 * expected.get(KeyframeKind.TRANSIT, 0.0))
            liquid = np.median((self._exposed(full) - empty)[: max(below, 5)], axis=0)
        else:
            return {}
        steps: dict[KeyframeKind, _Step] = {}
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
            look = looks.get(kind)
            if not isinstance(look, Profile) or (look is last and not self._empty):
                continue
            step = _fit(self._exposed(look) - empty, liquid, scatter, look.tip)
            if step is not None:
                steps[kind] = step
        return steps

    def _reading(self, kind: KeyframeKind, step: _Step, tip: TipGeometry) -> ColumnReading:
        offsets = self._offsets.get(kind, [])
        offset = float(np.median(offsets)) if len(offsets) >= 2 else 0.0
        spread = 3.0
        if len(offsets) >= 3:
            spread = max(1.48 * float(np.median(np.abs(np.array(offsets) - offset))), 0.7)
        sigma_rows = float(np.hypot(spread, 2.0 * step.noise))
        mm = tip.length_mm / ROWS
        rows = max(step.top - offset, 0.0)
        volume = float(tip.volume_of(rows * mm))
        sigma = float(tip.volume_of((rows + sigma_rows) * mm)) - volume
        gap = 0.0
        if step.gap is not None:
            start, end = step.gap
            gap = float(tip.volume_of(end * mm)) - float(tip.volume_of(start * mm))
        return ColumnReading(max(volume - gap, 0.0), sigma, gap, sigma, rows / ROWS)

    def _exposed(self, look: Profile) -> Array:
        """Contrast at the run's usual exposure."""
        usual = float(np.median(self._light)) if self._light else look.light
        return look.contrast * (usual / max(look.light, 1.0))

    def _empty_contrast(self) -> Array | None:
        return np.median(self._empty, axis=0) if self._empty else None


def _keep(kept: list[Any], value: Any) -> None:
    kept.append(value)
    del kept[:-_MEMORY]


def _covariance(rows: Array) -> Array:
    return np.asarray(rows.T @ rows / max(len(rows), 1))


def profile(image: Image, detection: TipDetection, tip: TipGeometry) -> Array:
    """Contrast of the bore along the tip axis, (ROWS, 3), orifice first."""
    orifice = np.array(detection.orifice, dtype=np.float64)
    collar = np.array(detection.collar, dtype=np.float64)
    along = collar - orifice
    length = float(np.hypot(*along)) or 1.0
    across = np.array([-along[1], along[0]]) / length
    px_per_mm = length / tip.length_mm
    u = (np.arange(ROWS) + 0.5) / ROWS
    heights = u * tip.length_mm
    inner = np.maximum(np.asarray(tip.inner_radius(heights)) * px_per_mm, 0.5)
    outer = np.asarray(tip.outer_radius(heights)) * px_per_mm
    inside = np.linspace(-0.6, 0.6, 5)[None, :] * inner[:, None]
    beside = np.linspace(2.0, 5.0, 4)[None, :] + 1.3 * outer[:, None]
    offsets = np.concatenate([inside, beside, -beside], axis=1)
    centre = orifice[None, :] + u[:, None] * along[None, :]
    xs = centre[:, :1] + offsets * across[0] - 0.5
    ys = centre[:, 1:] + offsets * across[1] - 0.5
    pixels = cv2.remap(
        image,
        xs.astype(np.float32),
        ys.astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)
    bore = pixels[:, :5].mean(axis=1)
    return np.asarray(bore - np.median(pixels[:, 5:], axis=1))


def _rows_below(tip: TipGeometry, volume_ul: float) -> int:
    return int(tip.height_of(max(volume_ul, 0.0)) / tip.length_mm * ROWS)


def _fit(difference: Array, liquid: Array, scatter: Array, tip: TipGeometry) -> _Step | None:
    """Step fit; ``None`` where liquid and air look alike in this run."""
    free = int(tip.free_mm / tip.length_mm * ROWS)
    direction = np.linalg.solve(scatter, liquid)
    strength = float(liquid @ direction)
    if strength < 1.0:
        return None
    # One row that a glint or labware behind the tip spoils must not outvote the others.
    signal = np.clip(difference[:free] @ direction / strength, -0.5, 1.5)
    noise = float(1.0 / np.sqrt(strength))
    cost = np.concatenate([[0.0], np.cumsum(1.0 - 2.0 * signal)])
    top = int(np.argmin(cost))
    rows = float(top)
    if 0 < top < free:
        low = max(top - 4, 0)
        rows = low + float(np.clip(signal[low : top + 4], 0.0, 1.0).sum())
    return _Step(rows, noise, _longest_gap(signal[:top]))


def _longest_gap(signal: Array) -> tuple[int, int] | None:
    """Rows (start, end) of the strongest break in a column, or ``None``."""
    if len(signal) < 12:
        return None
    best, best_span, start, total = 0.0, None, 0, 0.0
    for row, value in enumerate(0.5 - signal[4:-4]):
        if total <= 0:
            start, total = row, 0.0
        total += float(value)
        if total > best:
            best, best_span = total, (start + 4, row + 5)
    return best_span if best > 1.5 else None
