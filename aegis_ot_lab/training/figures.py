"""How well a detector does on labelled frames that it has not seen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from aegis_ot.errors import DatasetError
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.types import Image

from .axes import TipLabel
from .recorded import RecordedFrame

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class LabelledFrame:
    """A frame and what should be found in it.

    Attributes:
        image: BGR, ``uint8``, shape ``(height, width, 3)``.
        tips: Box and label of every tip, px; to find any one of them is right.
    """

    image: Image
    tips: tuple[tuple[Box, TipLabel], ...]


@dataclass(frozen=True)
class DetectorFigures:
    """A detector's figures on a set of frames.

    Attributes:
        tip_frames, empty_frames: Frames with and without a tip.
        found: Share of the tip frames with a detection whose box overlaps the true one by more
            than half (intersection over union).
        false_alarms: Detections in frames without a tip.
        map50: Average precision at that overlap, over all confidences; one class, so also the
            mean average precision.
        mean_overlap: Mean intersection over union in tip frames, 0 where nothing was detected.
        orifice_px, collar_px: Median and 95th percentile of the distance from the true end, px.
        lowest_tip, highest_empty: The margin: the first percentile of the confidence in tip
            frames, and the greatest confidence in frames without a tip.
    """

    tip_frames: int
    empty_frames: int
    found: float
    false_alarms: int
    map50: float
    mean_overlap: float
    orifice_px: tuple[float, float]
    collar_px: tuple[float, float]
    lowest_tip: float
    highest_empty: float


def overlap(a: Box, b: Box) -> float:
    """Intersection over union of two boxes ``x, y, w, h``."""
    w = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    h = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    if w <= 0 or h <= 0:
        return 0.0
    return w * h / (a[2] * a[3] + b[2] * b[3] - w * h)


def average_precision(confidences: Sequence[float], hits: Sequence[bool], positives: int) -> float:
    """Area under the interpolated precision-recall curve (all points, as in Pascal VOC 2010).

    Args:
        confidences: Of each detection.
        hits: Whether each detection is right.
        positives: Number of true objects.
    """
    if not positives or not confidences:
        return 0.0
    order = np.argsort(-np.asarray(confidences), kind="stable")
    right = np.cumsum(np.asarray(hits, dtype=float)[order])
    precision = right / np.arange(1, len(right) + 1)
    envelope = np.maximum.accumulate(precision[::-1])[::-1]
    recall = np.concatenate([[0.0], right / positives])
    return float((np.diff(recall) * envelope).sum())


def read_images(frames: Iterable[RecordedFrame]) -> Iterator[LabelledFrame]:
    """The frames of a data set, read one at a time.

    Raises:
        DatasetError: An image cannot be read.
    """
    for frame in frames:
        image = cv2.imread(str(frame.path), cv2.IMREAD_COLOR)
        if image is None:
            raise DatasetError(f"{frame.path.name} is not an image that can be read.")
        if frame.box is None or frame.label is None:
            yield LabelledFrame(image, ())
        else:
            yield LabelledFrame(image, ((frame.box, frame.label),))


def measure(detector: HeatmapDetector, frames: Iterable[LabelledFrame]) -> DetectorFigures:
    """Run a detector over frames and compare."""
    guesses: list[tuple[float, bool]] = []
    overlaps, orifices, collars, tips, empties = [], [], [], [], []
    found = false_alarms = 0
    for frame in frames:
        guess = detector.best_guess(frame.image)
        confidence = guess.confidence if guess else 0.0
        sure = confidence >= detector.threshold
        if not frame.tips:
            empties.append(confidence)
            false_alarms += sure
            if guess:
                guesses.append((confidence, False))
            continue
        tips.append(confidence)
        if guess is None:
            overlaps.append(0.0)
            continue
        box = (guess.x, guess.y, guess.w, guess.h)
        shared, label = max(
            ((overlap(box, _seen(true, frame.image)), label) for true, label in frame.tips),
            key=lambda each: each[0],
        )
        guesses.append((confidence, shared > 0.5))
        overlaps.append(shared if sure else 0.0)
        found += sure and shared > 0.5
        if sure:
            orifices.append(float(np.hypot(*np.subtract(guess.orifice, label.orifice))))
            collars.append(float(np.hypot(*np.subtract(guess.collar, label.collar))))
    return DetectorFigures(
        len(tips),
        len(empties),
        round(found / max(1, len(tips)), 4),
        false_alarms,
        round(
            average_precision([c for c, _ in guesses], [hit for _, hit in guesses], len(tips)), 4
        ),
        round(float(np.mean(overlaps)) if overlaps else 0.0, 3),
        _spread(orifices),
        _spread(collars),
        round(float(np.percentile(tips, 1)) if tips else 0.0, 3),
        round(max(empties, default=0.0), 3),
    )


def _seen(box: Box, image: Image) -> Box:
    """The part of a box that lies in the frame."""
    x0, y0 = max(0.0, box[0]), max(0.0, box[1])
    x1, y1 = min(image.shape[1], box[0] + box[2]), min(image.shape[0], box[1] + box[3])
    return (x0, y0, max(0.0, x1 - x0), max(0.0, y1 - y0))


def choose_threshold(
    tips: Sequence[float], empties: Sequence[float], alarm_cost: float = 2.0
) -> float:
    """The confidence that best parts frames with a tip from frames without one.

    Args:
        tips, empties: Confidences in frames with and without a tip.
        alarm_cost: What a detection where there is no tip costs, in missed tips: a tip that is
            missed goes to the gate, one that is imagined hides a failure.

    Returns:
        The middle of the range of thresholds with the least cost; 0.5 if either kind is missing.
    """
    if not tips or not empties:
        return 0.5
    grid = np.linspace(0.05, 0.95, 181)
    missed = np.array([np.mean(np.asarray(tips) < t) for t in grid])
    alarms = np.array([np.mean(np.asarray(empties) >= t) for t in grid])
    cost = missed + alarm_cost * alarms
    best = grid[cost <= cost.min() + 1e-9]
    return round(float((best[0] + best[-1]) / 2), 3)


def _spread(errors: Sequence[float]) -> tuple[float, float]:
    if not errors:
        return (0.0, 0.0)
    return (round(float(np.median(errors)), 2), round(float(np.percentile(errors, 95)), 2))
