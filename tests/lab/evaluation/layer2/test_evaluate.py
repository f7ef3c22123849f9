"""Leave-one-plate-out as the paper does it, its metrics, figures and model files."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from sklearn.metrics import average_precision_score, roc_auc_score

from aegis_ot.errors import ConfigurationError, DatasetError
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.dataset_writer import DatasetWriter
from aegis_ot.vision.models import load_model
from aegis_ot.worldmodel.fitting import fit_model
from aegis_ot.worldmodel.leave_one_out import hold_out
from aegis_ot_lab.evaluation.layer2 import draw_figures, evaluate_layer2
from aegis_ot_lab.evaluation.layer2.metrics import auroc, average_precision, bootstrap, f1
from tests.vision.samples import sample


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("set")
    with DatasetWriter(path, {"source": "synthetic"}) as writer:
        for number in range(5):
            plate = f"p{number}"
            for well in range(3):
                writer.add(sample(f"{plate}-n{well}", plate=plate, seed=10 * number + well))
            writer.add(
                sample(f"{plate}-f", plate=plate, seed=90 + number, left=0.5, failure="no_dispense")
            )
        writer.add(sample("p0-t", plate="p0", tip=False, failure="no_tip"))
    return path


class Spy:
    """Scores by the length of the post-dispense column; remembers what it saw."""

    name = "spy"

    def __init__(self) -> None:
        self.fitted: list[str] = []

    def fit(self, normals) -> None:
        self.fitted = [s.id for s in normals]
        seen.append(self)

    def score(self, one) -> float:
        assert one.plate not in {name.split("-")[0] for name in self.fitted}
        return 2.0 if one.failure_type else 1.0


seen: list[Spy] = []


def test_no_plate_is_scored_by_a_model_that_saw_it(folder: Path) -> None:
    data = load_dataset(folder)
    seen.clear()
    wells = hold_out(data.samples(data.true_boxes()), Spy, "first-normal").wells
    assert len(seen) == 5
    assert all(len(spy.fitted) == 12 for spy in seen)
    ids = {well.sample.id for well in wells}
    assert "p0-n0" not in ids, "a plate's first normal sets the threshold and is not scored"
    assert len(ids) == 16
    assert all(well.flagged == well.failed for well in wells)


CAMERAS = {"p0": "webcam", "p1": "webcam", "p2": "phone", "p3": "phone", "p4": "old"}


def with_cameras(folder: Path, out: Path, cameras: dict[str, str]) -> Path:
    shutil.copytree(folder, out)
    meta = {"source": "synthetic", "cameras": cameras}
    (out / "meta.json").write_text(json.dumps(meta), encoding="utf-8")
    return out


def test_no_camera_is_scored_by_a_model_that_saw_its_kind(folder: Path, tmp_path: Path) -> None:
    data = with_cameras(folder, tmp_path / "set", CAMERAS)
    seen.clear()
    result = evaluate_layer2(data, "spy", detector="true", make=Spy, leave_out="camera",
                             threshold="first-normal")  # fmt: skip
    learned = [{CAMERAS[name.split("-")[0]] for name in spy.fitted} for spy in seen if spy.fitted]
    assert learned == [{"phone", "old"}] * 2 + [{"webcam", "old"}] * 2 + [{"webcam", "phone"}]
    told = result.to_json()
    assert told["leave_out"] == "camera"
    assert told["per_camera"] == {
        "old": {"caught": 1, "total": 1},
        "phone": {"caught": 2, "total": 2},
        "webcam": {"caught": 2, "total": 2},
    }
    assert told["flagged_normals_per_camera"]["phone"] == {"caught": 0, "total": 4}
    assert "leaving one camera out" in result.text()


@pytest.mark.parametrize(
    ("cameras", "words"),
    [
        ({"p0": "webcam"}, "names no kind of camera for p1, p2, p3, p4"),
        (dict.fromkeys(CAMERAS, "webcam"), "one kind only"),
    ],
)
def test_cameras_that_cannot_be_left_out_are_told(
    folder: Path, tmp_path: Path, cameras: dict[str, str], words: str
) -> None:
    data = with_cameras(folder, tmp_path / "set", cameras)
    with pytest.raises(DatasetError, match=words):
        evaluate_layer2(data, "pca", detector="true", leave_out="camera")


def test_cameras_that_are_no_names_are_a_fault_of_the_set(folder: Path, tmp_path: Path) -> None:
    data = with_cameras(folder, tmp_path / "set", {"p0": 3})  # type: ignore[dict-item]
    with pytest.raises(DatasetError, match="must name a kind of camera for each plate"):
        load_dataset(data)


def test_the_result_has_the_five_metrics_with_intervals(folder: Path) -> None:
    result = evaluate_layer2(folder, "pca", detector="true")
    data = json.loads(json.dumps(result.to_json()))
    for name in ("average_precision", "auroc", "f1", "precision", "recall"):
        assert set(data[name]) == {"value", "low", "high"}
        assert data[name]["low"] <= data[name]["value"] <= data[name]["high"]
    assert data["recall"]["value"] == 1
    assert data["no_tip"] == {"caught": 1, "total": 1}
    assert data["wells"] == {"scored": 15, "normals": 10, "failures": 5}
    assert data["per_failure_type"] == {"no_dispense": {"caught": 5, "total": 5}}
    assert "synthetic" in result.text()
    again = evaluate_layer2(folder, "pca", detector="true").to_json()
    assert again == result.to_json(), "seeded: the same figures every time"


def test_the_pooled_threshold_spares_normals(folder: Path) -> None:
    paper = evaluate_layer2(folder, "pca", detector="true")
    pooled = evaluate_layer2(folder, "pca", detector="true", threshold="pooled")
    assert pooled.flagged_normals.caught <= paper.flagged_normals.caught
    assert pooled.metrics["recall"].value == 1
    assert pooled.routed["normals"] <= 0.2


def test_wrong_names_are_refused(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="no scorer"):
        evaluate_layer2(folder, "magic", detector="true")
    with pytest.raises(ConfigurationError, match="protocol"):
        evaluate_layer2(folder, "pca", "guess", "true")
    with pytest.raises(ConfigurationError, match="p-values"):
        evaluate_layer2(folder, "pca", detector="true", threshold="p-value")
    with pytest.raises(DatasetError, match="no such folder"):
        evaluate_layer2(tmp_path / "none", "pca", detector="true")


def test_one_plate_cannot_be_left_out(tmp_path: Path) -> None:
    with DatasetWriter(tmp_path, {}) as writer:
        writer.add(sample("a"))
        writer.add(sample("b", failure="no_dispense"))
    with pytest.raises(DatasetError, match="two plates"):
        evaluate_layer2(tmp_path, "pca", detector="true")


def test_metrics_by_hand() -> None:
    failed = np.array([True, True, False, False])
    scores = np.array([3.0, 1.0, 2.0, 0.0])
    flagged = scores > 1.5
    values = bootstrap(failed, scores, flagged, resamples=50)
    assert values["auroc"].value == pytest.approx(0.75)
    assert values["precision"].value == values["recall"].value == values["f1"].value == 0.5
    assert values["average_precision"].value == pytest.approx((1 + 2 / 3) / 2)
    rng = np.random.default_rng(0)
    truth, ties = rng.random(60) < 0.4, rng.integers(0, 9, 60).astype(float)
    assert auroc(truth, ties, truth) == pytest.approx(roc_auc_score(truth, ties))
    assert average_precision(truth, ties, truth) == pytest.approx(
        average_precision_score(truth, ties)
    )
    nothing = np.zeros(4, dtype=bool)
    assert f1(failed, scores, nothing) == 0


def test_figures_are_drawn(folder: Path, tmp_path: Path) -> None:
    data = load_dataset(folder)
    result = evaluate_layer2(data, "pca", detector="true")
    paths = draw_figures(result, tmp_path, data.samples(data.true_boxes()))
    assert {path.stem for path in paths} == {
        "precision_recall", "roc", "failure_types", "scores", "scree", "components",
        "sample_complexity",
    }  # fmt: skip
    assert all(path.stat().st_size > 5000 for path in paths)


def test_a_labs_model_is_fitted_on_its_normals(folder: Path, tmp_path: Path) -> None:
    fit_model([folder], tmp_path / "lab.npz", "pca", "true")
    model = load_model(tmp_path / "lab.npz", "pca")
    assert model.data["recordings"][0]["normals"] == 15
    assert model.data["recordings"][0]["source"] == "synthetic"
    with pytest.raises(ConfigurationError, match="no model file"):
        fit_model([folder], tmp_path / "x.npz", "isolation_forest", "true")
