"""Recorded runs: as normals to learn from, and as a data set."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError, DatasetError, ModelError
from aegis_ot.sidecar.analysers import load_scorer
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.store.opening import open_store
from aegis_ot.sidecar.wire import Decision
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.detection import load_detector
from aegis_ot.vocabulary import Outcome
from aegis_ot.worldmodel.exporting import export_runs
from aegis_ot.worldmodel.fitting import fit_model
from aegis_ot.worldmodel.recorded import recorded_runs
from tests.worldmodel.stores import make_store


def test_only_wells_that_passed_are_learned(store: Path, tmp_path: Path) -> None:
    model = fit_model([store], tmp_path / "lab.model", "pca")
    (used,) = model.data["recordings"]
    assert used["normals"] == 7
    assert used["source"] == "synthetic"
    assert load_scorer(tmp_path / "lab.model").name == "pca"


def test_the_operators_word_counts(store: Path, tmp_path: Path) -> None:
    folder = tmp_path / "store"
    shutil.copytree(store, folder)
    kept = Store(folder)
    kept.add_decision("run-1", 3, Decision(outcome=Outcome.FAIL, by="ada"))
    (run,) = recorded_runs(kept, load_detector())
    assert [s.label for s in run.samples].count("normal") == 6


def test_a_damaged_model_is_refused(drawn: Path, tmp_path: Path) -> None:
    path = tmp_path / "lab.model"
    fit_model([drawn], path, "pca")
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 255
    path.write_bytes(bytes(data))
    with pytest.raises(ModelError, match="damaged"):
        load_scorer(path)


def test_plates_of_two_sets_are_not_mixed_up(drawn: Path, tmp_path: Path, monkeypatch) -> None:
    seen: set[str] = set()
    scorer = "aegis_ot.vision.scorers.pca.PcaScorer.fit"
    monkeypatch.setattr(scorer, lambda self, normals: seen.update(s.plate for s in normals))
    monkeypatch.setattr("aegis_ot.vision.scorers.pca.PcaScorer.to_arrays", lambda self: ({}, {}))
    fit_model([drawn, drawn], tmp_path / "x", "pca")
    assert len(seen) == 6


def test_a_flex_pipette_keeps_its_name_and_its_tip(tmp_path: Path) -> None:
    folder = make_store(tmp_path / "store", ("", ""), pipette="flex_1channel_1000")
    (run,) = recorded_runs(Store(folder), load_detector())
    assert {sample.tip.name for sample in run.samples} == {"flex_200"}
    export_runs(folder, tmp_path / "out")
    assert {record.pipette for record in load_dataset(tmp_path / "out").records} == {
        "flex_1channel_1000"
    }
    data = load_dataset(tmp_path / "out")
    again = data.samples(data.true_boxes())
    assert {sample.tip.name for sample in again} == {"flex_200"}


def test_a_run_becomes_a_data_set(store: Path, tmp_path: Path) -> None:
    told = export_runs(store, tmp_path / "out")
    assert (told.written, told.failures, told.left_out) == (8, 1, 0)
    data = load_dataset(tmp_path / "out")
    assert data.source == "synthetic"
    assert [r.failure_type for r in data.records][-1] == "no_dispense"
    (run,) = recorded_runs(Store(store), load_detector())
    used = [sample.tip_used for sample in data.samples(data.true_boxes())]
    assert used == [sample.tip_used for sample in run.samples]
    assert all(used), "which tip a well had decides what of its column is known to be left"
    with pytest.raises(DatasetError, match="already"):
        export_runs(store, tmp_path / "out")


def test_no_store_is_made_by_looking_for_one(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="data folder"):
        open_store(tmp_path)
    assert not any(tmp_path.iterdir())
