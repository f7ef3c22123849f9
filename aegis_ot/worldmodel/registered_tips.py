"""The tips of a data set, located plate by plate by where the robot said they were."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence

from ..errors import StoreError
from ..vision.registration import TipLocator
from ..vision.types import FREE, Detector, TipDetection, TrajectorySample
from ..vocabulary import KeyframeKind

_LEARNED_FROM = 8
"""Wells from which a camera is registered: four tips each, as many as a locator learns from."""


def learned_locator(plate: Sequence[TrajectorySample], detector: Detector) -> TipLocator:
    """A locator that knows the camera before the first frame: the plate is done, and its tips are
    read again. Recorded frames that are missing or damaged teach it nothing."""
    locator = TipLocator(detector)
    for sample in [one for one in plate if one.positions][:_LEARNED_FROM]:
        with contextlib.suppress(StoreError):
            located_tips([sample], locator)
    return locator


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
