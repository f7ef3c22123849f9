"""What the pipette's own pressure sensor says of the source, weighed against the frames.

A Flex finds a liquid's surface with the tip that draws next. That says whether the source well
holds any. It says nothing of how much, of the stroke that follows, or of the delivery; so liquid
that was found excuses nothing, and liquid that was not found is never passed over in silence.
"""

from __future__ import annotations

from dataclasses import replace

from ..vocabulary import FailureType, Gate, Keyframe, Outcome
from .delivery import Delivery, Shown
from .gates import GateDecision, in_sentences


def found_in(keyframe: Keyframe) -> str:
    """The source in which the sensor found liquid; empty where it did not, or was not asked."""
    return _source(keyframe) if keyframe.liquid_found else ""


def weighed(decision: GateDecision, keyframe: Keyframe, delivery: Delivery | None) -> GateDecision:
    """``decision`` with what the sensor says.

    Args:
        decision: On the frames alone.
        keyframe: The trajectory's last one.
        delivery: What its own frames show of the delivery.
    """
    if keyframe.liquid_found is None:
        return decision
    if keyframe.liquid_found:
        if decision.failure is not FailureType.NO_ASPIRATE:
            return decision
        return _adding(
            decision,
            f"The pipette's pressure sensor found liquid in {_source(keyframe)} before the "
            "aspirate, though: look for a clogged or loose tip.",
        )
    said = (
        f"The pipette's pressure sensor found no liquid in {_source(keyframe)} before the aspirate"
    )
    shown = Shown.UNKNOWN if delivery is None else delivery.shown
    if decision.outcome is Outcome.PASS and shown is Shown.EMPTIED:
        # Rows that change as a full bore does were filled: a probe stops short of the bottom.
        return _adding(decision, f"{said}, but the frames show liquid leave the tip.")
    if decision.outcome is Outcome.PASS:
        return replace(
            decision,
            outcome=Outcome.UNDECIDED,
            gate=Gate.OPERATOR,
            reason=f"{said}, and no liquid is plainly seen to leave the tip. Please look at the "
            "tip and the source.",
        )
    if decision.failure is FailureType.OTHER and shown is Shown.NOTHING:
        # Nothing was drawn or nothing delivered, say the frames; the sensor tells which.
        decision = replace(decision, failure=FailureType.NO_ASPIRATE)
    return _adding(decision, f"{said}.")


def _source(keyframe: Keyframe) -> str:
    return keyframe.sources[0].name if len(keyframe.sources) == 1 else "the source"


def _adding(decision: GateDecision, words: str) -> GateDecision:
    return replace(decision, reason=in_sentences(decision.reason, words))
