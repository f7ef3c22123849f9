"""Liquid that a reported failure left in a tip: known, and no failure of the next well.

A tip that is used again still shows it, well after well. The operator has been told and let the
run go on, so the expectation for the next well starts from it: only what comes on top is new.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from ..vocabulary import FAILURES, FailureType, Gate, Keyframe, KeyframeKind, Outcome
from .delivery import Delivery, Shown
from .gates import GateDecision, GateInput

_UNSURE = 0.25
"""How well a volume that was left is known, as a fraction."""

_EMPTY = 0.35
"""A tip that holds less than this share of what was to be drawn drew nothing, whatever was left."""


@dataclass(frozen=True)
class Leftover:
    """What stayed in a tip.

    Attributes:
        tip: Which one.
        volume_ul: µL.
        well: Where it was reported.
        perhaps_ul: What may be left besides, µL: nothing was seen to leave, so it was not drawn or
            it is still there, and the next well tells which.
    """

    tip: str
    volume_ul: float
    well: str
    perhaps_ul: float = 0.0


class Leftovers:
    """What is known to be left in the tips of one run, by mount."""

    def __init__(self) -> None:
        self._of: dict[str, Leftover] = {}
        self._doubted: dict[str, str] = {}

    def known(self, keyframe: Keyframe) -> Leftover | None:
        """What the tip of this keyframe was reported to hold; another tip ends it."""
        left = self._of.get(keyframe.mount)
        if left is not None and left.tip != keyframe.tip:
            del self._of[keyframe.mount]
            return None
        return left

    def doubted(self, keyframe: Keyframe) -> bool:
        """Whether this tip seemed to hold liquid before, too little to measure."""
        return self._doubted.get(keyframe.mount) == keyframe.tip

    def note(self, keyframe: Keyframe, case: GateInput, decision: GateDecision) -> None:
        """A well was judged: if liquid stayed in the tip, it is known from now on."""
        if decision.outcome is Outcome.PASS:
            return
        if decision.failure is FailureType.NO_TIP:
            self._of.pop(keyframe.mount, None)
            return
        if case.seems_left:
            self._doubted[keyframe.mount] = keyframe.tip
        before = self.known(keyframe)
        volume = None
        if decision.measured_ul is not None and decision.expected_ul is not None:
            volume = decision.measured_ul - decision.expected_ul
        elif decision.failure is not None and FAILURES[decision.failure].stays:
            volume = case.sample.volume_ul
        if decision.failure is FailureType.NO_DISPENSE and before is not None:
            # A column that reaches higher than it was ever drawn is read too short.
            volume = before.volume_ul + case.sample.volume_ul
        if volume is not None and volume > 0:
            volume = min(volume, case.sample.tip.capacity_ul)
            self._of[keyframe.mount] = Leftover(keyframe.tip, volume, case.sample.well)
        elif before is not None and case.delivery is not None:
            perhaps = case.sample.volume_ul if case.delivery.shown is Shown.NOTHING else 0.0
            self._of[keyframe.mount] = replace(
                before, well=case.sample.well, perhaps_ul=before.perhaps_ul + perhaps
            )

    def explaining(
        self, keyframe: Keyframe, case: GateInput, delivery: Callable[[float], Delivery]
    ) -> Leftover | None:
        """The leftover of this tip, if a well that did not pass shows no more than that.

        Args:
            keyframe: Its last one.
            case: The well, as it is judged without that.
            delivery: What it shows if the tip held so much before and after, µL.
        """
        left = self.known(keyframe)
        drawn = case.sample.expected_ul.get(KeyframeKind.TRANSIT, case.sample.volume_ul)
        if left is not None and left.volume_ul + drawn > case.sample.tip.capacity_ul:
            # Overfull, it drew less than it was told, and looks alike before and after.
            return None
        if left is None or explains(left, case, delivery(left.volume_ul)):
            return left
        more = replace(left, volume_ul=left.volume_ul + left.perhaps_ul, perhaps_ul=0.0)
        shown = delivery(more.volume_ul)
        if more == left or shown.shown is not Shown.EMPTIED or not explains(more, case, shown):
            return None
        self._of[keyframe.mount] = more
        return more

    def restore(self, mount: str, left: Leftover | None) -> None:
        """From what was kept of an earlier verdict; ``None``: nothing was known to be left."""
        if left is None:
            self._of.pop(mount, None)
        else:
            self._of[mount] = left


def explains(left: Leftover, case: GateInput, delivery: Delivery) -> bool:
    """Whether a well shows no more than the leftover.

    Args:
        left: What the tip held before.
        case: The well, as it is judged without that.
        delivery: What it shows of its delivery if the tip held that before and after.
    """
    if case.missing or delivery.shown is Shown.NOTHING:
        return False
    commanded = case.sample.volume_ul
    for kind, base in ((KeyframeKind.TRANSIT, commanded), (KeyframeKind.POST_DISPENSE, 0.0)):
        reading = case.readings.get(kind)
        if reading is None or reading.vague:
            continue
        # The leftover itself was read with the same errors.
        slack = max(2.0 * reading.sigma_ul, 0.15 * commanded)
        most = case.sample.expected_ul.get(kind, base) + left.volume_ul * (1 + _UNSURE) + slack
        if reading.volume_ul > most:
            return False
        if kind is KeyframeKind.TRANSIT and reading.volume_ul < _EMPTY * commanded:
            return False
    return delivery.shown is not Shown.LEFT


def still_there(left: Leftover, decision: GateDecision) -> GateDecision:
    """The verdict on a well that shows a leftover and nothing else."""
    return GateDecision(
        Outcome.PASS,
        Gate.VOLUMETRIC,
        f"About {left.volume_ul:.0f} µL were left in this tip at {left.well}, as reported there; "
        "nothing more stayed behind here.",
        None,
        decision.measured_ul,
        decision.expected_ul,
    )
