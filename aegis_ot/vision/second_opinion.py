"""A vision model's look at wells that passed: the only way in which it can raise recall.

All wells go to it that triage sent to the gates and an earlier gate passed: volumes say nothing of
a bubble or a film. It costs, so of the others only some do: the first wells of each liquid, on
which the run is calibrated and which nothing else can judge; wells that come near the band; and a
share of the rest. What it says against a well that passed is one voice alone, so it stops nothing:
it asks the operator.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, replace

from ..vocabulary import Outcome, Route
from .gates import GateDecision, GateInput, Gates, in_sentences


@dataclass(frozen=True)
class SpotCheck:
    """Which wells that no gate was asked about a vision model sees.

    Attributes:
        share: Of the silent passes, 0 to 1; 0: none of these wells at all.
        near: Those whose score is over this share of the band's upper end.
        first: How many of the first wells of each liquid.
    """

    share: float = 0.05
    near: float = 0.6
    first: int = 2


class SecondOpinion:
    """Asks the run's vision model, if it has one, about wells that passed.

    Args:
        gates: The run's gates.
        spot_check: Which wells, of those that no gate was asked about.
    """

    def __init__(self, gates: Gates, spot_check: SpotCheck | None = None) -> None:
        self._gates = gates
        self._spot_check = spot_check or SpotCheck()

    def on(
        self, case: GateInput, passed: GateDecision, first_wells: int, limit: float | None
    ) -> GateDecision:
        """What comes of a well that passed.

        Args:
            case: The well.
            passed: How it passed.
            first_wells: How many wells of its liquid have calibrated the run, with this one.
            limit: Upper end of the band; ``None`` without one.
        """
        model = self._gates.model_after(passed.gate)
        if model is None or passed.outcome is not Outcome.PASS:
            return passed
        routed = case.route not in (Route.SILENT_PASS, Route.CALIBRATION)
        near = not routed and self._near(case, limit)
        if not (routed or near or self._drawn(case, first_wells)):
            return passed
        said = model.examine(replace(case, near_band=near))
        if said.outcome is not Outcome.FAIL:
            return replace(passed, costs=passed.costs + said.costs, trouble=said.trouble)
        if routed:
            reason = in_sentences(passed.reason, "But a vision model fails it.", said.reason)
        else:
            unflagged = "Nothing flagged this well, but a vision model fails it."
            reason = in_sentences(unflagged, said.reason)
        return replace(
            said,
            outcome=Outcome.UNDECIDED,
            reason=reason,
            measured_ul=passed.measured_ul,
            expected_ul=passed.expected_ul,
        )

    def _near(self, case: GateInput, limit: float | None) -> bool:
        wanted = self._spot_check
        if wanted.share <= 0 or case.route is Route.CALIBRATION:
            return False
        return limit is not None and case.score is not None and case.score > wanted.near * limit

    def _drawn(self, case: GateInput, first_wells: int) -> bool:
        wanted = self._spot_check
        if case.route is Route.CALIBRATION:
            return wanted.share > 0 and first_wells <= wanted.first
        # The same wells every time: a replayed run asks nothing new.
        return zlib.crc32(case.sample.id.encode()) / 2**32 < wanted.share
