"""Tiers, budget and costs of the vision model as a gate."""

from __future__ import annotations

from typing import Any

import pytest

from aegis_ot.llm import PriceTable, ScriptedBackend, State
from aegis_ot.llm.backend import Reply, Request, TokenUsage
from aegis_ot.llm.gate_tiers import Budget, VlmTiers, is_sure
from aegis_ot.llm.prices import Price
from aegis_ot.vision.gates import Gates, OperatorGate
from aegis_ot.vocabulary import Gate, Outcome

from .test_vlm import case, said

PRICES = PriceTable("2026-01-01", "USD", {"small": Price(1.0, 1.0, 1.0, 2.0)})
SURE, UNSURE = said("pass", "pass", "pass"), said("pass", "cannot_tell", "pass")


class Model:
    """Answers what it is told to, and counts."""

    def __init__(self, name: str, *answers: dict[str, Any]) -> None:
        self.name, self.asked = name, 0
        self._answers = answers

    def ask(self, request: Request) -> Reply:
        answer = self._answers[min(self.asked, len(self._answers) - 1)]
        self.asked += 1
        usage = TokenUsage(input=1_000_000, output=500_000)
        return Reply(State.ANSWERED, self.name, answer, usage=usage, seconds=1.5)


def test_the_small_models_word_stands_where_it_is_sure() -> None:
    small, large = Model("small", SURE), Model("large", SURE)
    decision = VlmTiers([small, large], PRICES).examine(case())
    assert decision.outcome is Outcome.PASS
    assert (small.asked, large.asked) == (1, 0)
    (cost,) = decision.costs
    assert (cost.model, cost.calls, cost.amount, cost.seconds) == ("small", 1, 2.0, 1.5)


@pytest.mark.parametrize(
    "unsure",
    [UNSURE, said("fail", "pass", "pass"), said("pass", "pass", "pass", routine_confidence="low")],
)
def test_the_large_model_decides_where_the_small_one_is_unsure(unsure: dict[str, Any]) -> None:
    large = Model("large", said("fail", "fail", "fail"))
    decision = VlmTiers([Model("small", unsure), large], PRICES).examine(case())
    assert decision.outcome is Outcome.FAIL
    assert [cost.model for cost in decision.costs] == ["small", "large"]
    assert decision.costs[1].amount is None  # it has no price here


@pytest.mark.parametrize(
    ("budget", "word"), [(Budget(amount=3.0), "3 USD"), (Budget(calls=2), "2 times")]
)
def test_a_spent_budget_leaves_the_well_to_the_next_gate(budget: Budget, word: str) -> None:
    small = Model("small", SURE)
    tiers = VlmTiers([small], PRICES, budget)
    gates = Gates([tiers, OperatorGate()])
    assert [gates.confirm(case()).outcome for _ in range(2)] == [Outcome.PASS] * 2
    decision = gates.confirm(case())
    assert decision.outcome is Outcome.UNDECIDED
    assert decision.gate is Gate.OPERATOR
    assert word in decision.reason
    assert small.asked == 2


def test_an_unsure_small_model_does_not_decide_because_the_money_is_gone() -> None:
    tiers = VlmTiers(
        [Model("small", said("fail", "pass", "pass")), Model("large", SURE)], PRICES,
        Budget(calls=1),
    )  # fmt: skip
    decision = tiers.examine(case())
    assert decision.outcome is Outcome.UNDECIDED
    assert len(decision.costs) == 1


def test_an_outage_of_the_small_model_goes_on_to_the_large_one() -> None:
    large = Model("large", SURE)
    tiers = VlmTiers([ScriptedBackend([State.UNAVAILABLE]), large], PRICES)
    assert tiers.examine(case()).outcome is Outcome.PASS


def test_without_an_answer_nothing_is_sure() -> None:
    assert not is_sure(None)
    assert is_sure(said("fail", "fail", "fail"))
