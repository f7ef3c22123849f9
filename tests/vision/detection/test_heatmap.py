"""The shipped detector, on drawn frames that no training has seen."""

from __future__ import annotations

import json
import shutil
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.detection import HeatmapDetector, load_detector
from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.scenes import draw_frame

UNSEEN = 20_000_003  # far from any seed that weights are trained with


@pytest.fixture(scope="module")
def detector() -> HeatmapDetector:
    return HeatmapDetector()


@pytest.fixture
def weights(tmp_path: Path) -> Path:
    folder = resources.files("aegis_ot.vision").joinpath("weights")
    for name in ("tip_detector.onnx", "tip_detector.json"):
        with resources.as_file(folder.joinpath(name)) as path:
            shutil.copy(path, tmp_path / name)
    return tmp_path / "tip_detector.onnx"


def frames(tip: bool, count: int) -> list[tuple[np.ndarray, TipLabel | None]]:
    rng = np.random.default_rng(UNSEEN + tip)
    drawn = [draw_frame(rng, tip)[:2] for _ in range(count + 10)]
    # A few come out so bright that nothing is left to see.
    return [(image, label) for image, label in drawn if (label is not None) == tip][:count]


def test_finds_drawn_tips_and_measures_their_axis(detector: HeatmapDetector) -> None:
    errors, missed = [], 0
    for image, label in frames(True, 40):
        assert label is not None
        found = detector.detect(image)
        if found is None:
            missed += 1
            continue
        errors.append(
            max(
                np.hypot(found.orifice[0] - label.orifice[0], found.orifice[1] - label.orifice[1]),
                np.hypot(found.collar[0] - label.collar[0], found.collar[1] - label.collar[1]),
            )
            / label.length
        )
    assert missed <= 8
    assert np.median(errors) < 0.06


def test_a_bare_nozzle_is_no_tip(detector: HeatmapDetector) -> None:
    wrong = [detector.detect(image) for image, _ in frames(False, 40)]
    assert sum(found is not None for found in wrong) <= 6


@pytest.mark.parametrize("level", [0, 20, 128, 255])
def test_an_empty_frame_has_no_tip(detector: HeatmapDetector, level: int) -> None:
    assert detector.detect(np.full((480, 640, 3), level, np.uint8)) is None


def test_noise_has_no_tip(detector: HeatmapDetector) -> None:
    rng = np.random.default_rng(5)
    assert detector.detect(rng.integers(0, 256, (540, 960, 3), dtype=np.uint8)) is None


def test_the_box_lies_in_the_frame_and_spans_the_axis(detector: HeatmapDetector) -> None:
    for image, _ in frames(True, 10):
        found = detector.detect(image)
        if found is None:
            continue
        assert 0 <= found.x <= found.x + found.w <= image.shape[1]
        assert 0 <= found.y <= found.y + found.h <= image.shape[0]
        assert 0 < found.confidence <= 1
        assert found.orifice[1] > found.collar[1]
        assert found.h == pytest.approx(found.orifice[1] - found.collar[1], abs=3)


def test_the_same_frame_gives_the_same_answer(detector: HeatmapDetector) -> None:
    image = frames(True, 1)[0][0]
    assert detector.best_guess(image) == HeatmapDetector().best_guess(image.copy())


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((480, 640), np.uint8),
        np.zeros((480, 640, 3), np.float32),
        np.zeros((0, 640, 3), np.uint8),
    ],
)
def test_what_is_no_frame_is_refused(detector: HeatmapDetector, image: np.ndarray) -> None:
    with pytest.raises(ValueError, match="uint8 image"):
        detector.detect(image)


def test_a_tiny_frame_is_no_error(detector: HeatmapDetector) -> None:
    assert detector.detect(np.zeros((3, 2, 3), np.uint8)) is None


@pytest.mark.parametrize("name", ["tip_detector", "row_detector"])
def test_weights_are_small_and_described(name: str) -> None:
    folder = resources.files("aegis_ot.vision").joinpath("weights")
    assert len(folder.joinpath(f"{name}.onnx").read_bytes()) <= 1_000_000
    described = json.loads(folder.joinpath(f"{name}.json").read_text(encoding="utf-8"))
    assert described["parameters"] < 200_000
    assert {"data", "settings", "seed", "sha256"} <= set(described)


def test_rows_are_seen_by_a_network_of_their_own_unless_weights_are_given(weights: Path) -> None:
    image = np.random.default_rng(3).integers(0, 255, (96, 64, 3), dtype=np.uint8)
    axes = [((32.0, 10.0), (32.0, 80.0))]
    shipped, given = HeatmapDetector(), HeatmapDetector(weights)
    assert given.of_rows is None
    assert shipped.of_rows is not None
    assert shipped.of_rows.best_guess(image) == shipped.best_guess(image)
    assert shipped.of_rows.ends_of_each(image, axes) != shipped.ends_of_each(image, axes)


def test_damaged_weights_are_refused(weights: Path) -> None:
    content = bytearray(weights.read_bytes())
    content[len(content) // 2] ^= 1
    weights.write_bytes(bytes(content))
    with pytest.raises(ModelError, match="damaged"):
        load_detector(weights)


def test_weights_of_another_version_are_refused(weights: Path) -> None:
    sidecar = weights.with_suffix(".json")
    sidecar.write_text(json.dumps({"format": "aegis-ot-tip-detector/99"}), encoding="utf-8")
    with pytest.raises(ModelError, match="aegis-ot-tip-detector/99"):
        load_detector(weights)


@pytest.mark.parametrize("text", ["{", "[]", "null"])
def test_a_broken_description_is_refused(weights: Path, text: str) -> None:
    weights.with_suffix(".json").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=r"tip_detector\.json"):
        load_detector(weights)


@pytest.mark.parametrize("threshold", [None, "high", 3])
def test_a_description_without_a_threshold_is_refused(weights: Path, threshold: object) -> None:
    sidecar = weights.with_suffix(".json")
    described = json.loads(sidecar.read_text(encoding="utf-8"))
    sidecar.write_text(json.dumps({**described, "threshold": threshold}), encoding="utf-8")
    with pytest.raises(ModelError, match="threshold"):
        load_detector(weights)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"nowhere\.onnx"):
        load_detector(tmp_path / "nowhere.onnx")
    with pytest.raises(ModelError, match=r"nowhere\.onnx"):
        HeatmapDetector(tmp_path / "nowhere.onnx")


def test_a_copy_of_the_weights_works_like_the_shipped_ones(
    detector: HeatmapDetector, weights: Path
) -> None:
    image = frames(True, 1)[0][0]
    assert load_detector(weights).detect(image) == detector.detect(image)
    assert isinstance(load_detector("default"), HeatmapDetector)


def test_the_threshold_is_a_setting() -> None:
    image = frames(True, 1)[0][0]
    assert HeatmapDetector(threshold=1.01).detect(image) is None
    assert HeatmapDetector(threshold=0.0).detect(image) is not None


def test_close_ups_and_the_whole_frame_show_the_ends_of_a_tip(detector: HeatmapDetector) -> None:
    """Of what each view calls an end, the warmest is near the true one."""
    near = []
    for image, tip in frames(True, 10):
        assert tip is not None
        axis = tip.collar, tip.orifice
        views = detector.ends_of_each(image, [axis, axis])
        assert views[0] == views[1]
        for ends in (views[0], detector.ends_of_length(image, tip.length)):
            for found, true in ((ends.collars, tip.collar), (ends.orifices, tip.orifice)):
                best = max(found, key=lambda end: end.heat)
                near.append(np.hypot(best.x - true[0], best.y - true[1]) < 0.1 * tip.length)
    assert np.mean(near) > 0.8
