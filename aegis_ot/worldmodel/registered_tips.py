"""The tips of a data set, located plate by plate by where the robot said they were."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..vision.registration import TipLocator
from ..vision.types import FREE, TipDetection, TrajectorySample
from ..vocabulary import KeyframeKind


def located_tips(
    plate: Sequence[TrajectorySample], locator: TipLocator
) -> dict[str, Mapping[KeyframeKind, TipDetection | None]]:
    """The tips of one plate's trajectories, in the order in which they were pipetted."""
    return {
        sample.id: {
            kind: locator.locate(
                sample.frames[kind], sample.positions.get(kind), sample.tip.name, kind not in FREE
            ).detection
            for kind in KeyframeKind
        }
        for sample in plate
    }
