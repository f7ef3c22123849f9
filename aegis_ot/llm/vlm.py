"""The VLM as a gate of Layer 2: three lenses look at the four cropped frames in one call.

The prompt asks for three assessments, skeptical, routine and expert; any one that says "fail"
fails the well (paper, "Real-time deployment": correlated errors make a majority vote miss what
one lens sees). What was commanded, what should be left, and the reagent's name and colour stand
in the question, since clear liquid hardly shows. Beside the well stands a normal one of the same
run. No answer decides nothing: the next gate, in the end the operator, is asked.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import cv2

from ..vision.gates import GateDecision, GateInput
from ..vision.measuring import ColumnReading
from ..vision.signs import SIGNS, Sign
from ..vision.types import Image, TipDetection, TrajectorySample
from ..vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route, one_line
from .answer import strict_object
from .backend import Backend, Message, Passage, PromptPicture, Request
from .prompts_text import prompt
from .tip_pictures import CropSettings, picture_of

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
    Route.GREY_ZONE: "it looks unlike this run's normal wells",
    Route.BLANK_FLOOR: "no tip was found in one of the pictures, or the view is blank",
    Route.UNCALIBRATED: "the run could not be calibrated on its first wells",
    Route.ALWAYS_GATE: "every well is looked at in this run",
    Route.CALIBRATION: "it is one of the run's first wells",
    Route.SILENT_PASS: "it is a spot check of the wells that pass",
}
_NEAR_BAND = "its anomaly score, though inside the band of this run's normal wells, is near its end"
_UNSCORED = "no anomaly score could be computed"

_SPOKE = 1.0
"""Surprise of a sign, nats, from which it is named: one normal well of three shows as much."""


class VlmGate:
    """A :class:`~aegis_ot.vision.gates.ConfirmingGate` that asks a vision model.

    Its pass settles what is merely open. What looks alarming to the scorer it does not clear: the
    operator is told both (``docs/explanation/gates.md``).
    """

    gate = Gate.VLM
    screens = False

    def __init__(self, backend: Backend, crop: CropSettings | None = None) -> None:
        self._backend = backend
        self._crop = crop or CropSettings()

    def examine(self, case: GateInput) -> GateDecision:
        """Judge one case; undecided if the model gives no answer."""
        if all(case.sample.frames.get(kind) is None for kind in KeyframeKind):
            return self._undecided("There is no frame to show to the model.")
        try:
            request = gate_request(case, self._crop)
        except cv2.error as error:
            return self._undecided(f"The frames cannot be cut ({error.err}).")
        reply = self._backend.ask(request)
        if reply.value is None:
            said = f"The vision model gave no answer ({reply.state.value}): {reply.detail}"
            return replace(self._undecided(said), trouble=said)
        decision = self.decide(reply.value)
        if case.alarming and decision.outcome is Outcome.PASS:
            # Readers of a p20's pictures passed 14 of the 28 failures that the scorer had found.
            why = "finds the tip very unusual"
            if case.seems_left:
                why = "and the column speak for liquid left in the tip"
            told = f"{decision.reason} The scorer {why} all the same."
            return replace(decision, outcome=Outcome.UNDECIDED, reason=told)
        return decision

    def decide(self, answer: Mapping[str, Any]) -> GateDecision:
        """Any lens that fails the well fails it; it passes if two pass it and none fails it."""
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
        if len(unsure) > 1:
            return self._undecided(
                f"The vision model cannot tell ({', '.join(unsure)}): "
                f"{_short(verdicts[unsure[0]]['reason'])}"
            )
        passing = [lens for lens in LENSES if lens not in unsure]
        lens = passing[-1]
        said = verdicts[lens]
        return GateDecision(
            Outcome.PASS,
            self.gate,
            f"{len(passing)} of 3 assessments pass it, none fails it; {lens}, "
            f"{said['confidence']} confidence: {_short(said['reason'])}",
        )

    def _undecided(self, reason: str) -> GateDecision:
        return GateDecision(Outcome.UNDECIDED, self.gate, reason)


def gate_request(case: GateInput, crop: CropSettings | None = None) -> Request:
    """The question about one well: what was commanded, then the four pictures."""
    crop = crop or CropSettings()
    sample = case.sample
    parts: list[str | PromptPicture] = ["\n".join(_facts(case))]
    for number, kind in enumerate(KeyframeKind, 1):
        frame = sample.frames.get(kind)
        if frame is None:
            parts.append(f"Picture {number}, {kind.value}: no picture was taken.")
            continue
        expected = sample.expected_ul.get(kind)
        told = "" if expected is None else f"; {expected:g} µL should be in the tip"
        detection = sample.detections.get(kind)
        normal = _normal(case, kind)
        beside = "; left: a normal well of this run, right: the well in question" if normal else ""
        lost = ""
        if detection is None:
            shown = "both show where the normal well's hangs" if normal else "it is the whole frame"
            lost = f"; no tip was found in it, so {shown}"
        parts.append(f"Picture {number}, {kind.value}{told}{beside}{lost}:")
        parts.append(picture_of(frame, detection, crop, normal))
    return Request(
        PURPOSE,
        (Passage(prompt("gate"), cached=True),),
        (Message(tuple(parts)),),
        GATE_SCHEMA,
        MAX_OUTPUT,
    )


def _facts(case: GateInput) -> list[str]:
    sample = case.sample
    reagent = sample.reagent.strip()
    lines = [
        f"Pipette {sample.pipette}, commanded volume {sample.volume_ul:g} µL.",
        f"Asked because {_why(case)}.",
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
    spoke = sorted(case.signs.items(), key=lambda sign: -sign[1])
    named = [_told(SIGNS[sign]) for sign, nats in spoke if nats >= _SPOKE and sign in SIGNS]
    if named:
        lines.append(f"What the measurement noticed, strongest first: {'; '.join(named)}.")
    for kind, reading in case.readings.items():
        if _tells(reading, sample.expected_ul.get(kind)):
            lines.append(
                f"Measured in {kind.value}: about {_volume(reading)}"
                + ("." if case.calibrated else ", not calibrated on this run yet.")
            )
    return lines


def _told(sign: Sign) -> str:
    """``a break in the column (picture 1)``: with the pictures that show it."""
    numbers = [str(number) for number, kind in enumerate(KeyframeKind, 1) if kind in sign.frames]
    if not numbers:
        return sign.words
    return f"{sign.words} (picture{'s' if numbers[1:] else ''} {' and '.join(numbers)})"


def _why(case: GateInput) -> str:
    if case.near_band:
        return _NEAR_BAND
    if case.route is Route.GREY_ZONE and case.score is None:
        return _UNSCORED
    return _ROUTES[case.route]


def _volume(reading: ColumnReading) -> str:
    """``2.4 ± 0.3 µL``: as many decimals as the uncertainty is worth."""
    sigma = max(reading.sigma_ul, 0.01)
    digits = max(-math.floor(math.log10(sigma)), 0)
    return f"{reading.volume_ul:.{digits}f} ± {sigma:.{digits}f} µL"


def _tells(reading: ColumnReading, expected_ul: float | None) -> bool:
    """Whether a reading is one: where rows tell nothing else, the expected volume stands in it."""
    return (
        not reading.vague and math.isfinite(reading.sigma_ul) and reading.volume_ul != expected_ul
    )


def _normal(case: GateInput, kind: KeyframeKind) -> tuple[Image, TipDetection] | None:
    """The same moment of this run's normal well."""
    known: TrajectorySample | None = case.normal
    if known is None or known.frames is case.sample.frames:
        return None
    frame, detection = known.frames.get(kind), known.detections.get(kind)
    return None if frame is None or detection is None else (frame, detection)


def _short(text: object) -> str:
    return one_line(text, 200)
