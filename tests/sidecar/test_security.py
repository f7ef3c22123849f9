"""Who is let in."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from pydantic import SecretStr

from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar

from .helpers import Robot, StubAnalyser, StubCamera

TOKEN = "s3cret-token"


@pytest.fixture
def guarded(tmp_path: Path) -> Iterator[str]:
    config = SidecarConfig(port=0, data=tmp_path, token=SecretStr(TOKEN))
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
        yield url


@pytest.mark.parametrize("token", [None, "wrong", TOKEN + "x", TOKEN[:-1]])
def test_without_the_token_there_is_only_health(guarded: str, token: str | None) -> None:
    with Robot(guarded, token=token) as robot:
        assert robot.http.get("/v1/health").status_code == 200
        for answer in (robot.register(), robot.send(0), robot.http.get("/v1/runs")):
            assert answer.status_code == 401
            assert answer.json()["error"]["code"] == "token"
        page = robot.http.get("/")
        assert (page.status_code, page.headers["location"]) == (303, "/login")


def test_with_the_token_the_robot_works(guarded: str) -> None:
    with Robot(guarded, token=TOKEN) as robot:
        assert robot.register().status_code == 200
        assert robot.send(0).status_code == 200


def test_a_person_logs_in_and_the_cookie_is_not_the_token(guarded: str) -> None:
    with httpx.Client(base_url=guarded, trust_env=False) as http:
        wrong = http.post("/login", data={"token": "guess"})
        assert wrong.status_code == 401
        assert "not the sidecar" in wrong.text
        assert http.get("/v1/runs").status_code == 401
        assert http.post("/login", data={"token": TOKEN}).status_code == 303
        cookie = http.cookies["aegis_ot"]
        assert TOKEN not in cookie
        assert http.get("/v1/runs").status_code == 200
        assert http.get("/").status_code == 200


def test_a_token_in_the_address_is_taken_out_of_it(guarded: str) -> None:
    with httpx.Client(base_url=guarded, trust_env=False) as http:
        answer = http.get("/", params={"token": TOKEN, "run": "a b"})
        assert (answer.status_code, answer.headers["location"]) == (303, "/?run=a+b")
        assert http.get("/").status_code == 200
    with httpx.Client(base_url=guarded, trust_env=False) as http:
        answer = http.get(f"//evil.example/?token={TOKEN}")
        assert not answer.headers.get("location", "").startswith("//")


def test_another_web_site_can_change_nothing(robot: Robot) -> None:
    robot.cycle(0)
    for origin in ("http://evil.example", "null", "http://["):
        answer = robot.http.post(
            "/v1/runs/run-1/finish",
            json={"outcome": "failed"},
            headers={"Origin": origin},
        )
        assert answer.status_code == 403
    rebound = robot.http.get("/v1/runs", headers={"Host": "evil.example:7645"})
    assert rebound.status_code == 403


@pytest.mark.parametrize("host", ["0.0.0.0", "192.168.1.20", "::", "lab-pc"])
def test_no_open_door_without_a_token(host: str) -> None:
    with pytest.raises(ConfigurationError, match="without a token"):
        SidecarConfig.load(environ={}, host=host)
    assert SidecarConfig.load(environ={}, host=host, token=TOKEN).host == host


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.1.2.3"])
def test_loopback_needs_none(host: str) -> None:
    assert SidecarConfig.load(environ={}, host=host).token is None


def test_the_token_is_not_shown(tmp_path: Path) -> None:
    assert TOKEN not in repr(SidecarConfig.load(environ={}, token=TOKEN))
