"""What stands behind a verdict, as plain values for the page, the report and a restart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from ..vocabulary import KeyframeKind, Outcome
from .calibration_group import CalibrationGroup, OpenTrajectory
from .cascade import Triage
from .delivery import Delivery, Shown
from .gates import GateDecision, GateInput
from .leftover import Leftover
from .tip_scale import TipScale


def evidence_of(
    key: tuple[str, float, str],
    stream: CalibrationGroup,
    case: GateInput,
    seen: OpenTrajectory,
    triage: Triage,
    decision: GateDecision,
    left: Leftover | None = None,
) -> dict[str, Any]:
    """Boxes, scores, signs (nats), the band that the score met, volumes, columns' ends (fractions
    of the tip's length above the orifice), and what restores the calibration."""
    emptied = _emptied(case)
    channels = max(keyframe.channels for keyframe in seen.keyframes.values())
    scores = {} if case.score is None else {stream.scorer.name: case.score}
    found = {kind: tip for kind, tip in seen.detections.items() if tip is not None}
    return {
        "boxes": {kind.value: [tip.x, tip.y, tip.w, tip.h] for kind, tip in found.items()},
        "confidence": {kind.value: tip.confidence for kind, tip in found.items()},
        "scores": scores,
        "band": None if triage.band is None else list(triage.band),
        "signs": {sign: round(nats, 2) for sign, nats in case.signs.items()},
        "triage": triage.reason,
        "measured_ul": dict(_readings(case)),
        "drawn_ul": _drawn(case),
        "expected_ul": {kind.value: v for kind, v in case.sample.expected_ul.items()},
        "expected_top": dict(_expected_tops(stream, case)),
        "unusable_frames": [kind.value for kind in seen.unusable],
        "p_value": case.p_value,
        "costs": [asdict(cost) for cost in decision.costs],
        "model_trouble": decision.trouble,
        "channels": channels,
        "tips_judged": 1,
        "calibration": {
            "stream": list(key),
            "volume_ul": case.sample.volume_ul,
            "scores": scores,
            "normal": decision.outcome is Outcome.PASS,
            "strength": None if emptied is None else emptied.strength,
            "unbroken": None if emptied is None else emptied.unbroken,
            "unseen": case.delivery is not None and case.delivery.unseen,
            "left": None if left is None else asdict(left),
        },
    }


def _emptied(case: GateInput) -> Delivery | None:
    """What the frames show of the delivery, where the liquid was seen to leave the tip."""
    seen = case.delivery
    return seen if seen is not None and seen.shown is Shown.EMPTIED else None


def _readings(case: GateInput) -> Iterator[tuple[str, dict[str, float]]]:
    """Volumes that were seen: one that is only what was expected is no measurement."""
    for kind, reading in case.readings.items():
        told = reading.seen or reading
        air = _air(case) if kind is KeyframeKind.TRANSIT else 0.0
        expected = case.sample.expected_ul.get(kind, 0.0)
        if reading.vague or (told is reading and told.volume_ul == expected > 0):
            continue
        yield (
            kind.value,
            {
                "volume": round(max(told.volume_ul - air, 0.0), 2),
                "uncertainty": round(told.sigma_ul, 2),
                "air": round(air, 2),
                "top": round(told.top, 4),
            },
        )


def _drawn(case: GateInput) -> list[float] | None:
    """What was seen to leave the tip, and its standard uncertainty, µL."""
    full = case.readings.get(KeyframeKind.TRANSIT)
    if full is None or full.seen is None:
        return None
    return [round(max(full.seen.volume_ul - _air(case), 0.0), 2), round(full.seen.sigma_ul, 2)]


def _air(case: GateInput) -> float:
    """What stands as air in the full column, µL."""
    return 0.0 if case.delivery is None else case.delivery.gap_ul or 0.0


def _expected_tops(stream: CalibrationGroup, case: GateInput) -> Iterator[tuple[str, float]]:
    """Where the columns should end in this run's frames, as far as anything has shown it."""
    reader, tip = stream.reader, case.sample.tip
    for kind, volume in case.sample.expected_ul.items():
        top = reader.place(tip, volume)
        learned = tip.name in stream.scorer.height_factors or top != TipScale().place(tip, volume)
        if volume > 0 and learned:
            yield kind.value, round(1.0 - max(top, 0.0), 4)
