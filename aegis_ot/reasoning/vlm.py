"""The VLM as a gate of Layer 2: three lenses look at the four cropped frames in one call.

The prompt asks for three assessments, skeptical, routine and expert; any one that says "fail"
fails the well (paper, "Real-time deployment": correlated errors make a majority vote miss what
one lens sees). What was commanded, what should be left, and the reagent's name and colour stand
in the question, since clear liquid hardly shows. No answer decides nothing: the next gate,
in the end the operator, is asked.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from ..vision.gates import Case, GateDecision
from ..vision.types import Image, TipDetection
from ..vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route, one_line
from .answer import strict_object
from .backend import Backend, Message, Passage, Picture, Request
from .prompts_text import prompt

LENSES = ("skeptical", "routine", "expert")
PURPOSE = "gate"
MAX_OUTPUT = 600
"""Longest answer, tokens: three short assessments."""

_CONFIDENCE = {"high": 3, "medium": 2, "low": 1}
_FAILURES = [failure.value for failure in FailureType]

_ASSESSMENT = strict_object(
    verdict={"type": "string", "enum": ["pass", "fail", "cannot_tell"]},
    confidence={"type": "string", "enum": list(_CONFIDENCE)},
    failure={"type": "string", "enum": ["none", *_FAILURES]},
    reason={"type": "string"},
)

GATE_SCHEMA: dict[str, Any] = strict_object(**dict.fromkeys(LENSES, _ASSESSMENT))

_ROUTES = {
    Route.GREY_ZONE: "its anomaly score is outside the band of this run's normal wells",
    Route.BLANK_FLOOR: "no tip was found in one of the pictures, or the view is blank",
    Route.UNCALIBRATED: "the run has no calibration yet",
    Route.ALWAYS_GATE: "every well is looked at in this run",
    Route.CALIBRATION: "it is one of the run's first wells",
}


@dataclass(frozen=True)
class CropSettings:
    """How a frame is cut.

    Attributes:
        margin: Added around the tip's box on each side, as a fraction of its longer side.
        side: Longer side of the picture that is sent, px.
        quality: Of the JPEG, 1 to 100.
    """

    margin: float = 0.15
    side: int = 550
    quality: int = 90


class VlmGate:
    """A :class:`~aegis_ot.vision.gates.ConfirmingGate` that asks a vision model.

    Args:
        backend: Whom to ask; a recorded one works as well.
        crop: How the frames are cut.
    """

    gate = Gate.VLM
    screens = False

    def __init__(self, backend: Backend, crop: CropSettings | None = None) -> None:
        self._backend = backend
        self._crop = crop or CropSettings()

    def examine(self, case: Case) -> GateDecision:
        """Judge one case; undecided if the model gives no answer."""
        if all(case.sample.frames.get(kind) is None for kind in KeyframeKind):
            return self._undecided("There is no frame to show to the model.")
        try:
            request = gate_request(case, self._crop)
        except cv2.error as error:
            return self._undecided(f"The frames cannot be cut ({error.err}).")
        reply = self._backend.ask(request)
        if reply.value is None:
            return self._undecided(
                f"The vision model gave no answer ({reply.state.value}): {reply.detail}"
            )
        return self.decide(reply.value)

    def decide(self, answer: Mapping[str, Any]) -> GateDecision:
        """Any lens that fails the well fails it; it passes if all three pass it."""
        verdicts = {lens: answer[lens] for lens in LENSES}
        failing = [lens for lens in LENSES if verdicts[lens]["verdict"] == "fail"]
        if failing:
            # The most certain one names the failure; the first of equals.
            lens = max(failing, key=lambda name: _CONFIDENCE[verdicts[name]["confidence"]])
            said = verdicts[lens]
            failure = (
                FailureType.OTHER if said["failure"] == "none" else FailureType(said["failure"])
            )
            return GateDecision(
                Outcome.FAIL,
                self.gate,
                f"{len(failing)} of 3 assessments fail it; {lens}, {said['confidence']} "
                f"confidence: {_short(said['reason'])}",
                failure,
            )
        unsure = [lens for lens in LENSES if verdicts[lens]["verdict"] != "pass"]
        if unsure:
            return self._undecided(
                f"The vision model cannot tell ({', '.join(unsure)}): "
                f"{_short(verdicts[unsure[0]]['reason'])}"
            )
        expert = verdicts["expert"]
        return GateDecision(
            Outcome.PASS,
            self.gate,
            f"All 3 assessments pass it; expert, {expert['confidence']} confidence: "
            f"{_short(expert['reason'])}",
        )

    def _undecided(self, reason: str) -> GateDecision:
        return GateDecision(Outcome.UNDECIDED, self.gate, reason)


def gate_request(case: Case, crop: CropSettings | None = None) -> Request:
    """The question about one well: what was commanded, then the four pictures."""
    crop = crop or CropSettings()
    sample = case.sample
    parts: list[str | Picture] = ["\n".join(_facts(case))]
    for number, kind in enumerate(KeyframeKind, 1):
        frame = sample.frames.get(kind)
        if frame is None:
            parts.append(f"Picture {number}, {kind.value}: no picture was taken.")
            continue
        expected = sample.expected_ul.get(kind)
        told = "" if expected is None else f"; {expected:g} µL should be in the tip"
        detection = sample.detections.get(kind)
        lost = "" if detection is not None else "; no tip was found in it, so it is the whole frame"
        parts.append(f"Picture {number}, {kind.value}{told}{lost}:")
        parts.append(picture_of(frame, detection, crop))
    return Request(
        PURPOSE,
        (Passage(prompt("gate"), cached=True),),
        (Message(tuple(parts)),),
        GATE_SCHEMA,
        MAX_OUTPUT,
    )


def picture_of(frame: Image, detection: TipDetection | None, crop: CropSettings) -> Picture:
    """The tip cut out with a margin and brought to size; without a tip, the whole frame."""
    if detection is not None:
        frame = _cut(frame, detection, crop.margin)
    height, width = frame.shape[:2]
    factor = crop.side / max(height, width)
    method = cv2.INTER_AREA if factor < 1 else cv2.INTER_CUBIC
    size = (max(round(width * factor), 1), max(round(height * factor), 1))
    resized = cv2.resize(frame, size, interpolation=method)
    _, data = cv2.imencode(".jpg", resized, [cv2.IMWRITE_JPEG_QUALITY, crop.quality])
    return Picture(np.asarray(data).tobytes())


def _cut(frame: Image, detection: TipDetection, margin: float) -> Image:
    extra = margin * max(detection.w, detection.h)
    height, width = frame.shape[:2]
    left, right = int(max(detection.x - extra, 0)), int(detection.x + detection.w + extra)
    top, bottom = int(max(detection.y - extra, 0)), int(detection.y + detection.h + extra)
    cut = frame[top : min(bottom, height), left : min(right, width)]
    return cut if cut.size else frame


def _facts(case: Case) -> list[str]:
    sample = case.sample
    reagent = sample.reagent.strip()
    lines = [
        f"Pipette {sample.pipette}, commanded volume {sample.volume_ul:g} µL.",
        f"Flagged because {_ROUTES.get(case.route, case.route.value)}.",
    ]
    if reagent:
        # A name from the protocol: data, not a word to the model.
        shown = one_line(reagent, 60)
        lines.append(
            f"The protocol calls the liquid {shown!r}. If the name or the pictures show a "
            "coloured liquid, look for its colour; if it may be clear, look for a meniscus."
        )
    else:
        lines.append("What the liquid is called is not known; it may be clear or coloured.")
    for kind, reading in case.readings.items():
        lines.append(
            f"Measured in {kind.value}: about {reading.volume_ul:.0f} ± {reading.sigma_ul:.0f} µL"
            + ("." if case.calibrated else ", not calibrated on this run yet.")
        )
    return lines


def _short(text: object) -> str:
    return one_line(text, 200)
