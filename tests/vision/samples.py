"""Small drawn trajectories for tests: a bright tip, a dark column, exact detections."""

from __future__ import annotations

import cv2
import numpy as np

from aegis_ot.vision.types import TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

VOLUMES = {
    KeyframeKind.ASPIRATE: 1.0,
    KeyframeKind.TRANSIT: 1.0,
    KeyframeKind.DISPENSE: 0.0,
    KeyframeKind.POST_DISPENSE: 0.0,
}


def frame(fill: float, rng: np.random.Generator, *, tip: bool = True) -> np.ndarray:
    """A 160x120 frame with a tip filled to ``fill`` of its length."""
    image = np.full((160, 120, 3), 60, dtype=np.uint8)
    if tip:
        cv2.rectangle(image, (52, 30), (68, 130), (170, 170, 170), -1)
        if fill > 0:
            cv2.rectangle(image, (54, int(130 - 100 * fill)), (66, 130), (40, 40, 160), -1)
    noise = rng.normal(0, 2, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8)


def sample(
    name: str = "s1",
    *,
    plate: str = "p1",
    seed: int = 0,
    left: float = 0.0,
    drawn: float = 0.5,
    tip: bool = True,
    failure: str = "",
) -> TrajectorySample:
    """One trajectory: ``drawn`` and ``left`` are column lengths in tip lengths."""
    rng = np.random.default_rng(seed)
    fills = {kind: drawn if VOLUMES[kind] else left for kind in KeyframeKind}
    detection = TipDetection(50, 28, 20, 104, 1.0, (60.0, 131.0), (60.0, 29.0)) if tip else None
    return TrajectorySample(
        id=name,
        plate=plate,
        well="A1",
        pipette="p1000",
        volume_ul=100.0,
        frames={kind: frame(fills[kind], rng, tip=tip) for kind in KeyframeKind},
        detections=dict.fromkeys(KeyframeKind, detection),
        expected_ul={kind: 100.0 * VOLUMES[kind] for kind in KeyframeKind},
        reagent="red",
        label="failure" if failure else "normal",
        failure_type=failure,
        retained_fraction=None,
    )
