"""The door of the training room."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError, DatasetError
from aegis_ot.training import train_detector


def test_the_door_does_not_load_pytorch() -> None:
    code = "import sys, aegis_ot.training; raise SystemExit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_without_pytorch_the_user_is_told_what_to_install(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.delitem(sys.modules, "aegis_ot.training.detector", raising=False)
    monkeypatch.delitem(sys.modules, "aegis_ot.training.network", raising=False)
    with pytest.raises(ConfigurationError, match=r"aegis-ot\[train\]"):
        train_detector([], tmp_path / "x.onnx")


def test_the_same_seed_trains_the_same_weights(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    from aegis_ot.training.detector import DetectorSettings
    from aegis_ot.training.sources import sources_digest
    from aegis_ot.vision.detection import HeatmapDetector

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
