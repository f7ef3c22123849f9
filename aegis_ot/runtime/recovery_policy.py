"""Whether a failed delivery may be put right without a person, and by which strokes.

Pure decisions: no I/O, no robot. What is not certain to be right is refused, with the reason in
words, and then the run pauses as it does without recovery.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..adapters.opentrons.instrumentation import Operation, OperationKind, is_repeatable
from ..vocabulary import FailureType, Keyframe, Verdict, WellRef
from .pipette_state import in_place, wells_of
from .strokes import RecordedDelivery
from .tip_contents import TRACE_UL

EMPTY_MOST = 0.15
"""Share of the volume up to which a tip that was measured counts as empty: the share below which
the volumetric gate sees no failure either."""

SIGMA_MOST = EMPTY_MOST / 2
"""Largest standard uncertainty of a remainder that is delivered after, as a share of the volume:
the well then ends within what the gate lets pass, in 95 of 100 cases."""

_MOVES_LIQUID = (OperationKind.ASPIRATE, OperationKind.DISPENSE, OperationKind.BLOW_OUT)


class NotAllowed(Exception):
    """Why the robot leaves it to a person. Never leaves the runtime room."""


@dataclass(frozen=True)
class Stroke:
    """One operation to do again.

    Attributes:
        operation: As the protocol had it done.
        volume: Instead of its own, µL; ``None`` for its own.
    """

    operation: Operation
    volume: float | None = None


@dataclass(frozen=True)
class Plan:
    """What puts a failed delivery right.

    Attributes:
        action: ``"retry"`` or ``"top_up"``.
        failed: Keyframe of the failed delivery.
        strokes: With a fresh tip, in order.
        missing_ul: What they deliver, µL.
        saves: Whether the failed tip holds liquid that may be blown out into its source.
    """

    action: str
    failed: Keyframe
    strokes: tuple[Stroke, ...]
    missing_ul: float
    saves: bool = False


def plan_recovery(
    action: str,
    delivery: RecordedDelivery | None,
    verdict: Verdict,
    boundary: Operation | None,
    touched: frozenset[WellRef] | None,
) -> Plan:
    """How to put a failed delivery right.

    Args:
        action: ``"retry"`` or ``"top_up"``.
        delivery: The failed one; ``None`` if the pipette has done something else since.
        verdict: On it.
        boundary: What the protocol is about to do; ``None`` where that is not an operation that
            could wait: a pause, the end of the run, another delivery that has begun already.
        touched: Wells that the failed tip touched, by Layer 1's trace; ``None`` if unknown.

    Raises:
        NotAllowed: It is left to a person.
    """
    if delivery is not None and delivery.keyframe.expected_ul > TRACE_UL:
        raise NotAllowed("the tip holds liquid that is meant for other wells")
    if boundary is None or delivery is None or boundary.pipette.mount != delivery.keyframe.mount:
        raise NotAllowed("the run is not between two moves of this pipette")
    _check_situation(delivery, boundary)
    kind = verdict.failure
    handled = any(stroke.kind in _MOVES_LIQUID for stroke in delivery.since)
    if kind is not FailureType.NO_ASPIRATE and handled:
        raise NotAllowed("the tip has moved liquid since its remainder was measured")
    missing = delivery.keyframe.commanded_ul
    if action == "retry":
        _check_nothing_came(delivery.keyframe, verdict)
        strokes = tuple(Stroke(one) for one in (*delivery.strokes, *delivery.since))
    else:
        missing = _missing(delivery.keyframe, verdict)
        strokes = _top_up(delivery, missing)
    if not all(is_repeatable(stroke.operation) for stroke in strokes):
        raise NotAllowed("one of its operations cannot be done again by this robot's software")
    home = touched is not None and touched <= set(delivery.keyframe.sources)
    saves = home and len(delivery.keyframe.sources) == 1 and kind is not FailureType.NO_ASPIRATE
    return Plan(action, delivery.keyframe, strokes, missing, saves)


def _check_situation(delivery: RecordedDelivery, boundary: Operation) -> None:
    keyframe = delivery.keyframe
    if keyframe.channels != 1 or boundary.pipette.channels != 1:
        raise NotAllowed("only one of several tips was judged")
    if in_place(boundary):
        raise NotAllowed("the protocol goes on where the tip stands")
    drops = boundary.kind is OperationKind.DROP_TIP
    if drops and not boundary.disposal:
        raise NotAllowed("the protocol puts its tip back")
    if not drops and _air_left(boundary):
        raise NotAllowed("the tip holds air that the protocol will push out")
    if delivery.destination is None:
        raise NotAllowed("it has not one destination")
    if not delivery.is_whole:
        raise NotAllowed("what it delivered was not drawn for this well alone")
    here = {*keyframe.sources, *keyframe.destinations}
    done = (*delivery.strokes, *delivery.since)
    if any(one.disposal or not wells_of(one) <= here for one in done):
        raise NotAllowed("the tip went to other places in between")
    if in_place(delivery.strokes[0]):
        raise NotAllowed("it was drawn where the tip stood, and nobody knows where that was")


def _air_left(boundary: Operation) -> bool:
    try:
        return float(boundary.core().get_current_volume() or 0.0) > TRACE_UL
    except Exception:  # private to Opentrons: if it cannot be asked, nothing is risked
        return True


def _check_nothing_came(keyframe: Keyframe, verdict: Verdict) -> None:
    """A retry delivers the whole volume, so nothing of it may be in the well."""
    measured, commanded = verdict.measured_ul, keyframe.commanded_ul
    if verdict.failure is FailureType.NO_ASPIRATE and keyframe.liquid_found is False:
        raise NotAllowed("the pipette's pressure sensor found no liquid in the source")
    if measured is None or not verdict.gate.traits.measures:
        raise NotAllowed("nothing was measured that shows the well to be without it")
    if verdict.failure is FailureType.NO_ASPIRATE and measured > EMPTY_MOST * commanded:
        raise NotAllowed(f"about {measured:.0f} µL were drawn and may be in the well")
    if verdict.failure is FailureType.NO_DISPENSE and measured < (1 - EMPTY_MOST) * commanded:
        raise NotAllowed(f"only about {measured:.0f} µL are left in the tip")


def _missing(keyframe: Keyframe, verdict: Verdict) -> float:
    left, sigma, commanded = verdict.left_ul, verdict.left_sigma_ul, keyframe.commanded_ul
    if left is None or sigma is None:
        raise NotAllowed("what is left in the tip could not be measured")
    if sigma > SIGMA_MOST * commanded:
        raise NotAllowed(f"what is left in the tip, {left:.0f} ± {sigma:.0f} µL, is too uncertain")
    if verdict.measured_ul is None or abs(verdict.measured_ul - left) > 3 * sigma + 1.0:
        raise NotAllowed("it failed by another measure than what is left in the tip")
    missing = round(left - keyframe.expected_ul, 1)
    if not EMPTY_MOST * commanded < missing <= commanded:
        raise NotAllowed(f"{left:.0f} µL left in the tip do not tell what is missing in the well")
    return missing


def _top_up(delivery: RecordedDelivery, missing: float) -> tuple[Stroke, ...]:
    """The draw and the last dispense with the missing volume, and what followed them there."""
    draws, deliveries = delivery.draws, delivery.deliveries
    if len(draws) != 1 or not deliveries:
        raise NotAllowed("it was drawn in several strokes")
    last = delivery.strokes[deliveries[-1]]
    if in_place(draws[0]) or in_place(last):
        raise NotAllowed("it was drawn or dispensed in place, after moves of its own")
    after = delivery.strokes[deliveries[-1] + 1 :]
    return (Stroke(draws[0], missing), Stroke(last, missing), *map(Stroke, after))
