"""One channel of a multi-channel pipette, followed as a single tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...vocabulary import Keyframe
from ..analyser import RunAnalyser
from ..calibration_group import OpenTrajectory
from ..camera import Frame
from ..types import Image, TipDetection, TrajectorySample

NO_FRAME = Frame(b"", np.zeros((0, 0, 3), np.uint8), 0.0)
"""Stands for a frame that says nothing of this channel."""


class _Told:
    """A detector that knows the one tip, because the row was found as a whole."""

    tip: TipDetection | None = None

    def detect(self, image: Image) -> TipDetection | None:
        """The tip that was told of this frame."""
        return self.tip


class Lane(RunAnalyser):
    """Judges what one nozzle delivers.

    It learns from its own wells, as the run of a single-channel pipette does: behind each nozzle
    the frame shows something else. What is asked of the operator is asked for all together.

    Args:
        run: The analyser of the whole run.
        nozzle: ``"A1"``.
    """

    def __init__(self, run: RunAnalyser, nozzle: str) -> None:
        self._told = _Told()
        super().__init__(run.run, self._told, run._make_stream, run._gates, run._first, run._second)
        self._nozzle = nozzle

    def see(self, keyframe: Keyframe, frame: Frame, tip: TipDetection | None) -> None:
        """A keyframe of this channel alone, and where its tip is in the frame."""
        self._told.tip = tip
        self.observe(keyframe, frame)

    def forget(self, trajectory: int) -> None:
        """Nothing more is asked of this trajectory."""
        self._open.pop(trajectory, None)

    def _sample(self, seen: OpenTrajectory) -> TrajectorySample:
        sample = super()._sample(seen)
        return replace(sample, id=f"{sample.id}-{self._nozzle}")
