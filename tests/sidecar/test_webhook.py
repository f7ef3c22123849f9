"""The record of a run that ended reaches an ELN: signed, again if need be, and nobody waits."""

from __future__ import annotations

import hashlib
import hmac
import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest
from pydantic import SecretStr

from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.config import WebhookSettings
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.webhook import WebHook

from .helpers import Robot, StubAnalyser, StubCamera, until

SECRET = "a secret of the laboratory"


class Receiver:
    """A server that takes what comes, or refuses the first few."""

    def __init__(self) -> None:
        self.got: list[tuple[dict[str, str], bytes]] = []
        self.answers: list[int] = []
        self.hang = threading.Event()
        self.hang.set()
        receiver = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                receiver.hang.wait(60)
                receiver.got.append((dict(self.headers), body))
                self.send_response(receiver.answers.pop(0) if receiver.answers else 204)
                self.end_headers()

            def log_message(self, *_: Any) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self.server.server_port}/hook"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def settings(self) -> WebhookSettings:
        return WebhookSettings(url=SecretStr(self.url), secret=SecretStr(SECRET))


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    receiver = Receiver()
    yield receiver
    receiver.hang.set()
    receiver.server.shutdown()
    receiver.server.server_close()


def is_ours(headers: dict[str, str], body: bytes) -> bool:
    text = headers["X-Aegis-Timestamp"].encode() + b"." + body
    code = hmac.new(SECRET.encode(), text, hashlib.sha256).hexdigest()
    return headers["X-Aegis-Signature"] == f"sha256={code}"


def test_an_ended_run_is_sent_signed_and_the_robot_waits_for_nothing(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, receiver: Receiver
) -> None:
    receiver.hang.clear()
    config = config.model_copy(update={"webhook": receiver.settings()})
    with running_sidecar(config, camera, analyser) as url, Robot(url) as robot:
        robot.register()
        for trajectory in range(3):
            robot.cycle(trajectory)
        assert robot.post("finish", {"outcome": "succeeded"}).status_code == 200
        assert robot.http.get("/v1/health").status_code == 200  # while the ELN hangs
        receiver.hang.set()
        until(lambda: bool(receiver.got))
    headers, body = receiver.got[0]
    assert is_ours(headers, body)
    assert not is_ours(headers, body + b" ")
    told = json.loads(body)
    assert (told["event"], told["run"]) == ("run.ended", "run-1")
    assert [well["state"] for well in told["wells"]] == ["pass", "fail", "undecided"]
    assert len(told["record"]["hash"]) == 64


def test_a_refused_record_is_sent_again_and_then_told_of(receiver: Receiver) -> None:
    failures: list[tuple[str, str]] = []
    hook = WebHook(
        receiver.settings(), lambda run: {"run": run}, lambda run: True,
        lambda run, why: failures.append((run, why)), retries_s=(0.01, 0.01),
    )  # fmt: skip
    receiver.answers = [500, 503]
    hook.add("first")
    until(lambda: len(receiver.got) == 3)
    assert len({headers["X-Aegis-Delivery"] for headers, _ in receiver.got}) == 1
    receiver.answers = [500, 302, 401]
    hook.add("second")
    until(lambda: bool(failures))
    hook.close()
    (run, why), *others = failures
    assert (run, "it answered 401" in why, others) == ("second", True, [])
    assert receiver.url not in why


def test_an_address_that_nobody_answers_is_told_of_at_the_stop() -> None:
    failures: list[tuple[str, str]] = []
    hook = WebHook(
        WebhookSettings(url=SecretStr("http://127.0.0.1:9/x"), secret=SecretStr(SECRET)),
        lambda run: {"run": run}, lambda run: True, lambda run, why: failures.append((run, why)),
    )  # fmt: skip
    hook.add("run-1")
    hook.close()
    assert "no answer" in failures[0][1]


def test_what_still_waits_at_the_stop_is_named_on_the_page_of_its_run(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, receiver: Receiver
) -> None:
    receiver.hang.clear()  # the first is tried for longer than a stop takes
    config = config.model_copy(update={"webhook": receiver.settings()})
    with running_sidecar(config, camera, analyser) as url:
        for run in ("run-1", "run-2"):
            with Robot(url, run) as robot:
                robot.register()
                robot.post("finish", {"outcome": "stopped"})
    store = Store(config.data)
    for run in ("run-1", "run-2"):
        (incident,) = store.incidents(run)
        assert incident["kind"] == "webhook"
        assert "was stopped before" in incident["text"]
    store.close()


def test_a_record_that_cannot_be_made_is_told_of(receiver: Receiver) -> None:
    failures: list[tuple[str, str]] = []
    hook = WebHook(
        receiver.settings(), lambda run: {}[run], lambda run: True,
        lambda run, why: failures.append((run, why)),
    )  # fmt: skip
    hook.add("run-1")
    hook.close()
    ((run, why),) = failures
    assert (run, "KeyError" in why) == ("run-1", True)


@pytest.mark.parametrize(
    ("url", "secret", "said"),
    [
        ("ftp://eln/x", SECRET, "http:// or https://"),
        ("https://eln/x", "short", "at least 16 characters"),
        ("https://user:password@eln/x", "", "at least 16 characters"),
    ],
)
def test_settings_that_make_no_sense_are_refused(url: str, secret: str, said: str) -> None:
    with pytest.raises(ConfigurationError, match=said) as refused:
        SidecarConfig.load(environ={}, webhook={"url": url, "secret": secret})
    assert "password" not in str(refused.value)
