"""The vision room's analyser behind the sidecar, on simulated frames."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError, ModelError
from aegis_ot.sidecar import SidecarConfig, make_analyser, running_sidecar
from aegis_ot.sidecar.cameras import open_camera
from aegis_ot.sidecar.config import CameraSettings, CascadeSettings
from aegis_ot.vocabulary import KeyframeKind, Verdict, from_json

from .helpers import Robot


def test_simulated_frames_are_judged(config: SidecarConfig) -> None:
    camera = open_camera(CameraSettings(spec="simulated"))
    with running_sidecar(config, camera, make_analyser()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        answer = None
        while answer is None:
            answer = robot.verdict(0)["verdict"]
        verdict = from_json(Verdict, answer)
        assert verdict.route.value == "calibration"
        assert "analyser failed" not in verdict.reason
        assert "could not be analysed" not in verdict.reason
        evidence = robot.overview()["trajectories"][0]["evidence"]
        assert set(evidence["boxes"]) == {kind.value for kind in KeyframeKind}
        assert robot.http.get("/v1/health").json()["camera"]["kind"] == "simulated"


def test_a_gate_that_nobody_set_up_is_told() -> None:
    with pytest.raises(ConfigurationError, match="'vlm' is asked for"):
        make_analyser(CascadeSettings(gates=("volumetric", "vlm")))


def test_models_that_are_not_there_are_told(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"none\.onnx"):
        make_analyser(CascadeSettings(detector=tmp_path / "none.onnx"))
    with pytest.raises(ModelError, match="no such model file"):
        make_analyser(CascadeSettings(model=tmp_path / "none"))
