"""Who is let in."""

from __future__ import annotations

import json
import logging
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import httpx
import pytest
from pydantic import SecretStr

from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar, security
from aegis_ot.sidecar.config import NotificationSettings
from aegis_ot.sidecar.journal import set_up
from aegis_ot.sidecar.rate_limit import RateLimit
from aegis_ot.sidecar.token_file import kept_token

from .helpers import Robot, StubAnalyser, StubCamera

TOKEN = "s3cret-token-of-the-lab"


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


@pytest.mark.parametrize("other", ["a[]=1", 'x="', "aegis_ot=old", "=;;", "é=ü"])
def test_cookies_of_others_do_not_lock_the_page(guarded: str, other: str) -> None:
    cookie = f"{other}; aegis_ot={security.cookie_value(TOKEN)}"
    with httpx.Client(base_url=guarded, trust_env=False) as http:
        told = {"Cookie": cookie.encode("latin-1")}
        assert http.get("/v1/runs", headers=told).status_code == 200
        assert http.get("/v1/runs", headers={"Cookie": other.encode("latin-1")}).status_code == 401


def test_the_page_works_behind_a_proxy_that_does_not_pass_host(
    config: SidecarConfig, tmp_path: Path
) -> None:
    behind = {"Origin": "https://lab.example"}
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        order = {"by": "Ada", "answer": "pause"}

        def post(**headers: str) -> int:
            told = behind | {name.replace("_", "-"): value for name, value in headers.items()}
            return robot.http.post("/runs/run-1/order", data=order, headers=told).status_code

        assert post(Sec_Fetch_Site="same-origin") == 303
        for said in ("cross-site", "same-site", "none", ""):
            assert post(Sec_Fetch_Site=said) == 403
        assert "set url to the address" in robot.http.post(
            "/runs/run-1/order", data=order, headers=behind
        ).text  # fmt: skip
    told = config.model_copy(update={"url": "https://lab.example/", "data": tmp_path / "other"})
    with running_sidecar(told, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        assert post() == 303


def test_other_users_of_the_machine_read_nothing(config: SidecarConfig) -> None:
    config.data.mkdir(0o755)
    config.data.chmod(0o755)
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
    assert config.data.stat().st_mode & 0o777 == 0o750


@pytest.mark.skipif(os.name != "posix", reason="modes are POSIX's")
def test_what_the_process_writes_is_its_own_users(tmp_path: Path) -> None:
    settings = tmp_path / "sidecar.json"
    told = {"port": 0, "data": str(tmp_path / "data"), "camera": {"spec": "pattern"}}
    settings.write_text(json.dumps(told | {"log": "json"}))
    process = subprocess.Popen(
        [sys.executable, "-m", "aegis_ot.sidecar", str(settings)], stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    address = next(json.loads(li)["address"] for li in process.stderr if '"ready"' in li)
    with Robot(address) as robot:
        robot.register()
        robot.cycle(0)
    process.terminate()
    process.communicate(timeout=60)
    paths = [tmp_path / "data", *(tmp_path / "data").rglob("*")]
    assert any(path.suffix == ".jpg" for path in paths)
    assert [str(path) for path in paths if path.stat().st_mode & 0o077] == []


@pytest.mark.parametrize("host", ["0.0.0.0", "192.168.1.20", "::", "lab-pc"])
def test_no_open_door_without_a_token(host: str) -> None:
    with pytest.raises(ConfigurationError, match="without a token"):
        SidecarConfig.load(environ={}, host=host)
    assert SidecarConfig.load(environ={}, host=host, token=TOKEN).host == host


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.1.2.3"])
def test_loopback_needs_none(host: str) -> None:
    assert SidecarConfig.load(environ={}, host=host).token is None


def test_on_a_network_a_token_cannot_be_guessed() -> None:
    with pytest.raises(ConfigurationError, match="at least 16"):
        SidecarConfig.load(environ={}, host="0.0.0.0", token="short")
    assert SidecarConfig.load(environ={}, token="short").token is not None


def test_a_token_is_made_once_and_kept_for_its_owner(tmp_path: Path) -> None:
    def load() -> SidecarConfig:
        return SidecarConfig.load(
            environ={}, find_token=kept_token, host="0.0.0.0", data=tmp_path / "d"
        )

    first, second = load().token, load().token
    assert first is not None
    assert first == second
    assert len(first.get_secret_value()) >= 16
    assert (tmp_path / "d" / "token").stat().st_mode & 0o077 == 0
    here = SidecarConfig.load(environ={}, find_token=kept_token, data=tmp_path / "other")
    assert here.token is None
    assert not (tmp_path / "other").exists()


def test_wrong_logins_are_slowed_and_logged(
    guarded: str, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    slept: list[float] = []
    now = [100.0]
    monkeypatch.setattr(security, "time", SimpleNamespace(monotonic=lambda: now[0]))

    async def sleep(seconds: float) -> None:
        slept.append(seconds)

    monkeypatch.setattr(security, "asyncio", SimpleNamespace(sleep=sleep))
    caplog.set_level("INFO")
    with httpx.Client(base_url=guarded, trust_env=False) as http:
        for _ in range(3):
            assert http.post("/login", data={"token": "guess"}).status_code == 401
        slowed = http.post("/login", data={"token": TOKEN})
        assert slowed.status_code == 429
        assert int(slowed.headers["retry-after"]) <= 1
        assert http.get("/v1/runs", headers={"Authorization": "Bearer no"}).status_code == 401
        assert slept == [security.SLOW_S]
        now[0] += 1.0
        assert http.post("/login", data={"token": TOKEN}).status_code == 303
    told = [record.facts for record in caplog.records if record.getMessage() == "login"]
    assert [fact["ok"] for fact in told] == [False] * 4 + [True]
    assert {fact["address"] for fact in told} == {"127.0.0.1"}


def test_an_address_that_asks_too_much_is_told_to_wait(
    config: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(security, "RateLimit", lambda: RateLimit(per_second=0.0, at_once=3))
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        answers = [robot.http.get("/v1/health") for _ in range(4)]
    assert [answer.status_code for answer in answers] == [200, 200, 200, 429]
    assert answers[3].json()["error"]["code"] == "rate"
    assert answers[3].headers["retry-after"] == "1"


def test_addresses_have_buckets_of_their_own_that_fill_again() -> None:
    now = [0.0]
    limit = RateLimit(per_second=2.0, at_once=2.0, now=lambda: now[0])
    assert [limit.takes("a") for _ in range(3)] == [True, True, False]
    assert limit.takes("b")
    now[0] += 0.5
    assert [limit.takes("a") for _ in range(2)] == [True, False]
    for number in range(2000):
        limit.takes(f"10.0.{number}")
    assert len(limit._left) == 1000


def test_no_secret_is_in_the_log_or_the_store(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    data = tmp_path / "data"
    hook = SecretStr("json://user:hook-passw0rd@127.0.0.1:9/")
    config = SidecarConfig(
        port=0, data=data, token=SecretStr(TOKEN), notifications=NotificationSettings(urls=(hook,))
    )
    set_up("json")
    try:
        with (
            running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url,
            Robot(url, token=TOKEN) as robot,
        ):
            robot.register()
            robot.cycle(0)
            robot.verdict(0)
            robot.http.get("/", params={"token": TOKEN})
            robot.http.post("/login", data={"token": TOKEN})
    finally:
        logging.getLogger("aegis_ot").handlers.clear()
        logging.getLogger("aegis_ot").propagate = True
    said = capfd.readouterr()
    lines = [json.loads(line) for line in said.err.splitlines() if line.startswith("{")]
    assert {"run", "verdict", "login"} <= {line["event"] for line in lines}
    everything = said.out + said.err
    for path in data.rglob("*"):
        if path.is_file():
            everything += path.read_bytes().decode("latin-1")
    for secret in (TOKEN, "hook-passw0rd"):
        assert secret not in everything


EVIL = "a\n::error::owned\r\x1b[2J\u2028.py"


@pytest.mark.parametrize("form", ["text", "json"])
def test_what_robots_and_people_say_is_one_line_of_the_log(
    form: str, config: SidecarConfig, capfd: pytest.CaptureFixture[str]
) -> None:
    set_up(form)
    try:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
            about = {"run": "run-1", "protocol": EVIL, "robot_name": EVIL}
            robot.http.put("/v1/runs/run-1", json=about)
            robot.cycle(0)
            robot.post("order", {"action": "pause", "by": EVIL, "note": EVIL})
            robot.post("finish", {"outcome": "failed", "detail": EVIL})
            logging.getLogger("aegis_ot.else").error("It said %s", EVIL)
            try:
                raise ValueError(EVIL)
            except ValueError:
                logging.getLogger("aegis_ot.else").exception("Failed")
            assert robot.overview()["protocol"] == "a ::error::owned [2J .py"
    finally:
        logging.getLogger("aegis_ot").handlers.clear()
        logging.getLogger("aegis_ot").propagate = True
    said = capfd.readouterr().err
    assert said.count("owned") >= 4
    assert "\x1b" not in said
    assert not any(line.startswith("::error") for line in said.splitlines())


@pytest.mark.parametrize(
    ("host", "opens"), [("0.0.0.0", r"http://[\d.]+:\d+"), ("127.0.0.1", r"http://127.0.0.1:\d+")]
)
def test_the_printed_address_is_one_that_opens(host: str, opens: str, tmp_path: Path) -> None:
    config = SidecarConfig(host=host, port=0, data=tmp_path, token=SecretStr(TOKEN))
    with running_sidecar(config, StubCamera()) as url:
        assert re.fullmatch(opens, url)
        assert "0.0.0.0" not in url
        assert httpx.get(f"{url}/v1/health", trust_env=False).status_code == 200


def test_the_token_is_not_shown(tmp_path: Path) -> None:
    assert TOKEN not in repr(SidecarConfig.load(environ={}, token=TOKEN))
