"""The vision model as a gate with tiers, a budget for each run, and its costs counted.

A small model is asked first. Where its three assessments agree and none is of low confidence, its
word stands; else the larger one is asked. When a run's budget is spent no model is asked any more,
and the well goes to the next gate, in the end to the operator.
"""

from __future__ import annotations

import threading
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..vision.gates import Cost, GateDecision, GateInput
from ..vocabulary import Gate, Outcome
from .backend import Backend, Reply, Request
from .prices import PriceTable
from .vlm import LENSES, VlmGate


@dataclass(frozen=True)
class Budget:
    """What the gate may take in one run.

    Attributes:
        amount: In the price table's currency; ``None``: no limit. A model without a price counts
            by its calls alone.
        calls: Most questions; ``None``: no limit.
    """

    amount: float | None = None
    calls: int | None = None


class Spending:
    """What each run has spent. Runs are judged by threads of their own."""

    def __init__(self, budget: Budget) -> None:
        self._budget = budget
        self._calls: Counter[str] = Counter()
        self._amounts: defaultdict[str, float] = defaultdict(float)
        self._lock = threading.Lock()

    def add(self, run: str, cost: Cost) -> None:
        """A question was asked."""
        with self._lock:
            self._calls[run] += cost.calls
            self._amounts[run] += cost.amount or 0.0

    def spent(self, run: str, currency: str) -> str:
        """Why nothing more may be asked in this run; empty while something may."""
        with self._lock:
            calls, amount = self._calls[run], self._amounts[run]
        budget = self._budget
        if budget.calls is not None and calls >= budget.calls:
            return f"The vision model was asked {calls} times in this run, as often as it may."
        if budget.amount is not None and amount >= budget.amount:
            return (
                f"The vision model's budget of {budget.amount:g} {currency} for this run is spent."
            )
        return ""


class VlmTiers:
    """A :class:`~aegis_ot.vision.gates.ConfirmingGate` over one vision model or several.

    Args:
        backends: Whom to ask, the smallest model first.
        prices: What their answers cost.
        budget: Of each run.
    """

    gate = Gate.VLM
    screens = False

    def __init__(
        self, backends: Sequence[Backend], prices: PriceTable, budget: Budget | None = None
    ) -> None:
        self._backends = tuple(backends)
        self._prices = prices
        self._spending = Spending(budget or Budget())

    def examine(self, case: GateInput) -> GateDecision:
        """Judge one case; undecided if no model gives an answer, or none may be asked."""
        run = case.sample.plate
        costs: list[Cost] = []
        decision = GateDecision(Outcome.UNDECIDED, self.gate, "No vision model is configured.")
        for backend in self._backends:
            spent = self._spending.spent(run, self._prices.currency)
            if spent:
                # What a smaller model was unsure of is not settled by its word alone.
                said = f"{decision.reason} {spent}" if costs else spent
                decision = GateDecision(Outcome.UNDECIDED, self.gate, said)
                break
            heard = _Heard(backend)
            decision = VlmGate(heard).examine(case)
            for reply in heard.replies:
                cost = self._cost(reply)
                self._spending.add(run, cost)
                costs.append(cost)
            if heard.replies and is_sure(heard.replies[-1].value):
                break
        return replace(decision, costs=tuple(costs))

    def _cost(self, reply: Reply) -> Cost:
        usage = reply.usage
        return Cost(
            reply.model,
            max(reply.attempts, 1),
            usage.total_input,
            usage.output,
            self._prices.cost(reply.model, usage),
            self._prices.currency,
            reply.seconds,
        )


class _Heard:
    """A backend, and what it answered."""

    def __init__(self, backend: Backend) -> None:
        self.name = backend.name
        self.replies: list[Reply] = []
        self._backend = backend

    def ask(self, request: Request) -> Reply:
        reply = self._backend.ask(request)
        self.replies.append(reply)
        return reply


def is_sure(answer: Mapping[str, Any] | None) -> bool:
    """Whether the three assessments agree on pass or fail, none of them with low confidence."""
    if answer is None:
        return False
    said = [answer[lens] for lens in LENSES]
    verdicts = {one["verdict"] for one in said}
    return verdicts in ({"pass"}, {"fail"}) and all(one["confidence"] != "low" for one in said)
