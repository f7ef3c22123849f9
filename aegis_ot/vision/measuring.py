"""Liquid in the tip as a reading in µL, and a simple reader that needs no model.

The readers of ``aegis_ot.vision.column`` measure better; this one stands behind the same
protocol and serves where they cannot: it compares the brightness profile along the tip with
the run's own empty tips.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

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
    """

    volume_ul: float
    sigma_ul: float
    gap_ul: float = 0.0
    gap_sigma_ul: float = 0.0
    top: float = 0.0


@dataclass(frozen=True)
class TipView:
    """What a reader gets of one keyframe.

    Attributes:
        kind: Which keyframe.
        image: Whole frame.
        detection: The tip in it.
        tip: Its geometry.
        expected_ul: Liquid that should be in it, µL.
    """

    kind: KeyframeKind
    image: Image
    detection: TipDetection
    tip: TipGeometry
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


@dataclass(frozen=True)
class Profile:
    """Contrast of the tip's bore against what is beside it, along the axis.

    Attributes:
        contrast: (ROWS, 3), orifice first, BGR, grey levels.
        tip: Geometry of the tip.
    """

    contrast: Array
    tip: TipGeometry


class ProfileReader:
    """Step fit on the profile's difference from the run's empty tips.

    The column's top is where the sum of squared deviations from "liquid below, air above" is
    least. Before the first normal well is known, an empty tip is taken from the same
    trajectory's POST_DISPENSE frame, which reads the difference of the two only.
    """

    def __init__(self) -> None:
        self._empty: list[Array] = []
        self._liquid: list[Array] = []

    def look(self, view: TipView) -> Profile:
        return Profile(profile(view.image, view.detection, view.tip), view.tip)

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        for kind, look in looks.items():
            if not isinstance(look, Profile):
                continue
            if kind is KeyframeKind.POST_DISPENSE and expected.get(kind, 0.0) <= 0:
                self._empty.append(look.contrast)
                del self._empty[:-24]
        full, empty = looks.get(KeyframeKind.TRANSIT), self._empty_contrast()
        if isinstance(full, Profile) and empty is not None:
            below = _rows_below(full.tip, 0.8 * expected[KeyframeKind.TRANSIT])
            if below >= 3:
                self._liquid.append((full.contrast - empty)[:below].mean(axis=0))
                del self._liquid[:-24]

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        readings: dict[KeyframeKind, ColumnReading] = {}
        last = looks.get(KeyframeKind.POST_DISPENSE)
        full = looks.get(KeyframeKind.TRANSIT)
        empty = self._empty_contrast()
        if empty is None and isinstance(last, Profile):
            empty = last.contrast
        if empty is None:
            return readings
        if self._liquid:
            liquid = np.median(self._liquid, axis=0)
        elif isinstance(full, Profile):
            below = _rows_below(full.tip, 0.6 * expected.get(KeyframeKind.TRANSIT, 0.0))
            liquid = (full.contrast - empty)[: max(below, 3)].mean(axis=0)
        else:
            return readings
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE):
            look = looks.get(kind)
            if not isinstance(look, Profile) or (look is last and not self._empty):
                continue
            reading = _fit(look.contrast - empty, liquid, look.tip)
            if reading is not None:
                readings[kind] = reading
        return readings

    def _empty_contrast(self) -> Array | None:
        return np.median(self._empty, axis=0) if self._empty else None


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


def _fit(difference: Array, liquid: Array, tip: TipGeometry) -> ColumnReading | None:
    """Step fit; ``None`` where liquid and air look alike in this run."""
    free = int(tip.free_mm / tip.length_mm * ROWS)
    strength = float(liquid @ liquid)
    if strength <= 0:
        return None
    signal = (difference[:free] @ liquid) / strength
    # Successive differences see noise only, whatever the column's length.
    noise = float(np.median(np.abs(np.diff(signal))) / 0.954) + 1e-6
    if noise > 0.5:
        return None
    cost = np.concatenate([[0.0], np.cumsum(1.0 - 2.0 * signal)])
    top = int(np.argmin(cost))
    rows = float(top)
    if 0 < top < free:
        window = signal[max(top - 4, 0) : min(top + 4, free)]
        rows = max(top - 4, 0) + float(np.clip(window, 0.0, 1.0).sum())
    enclosed = _longest_gap(signal[:top])
    mm = tip.length_mm / ROWS
    volume = float(tip.volume_of(rows * mm))
    sigma_rows = 1.0 + 4.0 * noise
    sigma = float(tip.volume_of((rows + sigma_rows) * mm) - volume)
    gap = 0.0
    if enclosed is not None:
        start, end = enclosed
        gap = float(tip.volume_of(end * mm) - tip.volume_of(start * mm))
    return ColumnReading(volume - gap, sigma, gap, sigma, rows / ROWS)


def _longest_gap(signal: Array) -> tuple[int, int] | None:
    """Rows (start, end) of the strongest break in a column, or ``None``."""
    if len(signal) < 8:
        return None
    best, best_span, start, total = 0.0, None, 0, 0.0
    for row, value in enumerate(0.5 - signal[3:-3]):
        if total <= 0:
            start, total = row, 0.0
        total += value
        if total > best:
            best, best_span = total, (start + 3, row + 4)
    return best_span if best_span is not None and best > 1.5 else None
