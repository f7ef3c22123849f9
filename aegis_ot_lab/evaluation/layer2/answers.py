"""How a vision model answered in an evaluation: figures say whether they are with or without it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from aegis_ot.vision.gates import ConfirmingGate, GateDecision, GateInput
from aegis_ot.vocabulary import counted


@dataclass(frozen=True)
class ModelAnswers:
    """What became of the questions to a model.

    Attributes:
        asked: Questions, one for each well that it was to see.
        answered: Those that it answered.
        trouble: Why the first of the others has no answer; empty if all have one.
    """

    asked: int = 0
    answered: int = 0
    trouble: str = ""

    @property
    def note(self) -> str:
        """What a reader must know of it; empty if nothing."""
        if not self.trouble:
            return ""
        left = self.asked - self.answered
        return (
            f"{left} of {counted(self.asked, 'question')} to the model got no answer: these wells "
            f"are judged without one. The first: {self.trouble}"
        )

    def to_json(self) -> dict[str, Any]:
        return asdict(self)

    def __str__(self) -> str:
        return f"{counted(self.asked, 'well')}, answered {self.answered}"


class CountedGate:
    """A gate that asks a model, and counts.

    Args:
        asking: The gate.
    """

    def __init__(self, asking: ConfirmingGate) -> None:
        self.gate, self.screens = asking.gate, asking.screens
        self.answers = ModelAnswers()
        self._asking = asking

    def examine(self, case: GateInput) -> GateDecision:
        """Its word, unchanged."""
        decision = self._asking.examine(case)
        so_far = self.answers
        self.answers = ModelAnswers(
            so_far.asked + 1,
            so_far.answered + (not decision.trouble),
            so_far.trouble or decision.trouble,
        )
        return decision
