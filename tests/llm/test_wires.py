"""Both services through their real SDKs, against a server on this machine."""

from __future__ import annotations

import datetime
import email.utils
import importlib
import json
import logging
import socket
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest

from aegis_ot.llm import Backend, Reply, State
from aegis_ot.llm.backends.anthropic_api import AnthropicBackend
from aegis_ot.llm.backends.openai_api import OpenAIBackend
from aegis_ot.llm.backends.retrying import RetryPolicy
from aegis_ot.llm.backends.service import RequestOptions

from .samples import GOOD, PNG, FakeClock, request
from .wire_server import (
    Answer,
    WireServer,
    anthropic_error,
    anthropic_message,
    openai_completion,
    openai_error,
)

KEY = "sk-test-0123456789abcdef"


@dataclass(frozen=True)
class Service:
    """One of the two wire formats."""

    name: str
    make: Callable[..., Backend]
    good: Any
    error: Callable[[str, str], dict[str, Any]]
    overloaded: int

    def backend(self, url: str, **options: Any) -> Backend:
        base = url if self.name == "anthropic" else f"{url}/v1"
        values: dict[str, Any] = {"key": KEY, "trust_env": False, "clock": FakeClock()}
        for name in [name for name in options if name in RequestOptions.__dataclass_fields__]:
            values[name] = options.pop(name)
        return self.make("some-model", base, **options, manner=RequestOptions(**values))


SERVICES = [
    Service("anthropic", AnthropicBackend, anthropic_message(GOOD), anthropic_error, 529),
    Service("openai", OpenAIBackend, openai_completion(json.dumps(GOOD)), openai_error, 503),
]


@pytest.fixture(params=SERVICES, ids=lambda service: service.name)
def service(request: pytest.FixtureRequest) -> Service:
    chosen: Service = request.param
    return chosen


def test_an_answer_comes_back_with_its_usage(service: Service, server: WireServer) -> None:
    server.answers = [Answer(body=service.good)]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.ANSWERED
    assert reply.value == GOOD
    assert reply.usage.total_input >= 4400
    assert reply.usage.cached == 3500
    assert reply.usage.output == 321
    assert reply.attempts == 1
    assert reply.model in ("claude-test-1", "gpt-test-1")


def test_the_key_goes_to_the_service_and_nowhere_else(
    service: Service, server: WireServer, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    said = f"invalid key {KEY}, you sent sk-test-01234***cdef"
    server.answers = [Answer(401, service.error("authentication_error", said))]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.UNAUTHORIZED
    sent = server.seen[0].headers
    assert KEY in sent.get("x-api-key", "") + sent.get("authorization", "")
    assert "sk-test" not in reply.detail + reply.raw + repr(reply) + caplog.text
    assert len(server.seen) == 1, "a refused key is not tried again"


def test_without_a_key_nobody_is_asked(server: WireServer, monkeypatch: pytest.MonkeyPatch) -> None:
    for backend in (AnthropicBackend("m", server.url), OpenAIBackend("m")):
        reply = backend.ask(request())
        assert reply.state is State.NO_KEY
        assert "_API_KEY" in reply.detail
    assert server.seen == []


def test_openais_key_stays_with_openai(server: WireServer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    monkeypatch.setenv("OPENAI_ORG_ID", "org-secret")
    server.answers = [Answer(body=openai_completion(json.dumps(GOOD)))]
    backend = OpenAIBackend("m", f"{server.url}/v1", manner=RequestOptions(trust_env=False))
    assert backend.ask(request()).answered
    assert KEY not in json.dumps(server.seen[0].headers)
    assert "org-secret" not in json.dumps(server.seen[0].headers)


@pytest.mark.parametrize("key", ["two\nlines-1234", "with space", "“quoted-1234”", "sécret-1234"])
def test_what_cannot_be_a_key_is_not_sent(
    service: Service, server: WireServer, caplog: pytest.LogCaptureFixture, key: str
) -> None:
    """HTTP clients log a header that they cannot send, and services repeat one garbled."""
    caplog.set_level(logging.DEBUG)
    reply = service.backend(server.url, key=key).ask(request())
    assert reply.state is State.NO_KEY
    assert server.seen == []
    for part in ("1234", "with space", "cret"):
        assert part not in reply.detail + caplog.text


def test_a_key_at_the_cut_of_a_long_message_is_cut_out_whole(
    service: Service, server: WireServer
) -> None:
    for length in range(270, 300, 7):
        server.seen.clear()
        said = "x" * length + " plain-secret-0123456789"
        server.answers = [Answer(400, service.error("odd", said))]
        reply = service.backend(server.url, key="plain-secret-0123456789").ask(request())
        assert "plain" not in reply.detail


def test_what_a_service_or_model_says_cannot_paint_the_terminal(
    service: Service, server: WireServer
) -> None:
    server.answers = [Answer(400, service.error("odd", "no\x1b[31m\u202e\ud800 schema\nsecond"))]
    detail = service.backend(server.url).ask(request()).detail
    assert detail.isprintable()
    assert "second" in detail
    for said in ({"verdict": "\x1b[2J\ud800", "lines": []}, GOOD | {"\x1b[2J\ud800": 1}):
        text = json.dumps(said)
        body = (
            anthropic_message(said)
            if service.name == "anthropic"
            else openai_completion(text) | {"model": "m\x1b[2J\n"}
        )
        server.answers = [Answer(body=body)]
        reply = service.backend(server.url).ask(request())
        assert reply.state is State.INVALID
        assert (reply.detail + reply.model).isprintable()


def test_nesting_of_any_depth_is_invalid(service: Service, server: WireServer) -> None:
    """Near the interpreter's limit reading succeeds and writing again may not."""
    for depth in (200, *range(970, 1000, 3), 100_000):
        said = "[" * depth + "]" * depth
        body = (
            anthropic_message(None, "end_turn", said)
            if service.name == "anthropic"
            else openai_completion(said)
        )
        server.seen.clear()
        server.answers = [Answer(body=body)]
        reply = service.backend(server.url).ask(request())
        assert reply.state is State.INVALID, depth


def test_loading_the_sdk_takes_none_of_the_services_time(
    service: Service, server: WireServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = FakeClock()
    load = importlib.import_module

    def slowly(name: str) -> Any:
        clock.sleep(5)
        return load(name)

    monkeypatch.setattr("aegis_ot.llm.backends.service.importlib.import_module", slowly)
    server.answers = [Answer(body=service.good)]
    patience = RetryPolicy(timeout_s=4)
    assert service.backend(server.url, clock=clock, patience=patience).ask(request()).answered


def test_a_rate_limit_is_waited_out_as_told(service: Service, server: WireServer) -> None:
    limited = Answer(429, service.error("rate_limit_error", "slow down"), {"retry-after": "7"})
    server.answers = [limited, Answer(body=service.good)]
    clock = FakeClock()
    reply = service.backend(server.url, clock=clock).ask(request())
    assert reply.answered
    assert clock.slept == [7.0]
    assert reply.attempts == 2


def test_a_rate_limit_that_stays_is_reported(service: Service, server: WireServer) -> None:
    server.answers = [Answer(429, service.error("rate_limit_error", "slow down"))]
    clock = FakeClock()
    reply = service.backend(server.url, clock=clock).ask(request())
    assert reply.state is State.RATE_LIMITED
    assert clock.slept == [0.5, 1.0, 2.0], "waits double"
    assert "slow down" in reply.detail
    assert "4 times" in reply.detail


def test_a_wait_longer_than_there_is_time_is_not_begun(
    service: Service, server: WireServer
) -> None:
    limited = Answer(429, service.error("rate_limit_error", "later"), {"retry-after": "600"})
    server.answers = [limited]
    clock = FakeClock()
    assert service.backend(server.url, clock=clock).ask(request()).state is State.RATE_LIMITED
    assert clock.slept == []
    assert len(server.seen) == 1


@pytest.mark.parametrize("status", [500, 503, 529])
def test_an_outage_is_tried_again(service: Service, server: WireServer, status: int) -> None:
    error = service.error("overloaded_error", "Overloaded")
    server.answers = [Answer(status, error), Answer(status, error), Answer(body=service.good)]
    reply = service.backend(server.url).ask(request())
    assert reply.answered
    assert reply.attempts == 3


def test_an_outage_that_stays_is_reported(service: Service, server: WireServer) -> None:
    server.answers = [Answer(service.overloaded, service.error("overloaded_error", "Overloaded"))]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.UNAVAILABLE
    assert str(service.overloaded) in reply.detail


def test_an_unknown_model_is_a_bad_request(service: Service, server: WireServer) -> None:
    server.answers = [Answer(404, service.error("not_found_error", "model: some-model"))]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.BAD_REQUEST
    assert "some-model" in reply.detail
    assert len(server.seen) == 1


def test_nobody_listening_is_an_outage(service: Service) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    reply = service.backend(f"http://127.0.0.1:{port}").ask(request())
    assert reply.state is State.UNAVAILABLE
    assert "reached" in reply.detail


@pytest.mark.parametrize("how", ["hang", "drip"])
def test_silence_ends_in_time(service: Service, server: WireServer, how: str) -> None:
    server.answers = [Answer(hang=how == "hang", drip=how == "drip")]
    backend = service.backend(server.url, patience=RetryPolicy(timeout_s=0.4))
    reply = backend.ask(request())
    assert reply.state is State.TIMEOUT


@pytest.mark.parametrize(
    "body",
    [
        b"<html>gateway</html>",
        b"",
        b"{}",
        b"[1]",
        b'"text"',
        b"null",
        b'{"content": 3, "choices": 3}',
    ],
)
def test_garbage_is_invalid_and_never_raises(
    service: Service, server: WireServer, body: bytes
) -> None:
    server.answers = [Answer(body=body)]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.INVALID
    assert reply.value is None
    assert reply.detail


def test_a_connection_lost_within_the_answer_is_tried_again(
    service: Service, server: WireServer
) -> None:
    server.answers = [Answer(body=service.good, drop=True), Answer(body=service.good)]
    reply = service.backend(server.url).ask(request())
    assert reply.answered
    assert reply.attempts == 2
    server.seen.clear()
    server.answers = [Answer(body=service.good, drop=True)]
    reply = service.backend(server.url).ask(request())
    assert reply.state is State.UNAVAILABLE
    assert reply.attempts == 4


def test_a_dated_retry_after_is_understood(service: Service, server: WireServer) -> None:
    soon = email.utils.format_datetime(
        datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(seconds=9), usegmt=True
    )
    limited = Answer(429, service.error("rate_limit_error", "later"), {"retry-after": soon})
    server.answers = [limited, Answer(body=service.good)]
    clock = FakeClock()
    assert service.backend(server.url, clock=clock).ask(request()).answered
    (slept,) = clock.slept
    assert 6 < slept <= 9


@pytest.mark.parametrize("status", [500, 502, 503, 504, 408])
def test_failures_that_pass_are_outlived(service: Service, server: WireServer, status: int) -> None:
    failing = Answer(status, b"<html>upstream</html>")
    server.answers = [failing, failing, Answer(body=service.good)]
    reply = service.backend(server.url).ask(request())
    assert reply.answered
    assert reply.attempts == 3


def test_nobody_is_sent_elsewhere(service: Service, server: WireServer) -> None:
    """A redirect would take the protocol, and maybe the key, to another address."""
    with WireServer() as other:
        other.answers = [Answer(body=service.good)]
        server.answers = [Answer(307, {}, {"location": f"{other.url}/v1/messages"})]
        reply = service.backend(server.url).ask(request())
        assert reply.state is State.BAD_REQUEST
        assert "307" in reply.detail
        assert other.seen == []


def test_an_answer_without_a_choice_is_invalid(server: WireServer) -> None:
    anthropic, openai = SERVICES
    empty = openai_completion(json.dumps(GOOD)) | {"choices": []}
    assert _replies(openai, server, empty).state is State.INVALID
    server.seen.clear()
    silent = openai_completion(None)
    assert _replies(openai, server, silent).state is State.INVALID
    server.seen.clear()
    reply = _replies(anthropic, server, anthropic_message(None, "end_turn"))
    assert reply.state is State.INVALID
    # OpenAI-compatible routers put an error into an answer with status 200.
    server.seen.clear()
    assert _replies(openai, server, openai_error("overloaded", "no")).state is State.INVALID


def test_a_key_in_any_error_is_cut_out(
    service: Service, server: WireServer, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    for status in (400, 403, 404, 429, 500):
        server.seen.clear()
        server.answers = [Answer(status, service.error("odd", f"with {KEY} you may not"))]
        reply = service.backend(server.url).ask(request())
        assert "you may not" in reply.detail
        assert KEY not in reply.detail + repr(reply)
    assert KEY not in caplog.text
    assert KEY not in repr(vars(service.backend(server.url)))


def _replies(service: Service, server: WireServer, body: Any) -> Reply:
    server.answers = [Answer(body=body)]
    return service.backend(server.url).ask(request())


def test_refusals_are_named(server: WireServer) -> None:
    anthropic, openai = SERVICES
    refused = anthropic_message(None, "refusal", "I can't help with that.")
    reply = _replies(anthropic, server, refused)
    assert reply.state is State.REFUSED
    assert "can't help" in reply.detail
    assert reply.usage.output == 321, "a refusal is paid for"
    server.seen.clear()
    assert _replies(openai, server, openai_completion(None, refusal="No.")).state is State.REFUSED
    server.seen.clear()
    filtered = openai_completion("", "content_filter")
    assert _replies(openai, server, filtered).state is State.REFUSED


def test_truncated_answers_are_named_even_if_they_parse(server: WireServer) -> None:
    anthropic, openai = SERVICES
    cut = anthropic_message(GOOD, "max_tokens")
    assert _replies(anthropic, server, cut).state is State.TRUNCATED
    server.seen.clear()
    cut = openai_completion(json.dumps(GOOD), "length")
    assert _replies(openai, server, cut).state is State.TRUNCATED


def test_what_does_not_fit_the_schema_is_invalid(server: WireServer) -> None:
    anthropic, openai = SERVICES
    for bad in ({"verdict": "approved", "lines": []}, {"verdict": "pass"}, GOOD | {"extra": 1}):
        server.seen.clear()
        reply = _replies(anthropic, server, anthropic_message(bad))
        assert reply.state is State.INVALID
        server.seen.clear()
        reply = _replies(openai, server, openai_completion(json.dumps(bad)))
        assert reply.state is State.INVALID
        assert "verdict" in reply.detail or "lines" in reply.detail or "extra" in reply.detail
    server.seen.clear()
    prose = openai_completion("The protocol looks fine to me.")
    assert _replies(openai, server, prose).state is State.INVALID


def test_what_is_sent_to_anthropic(server: WireServer) -> None:
    anthropic = SERVICES[0]
    server.answers = [Answer(body=anthropic.good)]
    anthropic.backend(server.url).ask(request("Look:", PNG))
    sent = server.seen[0].body
    assert server.seen[0].path == "/v1/messages"
    assert sent["system"][0]["cache_control"] == {"type": "ephemeral"}
    assert "cache_control" not in sent["system"][1]
    assert sent["tool_choice"] == {"type": "tool", "name": "layer1"}
    assert sent["tools"][0]["input_schema"]["required"] == ["verdict", "lines"]
    text, image = sent["messages"][0]["content"]
    assert text == {"type": "text", "text": "Look:"}
    assert image["source"]["media_type"] == "image/png"
    assert sent["max_tokens"] == 1200
    assert "temperature" not in sent


def test_anthropics_own_output_format(server: WireServer) -> None:
    server.answers = [Answer(body=anthropic_message(None, "end_turn", json.dumps(GOOD)))]
    reply = SERVICES[0].backend(server.url, structured="output").ask(request())
    assert reply.value == GOOD
    form = server.seen[0].body["output_config"]["format"]
    assert form["type"] == "json_schema"
    assert "tools" not in server.seen[0].body


def test_what_is_sent_to_openai_servers(server: WireServer) -> None:
    answers = {
        "json_schema": openai_completion(json.dumps(GOOD)),
        "tool": openai_completion(None, "tool_calls", arguments=json.dumps(GOOD)),
        "guided_json": openai_completion(f"```json\n{json.dumps(GOOD)}\n```"),
        "json_object": openai_completion(json.dumps(GOOD)),
    }
    sent = {}
    for structured, body in answers.items():
        server.seen.clear()
        server.answers = [Answer(body=body)]
        backend = SERVICES[1].backend(server.url, structured=structured, limit="max_tokens")
        assert backend.ask(request("Look:", PNG)).value == GOOD, structured
        sent[structured] = server.seen[0].body
    assert sent["json_schema"]["response_format"]["json_schema"]["name"] == "layer1"
    assert sent["tool"]["tool_choice"]["function"] == {"name": "layer1"}
    assert sent["guided_json"]["nvext"]["guided_json"]["type"] == "object"
    assert sent["json_object"]["response_format"] == {"type": "json_object"}
    assert '"verdict"' in sent["json_object"]["messages"][0]["content"]
    one = sent["json_schema"]
    assert one["max_tokens"] == 1200
    assert one["messages"][0]["role"] == "system"
    assert one["messages"][0]["content"].startswith("Be exact.")
    assert one["messages"][1]["content"][1]["image_url"]["url"].startswith("data:image/png;base64,")


def test_texts_alone_are_sent_as_text(server: WireServer) -> None:
    server.answers = [Answer(body=SERVICES[1].good)]
    SERVICES[1].backend(server.url).ask(request("Plain?"))
    assert server.seen[0].body["messages"][1]["content"] == "Plain?"


def test_usage_of_failed_tries_is_counted(server: WireServer) -> None:
    server.answers = [Answer(body=anthropic_message({"verdict": "?"}))]
    reply = SERVICES[0].backend(server.url).ask(request())
    assert reply.state is State.INVALID
    assert reply.usage.output == 321
    assert json.loads(reply.raw) == {"verdict": "?"}
