"""A model that does not answer is told with the figures."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.vision.gates import GateDecision, GateInput
from aegis_ot.vocabulary import Gate, Outcome, Route
from aegis_ot_lab.drawing import write_dataset
from aegis_ot_lab.evaluation.layer2.answers import CountedGate
from aegis_ot_lab.evaluation.layer2.evaluate import evaluate_layer2
from tests.vision.samples import sample


class Model:
    """Answers every other question."""

    gate = Gate.VLM
    screens = False

    def __init__(self) -> None:
        self.asked = 0

    def examine(self, case: GateInput) -> GateDecision:
        self.asked += 1
        trouble = "" if self.asked % 2 else f"no answer to question {self.asked}"
        return GateDecision(Outcome.UNDECIDED, self.gate, "?", trouble=trouble)


def test_questions_are_counted_and_the_first_trouble_is_kept() -> None:
    model = Model()
    counted = CountedGate(model)
    assert (counted.gate, counted.screens) == (Gate.VLM, False)
    assert counted.answers.note == ""
    case = GateInput(sample(), Route.GREY_ZONE)
    assert [bool(counted.examine(case).trouble) for _ in range(5)] == [False, True] * 2 + [False]
    told = counted.answers
    assert (told.asked, told.answered, told.trouble) == (5, 3, "no answer to question 2")
    assert "2 of 5 questions to the model got no answer" in told.note
    assert "question 2" in told.note


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_dataset(tmp_path_factory.mktemp("drawn") / "set", 2, 1, "p300", size=(320, 240))


def test_the_result_tells_of_a_model_and_without_one_says_nothing(drawn: Path) -> None:
    model = Model()
    result = evaluate_layer2(drawn, "pca", "cascade", "true", gates=[model])
    told = result.to_json()
    assert told["model"] == {
        "asked": model.asked,
        "answered": (model.asked + 1) // 2,
        "trouble": "no answer to question 2",
    }
    assert model.asked > 1
    assert f"asked of a model   {model.asked} wells" in result.text()
    assert any("got no answer" in note for note in told["notes"])
    alone = evaluate_layer2(drawn, "pca", "cascade", "true")
    assert alone.to_json()["model"] is None
    assert "model" not in alone.text()
