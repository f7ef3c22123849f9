"""Passwords and keys in addresses reach no log, page, answer, report or terminal."""

from __future__ import annotations

import io
import json
import logging
import time
from collections.abc import Iterator

import httpx
import pytest

from aegis_ot.doctor import examine
from aegis_ot.errors import CameraError, ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras import open_camera
from aegis_ot.sidecar.config import CameraSettings
from aegis_ot.sidecar.journal import _Json, _Text, event
from aegis_ot.vocabulary import without_secrets

from .helpers import Robot, StubAnalyser

SPEC = "http://ada:hunter2@127.0.0.1:9/s3cret-path/stream?key=pa55"
SECRETS = ("hunter2", "s3cret-path", "pa55")


def holds_none(text: str) -> None:
    assert [secret for secret in SECRETS if secret in text] == []


@pytest.fixture
def unsafe(config: SidecarConfig) -> SidecarConfig:
    """A camera that is not there, with keys in its address."""
    return config.model_copy(update={"camera": CameraSettings(spec=SPEC, timeout_s=0.2)})


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        (SPEC, "http://127.0.0.1:9/..."),
        ("rtsp://cam.local:554 ended the stream.", "rtsp://cam.local:554 ended the stream."),
        ("robot:http://[fe80::1]:31950", "robot:http://[fe80::1]:31950"),
        ("rtsp://ada:hunter2/s3cret-path@cam/live: lost", "rtsp://cam/...: lost"),
        ("usb:0", "usb:0"),
        ("(see http://h/a?b=pa55)", "(see http://h/...)"),
    ],
)
def test_an_address_is_shown_as_host_and_port(text: str, shown: str) -> None:
    assert without_secrets(text) == shown


def test_the_sidecar_tells_nobody(unsafe: SidecarConfig) -> None:
    with running_sidecar(unsafe, None, StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        refused = robot.send(0)
        assert refused.status_code == 503
        for path in ("/v1/health", "/runs", "/camera", "/v1/camera", f"/v1/runs/{robot.run}"):
            holds_none(httpx.get(url + path, trust_env=False).text)
    holds_none(refused.text)
    holds_none(repr(unsafe))


def test_the_doctor_tells_nobody(unsafe: SidecarConfig, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("aegis_ot.doctor._FIRST_FRAME_S", 0.5)
    told = [f"{check.said} {check.todo}" for check in examine(unsafe)]
    assert any("127.0.0.1:9" in line for line in told)
    holds_none(" ".join(told))


def test_an_unknown_camera_is_named_without_its_password() -> None:
    with pytest.raises(ConfigurationError) as told:
        open_camera(CameraSettings(spec=SPEC.replace("http", "htp")))
    holds_none(str(told.value))


@pytest.fixture(params=[_Text(), _Json()], ids=["text", "json"])
def log(request: pytest.FixtureRequest) -> Iterator[io.StringIO]:
    stream = io.StringIO()
    handler = logging.StreamHandler(stream)
    handler.setFormatter(request.param)
    logger = logging.getLogger("aegis_ot")
    logger.addHandler(handler)
    level = logger.level
    logger.setLevel(logging.INFO)
    yield stream
    logger.setLevel(level)
    logger.removeHandler(handler)


def test_the_log_tells_nobody(log: io.StringIO) -> None:
    event("ready", camera=SPEC)
    camera = open_camera(CameraSettings(spec=SPEC))
    with pytest.raises(CameraError):
        camera.frame_after(time.monotonic(), 1.0)
    camera.close()
    try:
        raise ValueError(SPEC)
    except ValueError:
        logging.getLogger("aegis_ot").exception("lost %s", SPEC)
    told = log.getvalue()
    assert told.count("127.0.0.1:9") >= 4
    holds_none(told)
    if told.startswith("{"):
        assert all(json.loads(line) for line in told.splitlines())
