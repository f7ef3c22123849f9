"""One channel of a multi-channel pipette, followed as a single tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...vocabulary import Keyframe
from ..analyser import RunAnalyser
from ..camera import Frame
from ..consistency import TipConsistency
from ..stream import OpenTrajectory, Stream
from ..types import Image, TipDetection, TrajectorySample

NO_FRAME = Frame(b"", np.zeros((0, 0, 3), np.uint8), 0.0)
"""Stands for a frame that says nothing of this channel."""


class _Told:
    """A detector that knows one tip of each frame, because the row was found as a whole."""

    def __init__(self) -> None:
        self._known: list[tuple[Image, TipDetection | None]] = []

    def tell(self, image: Image, tip: TipDetection | None) -> None:
        self._known.append((image, tip))

    def forget(self, images: list[Image]) -> None:
        self._known = [
            known for known in self._known if not any(known[0] is image for image in images)
        ]

    def detect(self, image: Image) -> TipDetection | None:
        return next((tip for known, tip in self._known if known is image), None)

    best_guess = detect


class Lane(RunAnalyser):
    """Judges what one nozzle delivers.

    Liquids, bands and column heights are learned together with the other nozzles, for their tips
    are alike. Where the tip hangs in the frame is its own, and what a failure left in it.

    Args:
        run: The analyser of the whole run.
        nozzle: ``"A1"``.
    """

    def __init__(self, run: RunAnalyser, nozzle: str) -> None:
        self._told = _Told()
        super().__init__(
            run.run, self._told, run._make_stream, run._gates, run._first, run._second
        )
        self._streams = run._streams
        self._nozzle = nozzle
        self._own_tip: dict[int, TipConsistency] = {}

    def see(self, keyframe: Keyframe, frame: Frame, tip: TipDetection | None) -> None:
        """A keyframe of this channel alone, and where its tip is in the frame."""
        self._told.tell(frame.image, tip)
        self.observe(keyframe, frame)

    def forget(self, trajectory: int) -> None:
        """Nothing more is asked of this trajectory's frames."""
        seen = self._open.pop(trajectory, None)
        if seen is not None:
            self._told.forget(list(seen.frames.values()))

    def done(self, frames: list[Image]) -> None:
        """The trajectory that these frames belong to has been judged."""
        self._told.forget(frames)

    def frames_of(self, trajectory: int) -> list[Image]:
        """The frames that are kept of a trajectory."""
        seen = self._open.get(trajectory)
        return [] if seen is None else list(seen.frames.values())

    def _tip(self, stream: Stream) -> TipConsistency:
        # Liquids of one pipette share their stream's tip: so they do here.
        return self._own_tip.setdefault(id(stream.tip), TipConsistency())

    def _sample(self, trajectory: int, seen: OpenTrajectory) -> TrajectorySample:
        sample = super()._sample(trajectory, seen)
        return replace(sample, id=f"{sample.id}-{self._nozzle}")
