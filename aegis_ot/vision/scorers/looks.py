"""The looks that the scorers share, taken once per frame."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np

from ...vocabulary import KeyframeKind
from ..column import (
    TipLook,
    TipShape,
    at_one_place,
    held_still,
    look_along,
    look_at_tip,
    shapes_of,
    shift_between,
)
from ..column.trajectory import LOADED
from ..tips import TipGeometry
from ..types import FREE, Frames, Image, Position, TipDetection, TrajectorySample

_PERSPECTIVE = 0.08
"""By how much the length of one tip differs between the frames of a trajectory at most: it
comes nearer to the camera and goes farther from it. Rendered plates: sd 0.024."""

_SURE = 0.6
_SURELY_OFF = 0.12
"""Confidence of a detection that is not stretched to another frame's length, unless it differs from
it by more than this."""

_SAME = 0.03
"""Lengths this close are the same: looking again would change nothing."""


def look(
    frames: Mapping[KeyframeKind, Image],
    kind: KeyframeKind,
    detection: TipDetection,
    tip: TipGeometry,
    length: float | None = None,
    shape: TipShape | None = None,
) -> TipLook:
    """:func:`look_at_tip` at one frame, once for as long as :class:`~..types.Frames` are kept.

    A live run calls it as each frame arrives, so that little is left to do after the last one.
    """
    of_tip = _measured(frames, (kind, detection, tip.name))
    for (other, _), taken in of_tip.items():
        same = other == length or (other and length and abs(other / length - 1.0) < _SAME)
        if same and (shape is None or taken.shape == shape):
            return taken
    if shape is not None:
        of_tip.pop((length, None), None)  # whose outline is not the tip's
    taken = of_tip[length, shape] = look_at_tip(frames[kind], detection, tip, length, shape)
    return taken


def look_again(
    frames: Mapping[KeyframeKind, Image],
    detection: TipDetection,
    tip: TipGeometry,
    before: TipLook,
) -> TipLook:
    """The tip in POST_DISPENSE by TRANSIT's axis, where it hangs at one place in both: each frame's
    own is off by a pixel or more, along the tip by far more where a column was left in it.
    """
    full, kind = FREE
    again = _measured(frames, (kind, detection, tip.name, before.collar, before.orifice))
    if before.shape not in again:
        axis = np.array(before.collar), np.array(before.orifice)
        moved = shift_between(frames[full], frames[kind], *axis, before.shape)
        if moved is None:
            again[before.shape] = look(frames, kind, detection, tip, shape=before.shape)
        else:
            off = (float(moved[0]), float(moved[1]))
            again[before.shape] = look_along(frames[kind], detection, tip, before, moved=off)
    return again[before.shape]


def hang_alike(
    detections: Mapping[KeyframeKind, TipDetection | None],
    positions: Mapping[KeyframeKind, Position | None],
) -> bool:
    """Whether the tip hangs at one place in both free frames."""
    before, after = (detections.get(kind) for kind in FREE)
    if before is None or after is None:
        return False
    ends = ((before.collar, before.orifice), (after.collar, after.orifice))
    return at_one_place(*ends, held_still(positions))


def _measured(frames: Mapping[KeyframeKind, Image], what: Hashable) -> dict[Any, TipLook]:
    """What was measured in these frames before; nothing where that is not kept with them."""
    known: dict[Any, TipLook] = {}
    return frames.measured.setdefault(what, known) if isinstance(frames, Frames) else known


def looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    """Looks of all frames in which a tip was found and can be seen, computed once per sample.

    One tip is about as long in all four frames, and has one outline. A frame that disagrees with
    those in which the tip hangs free shows a part of it, for labware hides the rest, or was
    detected badly; it is looked at again with their length, and with their outline.
    """
    return sample.once("looks", lambda: _looks(sample))


def _looks(sample: TrajectorySample) -> Mapping[KeyframeKind, TipLook]:
    taken: dict[KeyframeKind, TipLook] = {}
    # Data sets decode a frame each time that it is asked for.
    kept = sample.frames if isinstance(sample.frames, Frames) else Frames()
    before, after = FREE
    alike = hang_alike(sample.detections, sample.positions)
    for kind in KeyframeKind:
        detection = sample.detections.get(kind)
        frame = None if detection is None else sample.frames.get(kind)
        if detection is not None and frame is not None:
            kept[kind] = frame
            if kind is after and alike and before in taken:
                continue  # by TRANSIT's axis, once that is sure
            seen = look(kept, kind, detection, sample.tip)
            if not seen.washed_out:
                taken[kind] = seen
    usual = _usual_length({kind: seen.profile.length for kind, seen in taken.items()})
    shape = _usual_outline(sample.tip, taken)
    for kind, seen in list(taken.items()):
        detection = sample.detections[kind]
        if usual is None or detection is None:
            continue
        sure = detection.confidence >= _SURE and kind in LOADED
        off = abs(seen.profile.length / usual - 1.0) > (_SURELY_OFF if sure else _PERSPECTIVE)
        other = None if shape == seen.shape else shape
        if off or other is not None:
            length = usual if off else None
            taken[kind] = look(kept, kind, detection, sample.tip, length, other)
    emptied = sample.detections.get(after)
    if alike and before in taken and after in kept and emptied is not None:
        seen = look_again(kept, emptied, sample.tip, taken[before])
        if not seen.washed_out:
            taken[after] = seen
    return taken


def _usual_outline(tip: TipGeometry, taken: Mapping[KeyframeKind, TipLook]) -> TipShape:
    """The outline that fits the tip where it hangs free: labware has edges of its own."""
    free = [taken[kind] for kind in FREE if kind in taken] or list(taken.values())
    if not free:
        return shapes_of(tip)[0]
    for seen in free:
        if not seen.clarities:
            return seen.shape  # there is no other, or the run knows
    return shapes_of(tip)[int(np.argmax(np.sum([seen.clarities for seen in free], axis=0)))]


def _usual_length(lengths: Mapping[KeyframeKind, float]) -> float | None:
    """Length of the tip, px, as the free frames show it: labware hides a part, nothing adds one."""
    free = [lengths[kind] for kind in FREE if kind in lengths]
    if not free:
        return None
    agree = max(free) <= (1 + _PERSPECTIVE) * min(free)
    return float(np.mean(free)) if agree else max(free)
