"""One channel of a multi-channel pipette, followed as a single tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...vocabulary import Keyframe
from ..analyser import RunAnalyser
from ..camera import Frame
from ..stream import OpenTrajectory
from ..types import Image, TipDetection, TrajectorySample

NO_FRAME = Frame(b"", np.zeros((0, 0, 3), np.uint8), 0.0)
"""Stands for a frame that says nothing of this channel."""


class _Told:
    """A detector that knows one tip of each frame, because the row was found as a whole."""

    def __init__(self) -> None:
        self._known: dict[int, list[tuple[Image, TipDetection | None]]] = {}

    def tell(self, trajectory: int, image: Image, tip: TipDetection | None) -> None:
        """Where the tip is in a frame of a trajectory."""
        self._known.setdefault(trajectory, []).append((image, tip))

    def forget(self, trajectory: int) -> None:
        """Its frames will not be asked about again."""
        self._known.pop(trajectory, None)

    def detect(self, image: Image) -> TipDetection | None:
        """The tip that was told of this frame."""
        known = (pair for pairs in self._known.values() for pair in pairs)
        return next((tip for one, tip in known if one is image), None)

    best_guess = detect


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
        # Its own view of the same pixels: what is measured in a frame is kept by the frame.
        own = replace(frame, image=frame.image.view())
        self._told.tell(keyframe.trajectory, own.image, tip)
        self.observe(keyframe, own)

    def forget(self, trajectory: int) -> None:
        """Nothing more is asked of this trajectory."""
        self._open.pop(trajectory, None)
        self._told.forget(trajectory)

    def _sample(self, seen: OpenTrajectory) -> TrajectorySample:
        sample = super()._sample(seen)
        return replace(sample, id=f"{sample.id}-{self._nozzle}")
