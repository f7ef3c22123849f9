"""Frames of the simulated camera as training material."""

from __future__ import annotations

import numpy as np

from aegis_ot.simulation import FrameTruth, TipTruth

from ..drawing import random_frames
from .axes import TipLabel
from .frame_pool import other_camera
from .photometry import photograph
from .strokes import Image

_MOST_HIDDEN = 0.4  # share of the tip behind labware from which a frame teaches nothing
_PIPETTES = (
    *("p1000", "p300", "p20", "p10", "flex_1channel_50", "flex_1channel_1000"),
    *("p300_multi_gen2", "p20_multi_gen2"),
)


class SimulatedFrames:
    """Draws training frames from the simulator; the seed fixes the sequence.

    Args:
        seed: Of the simulated sessions.
    """

    def __init__(self, seed: int) -> None:
        self._frames = random_frames(
            seed, pipettes=_PIPETTES, frames_per_session=3, measured=0.3, without_tip=0.2
        )

    def draw(self, rng: np.random.Generator) -> tuple[Image, TipLabel | None, TipLabel | None]:
        """A frame, its tip, and where a tip is missing from a bare nozzle."""
        while True:
            image, truth = next(self._frames)
            if truth.tip.hidden <= _MOST_HIDDEN:
                break
        place = _label(truth)
        label, missing = (place, None) if truth.box is not None else (None, place)
        if rng.random() < 0.4:
            return other_camera(rng, image, label, missing)
        return photograph(rng, image, float(rng.uniform(0.1, 0.6))), label, missing


def _label(truth: FrameTruth) -> TipLabel:
    front = _axis(truth.tip)
    beside = [
        _axis(tip)
        for number, tip in enumerate(truth.tips)
        if number != truth.front and tip.box is not None and tip.hidden <= _MOST_HIDDEN
    ]
    return TipLabel(front.collar, front.orifice, front.radius, tuple(beside))


def _axis(tip: TipTruth) -> TipLabel:
    length = float(np.hypot(*np.subtract(tip.orifice, tip.collar)))
    lean = abs(tip.orifice[0] - tip.collar[0])
    # Half the width of the box, less what the axis' lean adds to it.
    radius = (tip.box[2] - lean) / 2 if tip.box is not None else 0.055 * length
    return TipLabel(
        (float(tip.collar[0]), float(tip.collar[1])),
        (float(tip.orifice[0]), float(tip.orifice[1])),
        max(1.0, float(radius)),
    )
