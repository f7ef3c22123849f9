"""What there is to see of one delivery of a recorded run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..vocabulary import KeyframeKind
from .levels import axis_of, expected_level, measured_level
from .overview import DeliveryEntry, VerdictEntry, last_keyframe, verdict_of
from .scores import band_in, signs_in
from .states import failure_in_words, state_of
from .wells import Box, Picture, SeenFrame, SeenWell

Pictures = Callable[[int, "Box | None"], "tuple[Picture | None, Picture | None, str]"]
"""From a keyframe's number and the tip's box: the whole frame, the tip close up, and what there
is to say where the frame is missing."""

_PROBED: dict[Any, str] = {True: "; the sensor found liquid", False: "; the sensor found no liquid"}
"""What the pipette's pressure sensor said of the source, where it was asked."""


def no_pictures(_sequence: int, _box: Box | None) -> tuple[None, None, str]:
    """Numbers are enough."""
    return None, None, ""


def seen_well(run: str, entry: DeliveryEntry, pictures: Pictures = no_pictures) -> SeenWell:
    """Gather one delivery."""
    verdict, last = verdict_of(entry), last_keyframe(entry)
    evidence = entry["evidence"]
    pipette, reagent = str(last.get("pipette", "")), last.get("reagent") or ""
    wells = last.get("destinations") or last.get("sources") or ()
    route, reason = str(verdict.get("route", "")), str(verdict.get("reason", ""))
    state = state_of(entry)
    if entry["abandoned"] is not None:
        reason = f"Given up: {entry['abandoned']}"
    elif not verdict:
        reason = str(entry.get("unjudged") or "")
    return SeenWell(
        id=f"{run}-{entry['trajectory']}",
        group=", ".join(filter(None, (f"{last.get('mount', '')} {pipette}".strip(), reagent))),
        well=str(wells[0]["name"]) if wells else "-",
        title=f"{entry['well']}, {float(last.get('commanded_ul', 0.0)):g} µL {reagent}".rstrip()
        + _PROBED.get(last.get("liquid_found"), ""),
        outcome=_outcome(state, verdict),
        route=route,
        gate=str(verdict.get("gate", "")),
        failure=failure_in_words(entry),
        reason=reason,
        truth="",
        agreement="",
        score=verdict.get("score"),
        frames=_frames(entry, pictures),
        signs=signs_in(evidence),
        band=band_in(evidence),
    )


def _outcome(state: str, verdict: VerdictEntry) -> str:
    if state == "calibration" or not verdict:
        return state if state in ("calibration", "undecided") else ""
    return str(verdict["outcome"])


def _frames(entry: DeliveryEntry, pictures: Pictures) -> dict[KeyframeKind, SeenFrame]:
    evidence = entry["evidence"]
    frames = {}
    for keyframe in entry["keyframes"]:
        kind = KeyframeKind(keyframe["kind"])
        box = _box(evidence.get("boxes", {}).get(kind.value))
        whole, close, missing = pictures(int(keyframe["sequence"]), box)
        # The store keeps no axes: an upright tip is drawn, which is a pixel or two off.
        axis = None if box is None else axis_of(box)
        frames[kind] = SeenFrame(
            whole,
            close,
            box,
            evidence.get("confidence", {}).get(kind.value),
            None,
            axis,
            expected_level(evidence, kind, float(keyframe["expected_ul"]), axis, box),
            measured_level(evidence, kind, axis, box),
            missing,
        )
    return frames


def _box(found: Any) -> Box | None:
    if not isinstance(found, list) or len(found) != 4 or None in found:
        return None
    x, y, w, h = map(float, found)
    return x, y, w, h
