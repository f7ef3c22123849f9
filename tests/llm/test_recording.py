"""Record, replay, batches: answers got once, here or elsewhere, serve again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.llm import ReplayBackend, ScriptedBackend, State, TokenUsage, make_backend
from aegis_ot.llm.backends.anthropic_api import AnthropicBackend
from aegis_ot.llm.backends.recording import RecordingBackend
from aegis_ot.llm.backends.service import RequestOptions
from aegis_ot_lab.batch import export_requests, import_answers
from tests.llm.samples import GOOD, PNG, request
from tests.llm.wire_server import Answer, WireServer, anthropic_message

KEY = "sk-ant-very-secret-0123456789"


def test_what_was_recorded_is_replayed(tmp_path: Path) -> None:
    asked = request("Look", PNG)
    script = ScriptedBackend([GOOD], TokenUsage(1, 2, 3, 4))
    first = RecordingBackend(script, tmp_path).ask(asked)
    again = ReplayBackend(tmp_path).ask(asked)
    assert again.state is State.ANSWERED
    assert again.value == first.value == GOOD
    assert again.usage == TokenUsage(1, 2, 3, 4)
    assert again.attempts == 0
    images = list((tmp_path / "images").iterdir())
    assert [path.read_bytes() for path in images] == [PNG.data]


def test_a_recording_of_a_service_holds_no_secret(tmp_path: Path, server: WireServer) -> None:
    server.answers = [Answer(body=anthropic_message(GOOD), headers={"x-secret": KEY})]
    live = AnthropicBackend("m", server.url, manner=RequestOptions(KEY, trust_env=False))
    RecordingBackend(live, tmp_path).ask(request())
    text = "".join(p.read_text() for p in tmp_path.rglob("*.json"))
    assert KEY not in text
    assert server.url not in text
    assert ReplayBackend(tmp_path).ask(request()).value == GOOD


def test_any_change_of_the_request_is_another_request(tmp_path: Path) -> None:
    RecordingBackend(ScriptedBackend([GOOD]), tmp_path).ask(request("Is it right?"))
    reply = ReplayBackend(tmp_path).ask(request("Is it right ?"))
    assert reply.state is State.NOT_RECORDED
    assert "no answer" in reply.detail


def test_outages_are_not_remembered_and_refusals_are(tmp_path: Path) -> None:
    script = ScriptedBackend([State.UNAVAILABLE, State.REFUSED])
    recorder = RecordingBackend(script, tmp_path)
    recorder.ask(request("a"))
    recorder.ask(request("b"))
    replay = ReplayBackend(tmp_path)
    assert replay.ask(request("a")).state is State.NOT_RECORDED
    assert replay.ask(request("b")).state is State.REFUSED


def test_answers_of_several_models_are_told_apart(tmp_path: Path, server: WireServer) -> None:
    for model in ("claude-a", "claude-b"):
        server.seen.clear()
        body = anthropic_message(GOOD) | {"model": model}
        server.answers = [Answer(body=body)]
        live = AnthropicBackend(model, server.url, manner=RequestOptions(KEY, trust_env=False))
        RecordingBackend(live, tmp_path).ask(request())
    unsure = ReplayBackend(tmp_path).ask(request())
    assert unsure.state is State.NOT_RECORDED
    assert "claude-a, claude-b" in unsure.detail
    named = make_backend(f"replay:{tmp_path}#model=claude-b").ask(request())
    assert (named.state, named.model) == (State.ANSWERED, "claude-b")


def test_a_damaged_recording_is_named(tmp_path: Path) -> None:
    (tmp_path / f"{request().hash}.json").write_text("{not json")
    reply = ReplayBackend(tmp_path).ask(request())
    assert reply.state is State.NOT_RECORDED
    assert request().hash in reply.detail


@pytest.mark.parametrize(
    "text",
    [
        "[]",
        "{}",
        '{"format": 2}',
        '{"format": 1, "answers": 3}',
        '{"format": 1, "answers": [3, null]}',
        "[" * 100_000,
        '{"format": 1, "answers": [{"model": 3, "answer": null, "seconds": NaN, "usage": []}]}',
        '{"format": 1, "answers": [{"answer": ' + "[" * 800 + "]" * 800 + "}]}",
    ],
)
def test_a_recording_of_any_other_form_is_no_answer(tmp_path: Path, text: str) -> None:
    (tmp_path / f"{request().hash}.json").write_text(text)
    reply = ReplayBackend(tmp_path).ask(request())
    assert reply.state in (State.NOT_RECORDED, State.INVALID)
    assert reply.detail


def test_a_damaged_recording_steps_aside_for_the_new_answer(tmp_path: Path) -> None:
    path = tmp_path / f"{request().hash}.json"
    path.write_bytes(b"\xed\xa0\x80")
    assert RecordingBackend(ScriptedBackend([GOOD]), tmp_path).ask(request()).answered
    assert ReplayBackend(tmp_path).ask(request()).value == GOOD
    assert path.with_suffix(".damaged").read_bytes() == b"\xed\xa0\x80", "nothing is lost"


def test_half_a_surrogate_pair_is_recorded_and_read_again(tmp_path: Path) -> None:
    said = [json.dumps(GOOD | {"verdict": "\ud800"}), '"\\ud800"', "\ud800"]
    for text in said:
        asked = request(repr(text))
        recorded = RecordingBackend(ScriptedBackend([text]), tmp_path).ask(asked)
        assert recorded.state is State.INVALID
        again = ReplayBackend(tmp_path).ask(asked)
        assert again.state is State.INVALID
        assert again.raw == text


def test_a_recorded_answer_is_checked_like_a_fresh_one(tmp_path: Path) -> None:
    RecordingBackend(ScriptedBackend([GOOD]), tmp_path).ask(request())
    path = tmp_path / f"{request().hash}.json"
    entry = json.loads(path.read_text())
    entry["answers"][0]["answer"] = {"verdict": "approved"}
    path.write_text(json.dumps(entry))
    assert ReplayBackend(tmp_path).ask(request()).state is State.INVALID


def test_no_folder_to_replay_from(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="--record"):
        ReplayBackend(tmp_path / "missing")


def test_a_batch_goes_out_and_comes_back(tmp_path: Path) -> None:
    out, folder = tmp_path / "requests.jsonl", tmp_path / "replay"
    asked = [("a.py", request("a\u2028b", PNG)), ("b.py", request("b")), ("c.py", request("b"))]
    assert export_requests(asked, out) == 2, "equal requests are one line"
    lines = [json.loads(line) for line in out.read_text().split("\n") if line]
    assert lines[0]["about"] == "a.py"
    image = lines[0]["messages"][0]["parts"][1]["image"]
    assert (tmp_path / "images" / f"{image['sha256']}.png").read_bytes() == PNG.data
    answers = tmp_path / "responses.jsonl"
    answers.write_text(
        "".join(
            json.dumps({"id": line["id"], "answer": GOOD, "model": "batch-model"}) + "\n"
            for line in lines
        )
    )
    done = import_answers(answers, folder, out)
    assert (done.kept, done.problems) == (2, ())
    reply = ReplayBackend(folder).ask(request("a\u2028b", PNG))
    assert reply.value == GOOD
    assert reply.model == "batch-model"


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "expected object"),
        ({"answer": GOOD}, "id is missing"),
        ({"id": "xyz", "answer": GOOD}, "not the id"),
        ({"id": "0" * 64, "answer": GOOD}, "no request"),
        ({"id": "REQUEST", "answer": 3}, "answer"),
        ({"id": "REQUEST", "answer": {"verdict": "maybe", "lines": []}}, "maybe"),
        ({"id": "../../../etc/passwd", "answer": GOOD}, "not the id"),
    ],
)
def test_bad_lines_are_reported_and_good_ones_kept(tmp_path: Path, line: Any, told: str) -> None:
    out, answers = tmp_path / "requests.jsonl", tmp_path / "responses.jsonl"
    export_requests([("a.py", request())], out)
    text = line if isinstance(line, str) else json.dumps(line).replace("REQUEST", request().hash)
    good = json.dumps({"id": request().hash, "answer": json.dumps(GOOD)})
    answers.write_text(f"{text}\n\n{good}\n")
    done = import_answers(answers, tmp_path / "replay", out)
    assert done.kept == 1
    assert len(done.problems) == 1
    assert "line 1" in done.problems[0]
    assert told in done.problems[0]
    assert ReplayBackend(tmp_path / "replay").ask(request()).answered


def test_files_of_windows_editors_are_read(tmp_path: Path) -> None:
    out, answers = tmp_path / "requests.jsonl", tmp_path / "responses.jsonl"
    export_requests([("a.py", request())], out)
    for path, text in (
        (out, out.read_text()),
        (answers, json.dumps({"id": request().hash, "answer": GOOD}) + "\r\n"),
    ):
        path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert import_answers(answers, tmp_path / "replay", out).problems == ()


def test_an_import_keeps_what_was_there(tmp_path: Path) -> None:
    RecordingBackend(ScriptedBackend([GOOD]), tmp_path).ask(request())
    answers = tmp_path / "responses.jsonl"
    other = GOOD | {"verdict": "pass"}
    answers.write_text(json.dumps({"id": request().hash, "answer": other, "model": "person"}))
    import_answers(answers, tmp_path)
    assert make_backend(f"replay:{tmp_path}#model=scripted").ask(request()).value == GOOD
    assert make_backend(f"replay:{tmp_path}#model=person").ask(request()).value == other
