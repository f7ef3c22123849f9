"""The looks that the column and patch scorers share, taken once per frame."""

from __future__ import annotations

import weakref
from collections.abc import Mapping

import numpy as np

from ...vocabulary import KeyframeKind
from ..column import TipLook, look_at_tip
from ..crops import remember
from ..types import Image, TipDetection, TrajectorySample

_PERSPECTIVE = 0.08
"""By how much the length of one tip differs between the frames of a trajectory at most: it
comes nearer to the camera and goes farther from it. Rendered plates: sd 0.02."""

_Key = tuple[TipDetection, str, float | None]
_taken: dict[int, tuple[weakref.ref[Image], _Key, TipLook]] = {}


def look(
    image: Image, detection: TipDetection, pipette: str, length: float | None = None
) -> TipLook:
    """:func:`look_at_tip`, once for as long as the frame lives.

    A live run calls it as each frame arrives, so that little is left to do after the last one.
    """
    key: _Key = (detection, pipette, length)
    known = _taken.get(id(image))
    if known is not None and known[0]() is image and known[1] == key:
        return known[2]
    taken = look_at_tip(image, detection, pipette, length=length)
    place = id(image)
    _taken[place] = (weakref.ref(image, lambda _: _taken.pop(place, None)), key, taken)
    return taken


def looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    """Looks of all frames in which a tip was found and can be seen, computed once per sample.

    One tip is about as long in all four frames. A frame that disagrees with the others was
    detected badly and is looked at again with their length.
    """
    return remember(sample, "looks", _looks)


def _looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    taken: dict[KeyframeKind, TipLook] = {}
    images: dict[KeyframeKind, Image] = {}
    for kind in KeyframeKind:
        detection = sample.detections.get(kind)
        frame = None if detection is None else sample.frames.get(kind)
        if detection is not None and frame is not None:
            seen = look(frame, detection, sample.pipette)
            if not seen.washed_out:
                images[kind], taken[kind] = frame, seen
    if len(taken) < 3:
        return taken
    usual = float(np.median([seen.profile.length for seen in taken.values()]))
    for kind, seen in list(taken.items()):
        detection = sample.detections[kind]
        if detection is not None and abs(seen.profile.length / usual - 1.0) > _PERSPECTIVE:
            taken[kind] = look(images[kind], detection, sample.pipette, usual)
    return taken
