"""The experiments themselves, each as small as it goes."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.llm import ScriptedBackend
from aegis_ot.vision.models import SHIPPED
from aegis_ot.worldmodel.reach import wilson
from aegis_ot_lab.drawing import write_dataset
from aegis_ot_lab.reproduction import Context, ReproductionOptions, calibration, layer1, live, rules
from aegis_ot_lab.reproduction import components as components_
from aegis_ot_lab.reproduction.experiment import NOT_RUN
from aegis_ot_lab.reproduction.layer1 import NO_MODEL


@pytest.fixture
def context(tmp_path: Path) -> Context:
    return Context(ReproductionOptions(tmp_path, replicates=1, plates=4))


@pytest.mark.parametrize(
    ("hits", "low", "high"),
    [(0, 0.00, 0.43), (1, 0.04, 0.62), (2, 0.12, 0.77), (3, 0.23, 0.88), (5, 0.57, 1.00)],
)
def test_wilsons_interval_is_that_of_the_paper(hits: int, low: float, high: float) -> None:
    assert wilson(hits, 5) == pytest.approx((low, high), abs=0.006)


def test_rules_and_benchmark_are_counted(context: Context) -> None:
    outcome = rules.EXPERIMENT.run(context)
    assert outcome.answers["rules"] == ("33 over 7 assay families",)
    assert outcome.figures["correct"] == 11
    assert sum(outcome.figures["with_several_bugs"].values()) == 8


def test_the_band_routes_what_is_known_of_it(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(calibration, "RUNS", 150)
    first, again = (calibration.EXPERIMENT.run(context) for _ in range(2))
    for shares in first.figures["routed"].values():
        assert shares[0] == pytest.approx(0.72, abs=0.06)
    assert first.figures == again.figures, "same seed, same numbers"
    other = calibration.EXPERIMENT.run(Context(ReproductionOptions(context.options.out, seed=1)))
    assert other.figures != first.figures


@pytest.fixture
def one_protocol(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = layer1.labels_of
    monkeypatch.setattr(layer1, "labels_of", lambda *given: whole(*given)[:1])


def test_layer_1_without_a_model_says_what_was_not_run(
    context: Context, one_protocol: None
) -> None:
    outcome = layer1.EXPERIMENT.run(context)
    rows = {row[0]: row for row in outcome.tables[0].rows}
    assert len(outcome.figures["results"]) == 1
    for name in ("hybrid", "trace-blind", "llm-only"):
        assert rows[name][2] == NO_MODEL
    assert outcome.answers["llm-only"] == (NO_MODEL,)
    assert outcome.timings
    assert "seconds" not in outcome.figures["results"][0]


def test_a_model_that_gives_no_answer_is_not_scored(tmp_path: Path, one_protocol: None) -> None:
    outcome = layer1.EXPERIMENT.run(Context(ReproductionOptions(tmp_path), [ScriptedBackend([])]))
    rows = {row[0]: row for row in outcome.tables[0].rows}
    assert rows["hybrid"][2].startswith(f"{NOT_RUN}: the model gave no answer")
    assert outcome.answers["llm-only"] == (rows["llm-only"][2],)
    assert len(outcome.figures["results"]) == 1


def test_the_live_matrix_counts_what_is_held_and_is_the_same_again(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live, "KINDS", {"no tip": "no_tip"})
    monkeypatch.setattr(live, "REAGENTS", ("red",))
    monkeypatch.setattr(live, "WELLS", 8)
    monkeypatch.setattr(Context, "papers_model", lambda _: SHIPPED)
    first, again = (live.EXPERIMENT.run(context) for _ in range(2))
    found = first.figures["cascade; no tip; red"]
    assert (found["runs"], found["caught"]) == (1, 1)
    assert set(first.figures) == {
        f"{point}; no tip; red" for point in ("cascade", "the paper's band", "always-gate")
    }
    assert first.figures == again.figures
    assert first.tables[2].rows[0][1] == NO_MODEL


def test_a_set_of_ones_own_takes_the_simulated_ones_place(tmp_path: Path) -> None:
    folder = write_dataset(tmp_path / "mine", 4, 3, "p1000", size=(320, 240))
    context = Context(ReproductionOptions(tmp_path / "out", data=(folder,)))
    outcome = components_.EXPERIMENT.run(context)
    assert outcome.data == ("simulated: mine, 17 trajectories on 4 plates",)
    assert set(outcome.figures) == {"mine"}
    assert not (tmp_path / "out" / "data").exists()
    assert components_.EXPERIMENT.run(context).figures == outcome.figures
