"""The door of the training room."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import onnxruntime
import pytest

from aegis_ot.errors import ConfigurationError, DatasetError, ModelError
from aegis_ot_lab.training import train_detector


def test_the_door_does_not_load_pytorch() -> None:
    code = "import sys, aegis_ot_lab.training; raise SystemExit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_without_pytorch_the_user_is_told_what_to_install(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.delitem(sys.modules, "aegis_ot_lab.training.detector", raising=False)
    monkeypatch.delitem(sys.modules, "aegis_ot_lab.training.network", raising=False)
    with pytest.raises(ConfigurationError, match=r"aegis-ot\[train\]"):
        train_detector([], tmp_path / "x.onnx")


def test_the_same_seed_trains_the_same_weights(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    from aegis_ot.vision.detection import HeatmapDetector
    from aegis_ot_lab.training.detector import DetectorSettings
    from aegis_ot_lab.training.sources import sources_digest

    settings = DetectorSettings(rounds=2, frames=6, passes=1, frozen=1, batch=2, threshold_frames=8)
    first = train_detector([], tmp_path / "a" / "tip.onnx", 1, settings)
    second = train_detector([], tmp_path / "b" / "tip.onnx", 1, settings)
    other = train_detector([], tmp_path / "c" / "tip.onnx", 2, settings)
    assert first.read_bytes() == second.read_bytes()
    assert first.read_bytes() != other.read_bytes()
    described = HeatmapDetector(first).description
    assert described["seed"] == 1
    assert described["made_with"]["sources_sha256"] == sources_digest()
    assert not list(first.parent.glob("*.part"))


def test_training_on_begins_where_the_other_ended(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    from aegis_ot.vision.detection import HeatmapDetector
    from aegis_ot.vision.detection.heatmap import load_weights
    from aegis_ot_lab.training.detector import DetectorSettings

    still = DetectorSettings(
        rounds=1, frames=4, passes=1, frozen=1, batch=2, threshold=0.3, learning_rate=0.0
    )
    learnt = train_detector([], tmp_path / "on.onnx", 1, still, start="shipped")
    shipped, described = load_weights()
    assert HeatmapDetector(learnt).description["start_sha256"] == described["sha256"]
    image = np.random.default_rng(0).integers(0, 255, (1, 64, 96, 3), dtype=np.uint8)
    before, after = (
        onnxruntime.InferenceSession(weights).run(None, {"image": image})[0]
        for weights in (shipped, learnt.read_bytes())
    )
    np.testing.assert_allclose(before, after, atol=1e-4)

    moved = train_detector([], tmp_path / "moved.onnx", 1, replace(still, learning_rate=1e-3),
                           start=learnt)  # fmt: skip
    assert moved.read_bytes() != learnt.read_bytes()


def test_what_cannot_be_trained_on_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    import torch

    from aegis_ot.vision.detection.heatmap import FORMAT
    from aegis_ot_lab.training.network import TipNetwork

    with pytest.raises(ModelError, match=r"missing\.onnx"):
        train_detector([], tmp_path / "tip.onnx", start=tmp_path / "missing.onnx")
    wider = tmp_path / "wider.onnx"
    torch.onnx.export(
        TipNetwork((8, 16, 32, 64)), (torch.zeros(1, 32, 32, 3, dtype=torch.uint8),), str(wider),
        dynamo=False,
    )  # fmt: skip
    described = {"format": FORMAT, "sha256": hashlib.sha256(wider.read_bytes()).hexdigest()}
    wider.with_suffix(".json").write_text(json.dumps(described))
    with pytest.raises(ConfigurationError, match="another network"):
        train_detector([], tmp_path / "tip.onnx", start=wider)


def test_what_cannot_work_is_said_before_training(tmp_path: Path, dataset: Path) -> None:
    pytest.importorskip("torch")
    with pytest.raises(ConfigurationError, match=r"\.onnx"):
        train_detector([], tmp_path / "weights.bin")
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigurationError, match="written"):
        train_detector([], tmp_path / "file" / "tip.onnx")
    with pytest.raises(ConfigurationError, match="plate7"):
        train_detector([], tmp_path / "tip.onnx", hold_out=["plate7"])
    with pytest.raises(ConfigurationError, match="plate0, plate1"):
        train_detector([dataset], tmp_path / "tip.onnx", hold_out=["plate7"])
    with pytest.raises(ConfigurationError, match="none is left"):
        train_detector([dataset], tmp_path / "tip.onnx", hold_out=["plate0", "plate1"])
    with pytest.raises(DatasetError, match="nowhere"):
        train_detector([tmp_path / "nowhere"], tmp_path / "tip.onnx")
