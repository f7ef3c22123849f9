"""``aegis-ot doctor`` finds what is wrong, and says what to do."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from dataclasses import replace
from email.utils import formatdate
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.doctor import Examination, examine
from aegis_ot.errors import ModelError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.aiming import measure
from aegis_ot.sidecar.config import CameraSettings, CascadeSettings, ModelSettings
from aegis_ot.sidecar.store import DATABASE
from aegis_ot.simulation import SimulatedCamera
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.detection import load_detector
from aegis_ot.vision.models import SHIPPED, load_model, save_model
from aegis_ot.worldmodel.reach import Smallest

from .sidecar.helpers import StubCamera, make_keyframe


def found(config: SidecarConfig, robot: str | None = None) -> dict[str, Examination]:
    return {check.name: check for check in examine(config, robot)}


@pytest.fixture
def sound(tmp_path: Path, free_port: int) -> SidecarConfig:
    return SidecarConfig(
        port=free_port, data=tmp_path / "data", camera=CameraSettings(spec="pattern")
    )


@pytest.fixture
def free_port() -> int:
    server = HTTPServer(("127.0.0.1", 0), BaseHTTPRequestHandler)
    server.server_close()
    return server.server_port


@pytest.fixture
def robot() -> Iterator[tuple[str, list[float]]]:
    behind = [0.0]

    class Health(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            data = json.dumps({"name": "lab-3", "robot_model": "OT-2 Standard",
                               "api_version": "8.8.2"}).encode()  # fmt: skip
            self.send_response(200)
            self.end_headers()
            self.wfile.write(data)

        def date_time_string(self, timestamp: float | None = None) -> str:
            import time

            return formatdate(time.time() - behind[0], usegmt=True)

        def log_message(self, *_: object) -> None:
            """Quiet."""

    server = HTTPServer(("127.0.0.1", 0), Health)
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}", behind
    server.shutdown()
    server.server_close()


def test_everything_is_looked_at(sound: SidecarConfig, robot: tuple[str, list[float]]) -> None:
    checks = found(sound, robot[0])
    assert list(checks) == [
        "versions", "disk", "store", "token", "camera's delay", "camera",
        "sharpness and light", "detector",
        "world model", "language model", "notifications", "robot",
    ]  # fmt: skip
    assert {name for name, check in checks.items() if check.state == "bad"} == set()
    assert checks["detector"].state == "warning"  # a test pattern shows no tip
    assert "put one on" in checks["detector"].todo
    assert "640 x 480" in checks["camera"].said
    assert "lab-3" in checks["robot"].said
    robot[1][0] = 90.0
    late = found(sound, robot[0])["robot"]
    assert late.state == "warning"
    assert "NTP" in late.todo


def test_what_is_wrong_is_said(
    sound: SidecarConfig, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("ANTHROPIC_API_KEY",):
        monkeypatch.delenv(name, raising=False)
    sound.data.mkdir()
    (sound.data / DATABASE).write_bytes(b"junk" * 2000)
    wrong = sound.model_copy(
        update={
            "camera": CameraSettings(spec="folder:/nowhere"),
            "cascade": CascadeSettings(model=tmp_path / "nofile.model"),
            "model": ModelSettings(name="anthropic:some-model"),
        }
    )
    checks = found(wrong, "http://127.0.0.1:9")
    bad = {name for name, check in checks.items() if check.state == "bad"}
    assert bad == {"store", "camera", "world model", "language model", "robot"}
    assert "nofile.model" in checks["world model"].said
    assert "ANTHROPIC_API_KEY" in checks["language model"].todo
    assert all(checks[name].todo for name in bad)


def test_a_shipped_model_that_cannot_be_read_is_not_called_ok(
    sound: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken() -> None:
        raise ModelError("pair_network.onnx is damaged")

    monkeypatch.setattr("aegis_ot.vision.scorers.pair._network", broken)
    check = found(sound)["world model"]
    assert (check.state, check.said) == ("bad", "pair_network.onnx is damaged")
    assert "Reinstall aegis_ot" in check.todo


def test_it_says_what_the_world_model_would_catch(sound: SidecarConfig, tmp_path: Path) -> None:
    def told(cascade: CascadeSettings) -> list[Examination]:
        checks = list(examine(sound.model_copy(update={"cascade": cascade})))
        return [check for check in checks if check.name in ("world model", "smallest volume")]

    (shipped,) = told(CascadeSettings())
    assert "the shipped one" in shipped.said
    assert "aegis-ot fit" in shipped.todo
    (none,) = told(CascadeSettings(preset="paper"))
    assert "its own first wells" in none.said

    seen = Smallest("p20", "red", 10.0, 2.5, {"0.25": 1.0}, 6, 2.4, 3.5, 0, 8)
    blind = replace(seen, reagent="water", smallest_ul=None)
    made = load_model(SHIPPED)
    data = {
        "recordings": [{"name": "a", "normals": 30}],
        "smallest": [seen.to_json(), blind.to_json()],
    }
    own = tmp_path / "own.model"
    save_model(own, made.kind, made.arrays, made.settings, data)
    model, dye, water = told(CascadeSettings(model=own))
    assert (model.state, dye.state, water.state) == ("ok", "ok", "warning")
    assert "30 normal wells" in model.said
    assert (dye.said, water.said) == (str(seen), str(blind))
    save_model(own, made.kind, made.arrays, made.settings, {"recordings": [{"normals": 3}]})
    (few,) = told(CascadeSettings(model=own))
    assert few.state == "warning"
    assert "3 normal wells" in few.todo


def test_a_sidecar_at_work_is_asked_and_not_disturbed(sound: SidecarConfig) -> None:
    with running_sidecar(sound, StubCamera()):
        checks = found(sound)
    assert "as the sidecar at work says" in checks["camera"].said
    assert checks["store"].state == "ok"


def test_advice_on_a_view() -> None:
    camera = SimulatedCamera(1)
    camera.announce(make_keyframe("run", 1))
    sharp = camera.frame_after(0.0, 5.0)
    detector = load_detector()
    view = measure(sharp, detector)
    assert view.tip is not None
    assert not [said for said in view.advice if "dark" in said or "blown" in said]

    def advice(image: np.ndarray) -> str:
        return " ".join(measure(Frame(sharp.jpeg, image, 0.0), detector).advice)

    assert "dark" in advice(np.zeros_like(sharp.image))
    assert "blown out" in advice(np.full_like(sharp.image, 255))
    import cv2

    assert "soft" in advice(cv2.GaussianBlur(sharp.image, (0, 0), 6))
