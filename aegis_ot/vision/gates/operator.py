"""The operator as a gate: the robot pauses, and the page shows the frames."""

from __future__ import annotations

from ...vocabulary import Gate, Outcome
from .case import GateDecision, GateInput


class OperatorGate:
    """A person decides, later: for now the well is undecided."""

    gate = Gate.OPERATOR
    screens = False

    def examine(self, case: GateInput) -> GateDecision:
        return GateDecision(
            Outcome.UNDECIDED, self.gate, "No gate could settle this well; please look at it."
        )
