"""Gates one after another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ...vocabulary import Gate, Outcome
from .case import ConfirmingGate, GateDecision, GateInput


class Gates:
    """The gates of a run, in the order in which they are asked.

    Args:
        gates: The last one should be the operator.
    """

    def __init__(self, gates: Sequence[ConfirmingGate]) -> None:
        self._gates = tuple(gates)

    def model_after(self, decided: Gate) -> ConfirmingGate | None:
        """The vision model, where it was not asked because an earlier gate, or none, decided."""
        names = [gate.gate for gate in self._gates]
        later = names.index(decided) + 1 if decided in names else 0
        return next((gate for gate in self._gates[later:] if gate.gate.traits.is_model), None)

    def screen(self, case: GateInput) -> GateDecision:
        """What the gates say that may be asked about every well; ``UNDECIDED`` if there is none."""
        return _ask([gate for gate in self._gates if gate.screens], case)

    def confirm(self, case: GateInput) -> GateDecision:
        """Ask one after another until one decides.

        If none does, the last one's answer stands, with all reasons and the first one's readings.
        """
        return _ask(self._gates, case)


def _ask(gates: Sequence[ConfirmingGate], case: GateInput) -> GateDecision:
    decisions: list[GateDecision] = []
    for gate in gates:
        decision = gate.examine(case)
        decisions.append(decision)
        if decision.outcome is not Outcome.UNDECIDED:
            break
    if not decisions:
        return GateDecision(Outcome.UNDECIDED, Gate.NONE, "No gate is configured.")
    costs = tuple(cost for decision in decisions for cost in decision.costs)
    trouble = next((one.trouble for one in decisions if one.trouble), "")
    first, last = decisions[0], decisions[-1]
    if last.outcome is not Outcome.UNDECIDED:
        return replace(last, costs=costs, trouble=trouble)
    reason = in_sentences(*(decision.reason for decision in decisions))
    return replace(first, gate=last.gate, reason=reason, failure=None, costs=costs, trouble=trouble)


def in_sentences(*reasons: str) -> str:
    """Reasons one after another; what a later one says again is said once."""
    later = [" ".join(reasons[number + 1 :]) for number in range(len(reasons))]
    return " ".join(
        said for said, rest in zip(reasons, later, strict=True) if said and said not in rest
    )
