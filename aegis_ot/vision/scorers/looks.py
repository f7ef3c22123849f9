"""The looks that the column and patch scorers share, taken once per frame."""

from __future__ import annotations

import weakref
from collections.abc import Mapping

from ...vocabulary import KeyframeKind
from ..column import TipLook, look_at_tip
from ..crops import remember
from ..types import Image, TipDetection, TrajectorySample

_taken: dict[int, tuple[weakref.ref[Image], TipDetection, str, TipLook]] = {}


def look(image: Image, detection: TipDetection, pipette: str) -> TipLook:
    """:func:`look_at_tip`, once for as long as the frame lives.

    A live run calls it as each frame arrives, so that little is left to do after the last one.
    """
    known = _taken.get(id(image))
    if known is not None and known[0]() is image and known[1:3] == (detection, pipette):
        return known[3]
    taken = look_at_tip(image, detection, pipette)
    key = id(image)
    _taken[key] = (weakref.ref(image, lambda _: _taken.pop(key, None)), detection, pipette, taken)
    return taken


def looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    """Looks of all frames in which a tip was found, computed once per sample."""
    return remember(sample, "looks", _looks)


def _looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    taken: dict[KeyframeKind, TipLook] = {}
    for kind in KeyframeKind:
        detection = sample.detections.get(kind)
        frame = None if detection is None else sample.frames.get(kind)
        if detection is not None and frame is not None:
            taken[kind] = look(frame, detection, sample.pipette)
    return taken
