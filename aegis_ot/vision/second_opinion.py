"""A vision model's look at wells that nothing flagged: the only way in which it can raise recall.

It costs, so not every well goes to it: the first wells of each liquid, on which the run is
calibrated and which nothing else can judge; wells that come near the band; and a share of all
others. What it says against an unflagged well is one voice alone, so it stops nothing: it asks the
operator.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, replace

from ..vocabulary import Outcome, Route
from .gates import Case, GateDecision, Gates, in_sentences


@dataclass(frozen=True)
class SpotCheck:
    """Which unflagged wells a vision model sees.

    Attributes:
        share: Of the silent passes, 0 to 1; 0: no unflagged well at all.
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
        spot_check: Which wells.
    """

    def __init__(self, gates: Gates, spot_check: SpotCheck | None = None) -> None:
        self._model = gates.model
        self._spot_check = spot_check or SpotCheck()

    def on(
        self, case: Case, passed: GateDecision, first_wells: int, limit: float | None
    ) -> GateDecision:
        """What comes of a well that passed.

        Args:
            case: The well.
            passed: How it passed.
            first_wells: How many wells of its liquid have calibrated the run, with this one.
            limit: Upper end of the band; ``None`` without one.
        """
        if self._model is None or passed.outcome is not Outcome.PASS:
            return passed
        if not self._wanted(case, first_wells, limit):
            return passed
        said = self._model.examine(case)
        if said.outcome is not Outcome.FAIL:
            return replace(passed, costs=passed.costs + said.costs, trouble=said.trouble)
        unflagged = "Nothing flagged this well, but a vision model fails it."
        reason = in_sentences(unflagged, said.reason)
        return replace(said, outcome=Outcome.UNDECIDED, reason=reason)

    def _wanted(self, case: Case, first_wells: int, limit: float | None) -> bool:
        wanted = self._spot_check
        if wanted.share <= 0:
            return False
        if case.route is Route.CALIBRATION:
            return first_wells <= wanted.first
        near = limit is not None and case.score is not None and case.score > wanted.near * limit
        # The same wells every time: a replayed run asks nothing new.
        drawn = zlib.crc32(case.sample.id.encode()) / 2**32
        return near or drawn < wanted.share
