"""Point 5 of issue 4: the guard asks a real sidecar, which asks the model once per digest."""

from __future__ import annotations

import io
import json
import textwrap
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from opentrons.simulate import simulate as opentrons_simulate

from aegis_ot.llm import (
    Backend,
    Opinions,
    Reply,
    Request,
    ScriptedBackend,
    State,
    make_backend,
)
from aegis_ot.llm.layer1_prompt import hybrid_request
from aegis_ot.model_opinion import ask_sidecar
from aegis_ot.sidecar import SidecarConfig, create_app
from aegis_ot.sidecar.config import CameraSettings
from aegis_ot.vocabulary import to_json
from aegis_ot_lab.batch import import_answers
from tests.llm.samples import CONTAMINATED, SILENT, answer, checked, finding, rule_set
from tests.llm.wire_server import Answer, WireServer
from tests.runtime.live import LiveRun

TOKEN = "robot-token"
VIOLATED = answer(findings=[finding("PCR-2", ["2:A2", "4:H12"], [11, 15])])


class Slow:
    """Answers when it is let."""

    name = "slow"

    def __init__(self) -> None:
        self.let = threading.Event()
        self.asked = 0

    def ask(self, request: Request) -> Reply:
        self.asked += 1
        self.let.wait(60)
        return Reply(State.ANSWERED, self.name, VIOLATED)


Serve = Callable[[Backend | None], str]


@pytest.fixture
def serve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Serve]:
    """Starts a sidecar with a model on a free port; returns its address."""
    import socket

    import uvicorn

    from aegis_ot.sidecar import app as app_module

    running: list[tuple[Any, threading.Thread, Any]] = []

    def start(backend: Backend | None) -> str:
        folder = tmp_path / f"data-{len(running)}"
        monkeypatch.setattr(
            app_module, "opinions_of", lambda _: Opinions(backend, folder / "opinions", rule_set())
        )
        config = SidecarConfig(data=folder, camera=CameraSettings(spec="pattern"), token=TOKEN)  # type: ignore[arg-type]
        app = create_app(config)
        listening = socket.socket()
        listening.bind(("127.0.0.1", 0))
        server = uvicorn.Server(uvicorn.Config(app, log_level="error", lifespan="on"))
        thread = threading.Thread(target=server.run, args=([listening],), daemon=True)
        thread.start()
        running.append((server, thread, listening))
        address = f"http://127.0.0.1:{listening.getsockname()[1]}"
        _until(lambda: server.started)
        return address

    yield start
    for server, thread, listening in running:
        server.should_exit = True
        thread.join(60)
        listening.close()


def _until(true: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60
    while not true():
        assert time.monotonic() < deadline, "it did not come about"
        time.sleep(0.01)


def test_a_model_is_asked_once_per_digest(serve: Serve) -> None:
    backend = ScriptedBackend(lambda _: VIOLATED)
    address = serve(backend)
    dossier = checked(SILENT)[1]
    first = ask_sidecar(address, TOKEN, dossier, 20)
    again = ask_sidecar(address, TOKEN, dossier, 20)
    assert first.answered
    assert [f.rule for f in first.findings] == ["PCR-2"]
    assert again == first
    assert len(backend.requests) == 1


def test_nobody_waits_longer_than_configured_and_the_answer_is_there_later(serve: Serve) -> None:
    backend = Slow()
    address = serve(backend)
    dossier = checked(SILENT)[1]
    early = ask_sidecar(address, TOKEN, dossier, 0.3)  # and the model has not answered yet
    assert early.state == "timeout"
    backend.let.set()
    late = ask_sidecar(address, TOKEN, dossier, 20)
    assert late.answered
    assert backend.asked == 1


@pytest.mark.parametrize(
    "answer",
    [Answer(drip=True), Answer(hang=True), Answer(body=b"[" * 100_000), Answer(body={"digest": 3})],
)
def test_a_sidecar_that_makes_no_sense_holds_nobody(server: WireServer, answer: Answer) -> None:
    server.answers = [answer]
    opinion = ask_sidecar(server.url, TOKEN, checked(SILENT)[1], 0.4)
    assert opinion.state in ("timeout", "invalid", "unavailable")
    assert opinion.detail


def test_outages_are_asked_about_again(serve: Serve) -> None:
    backend = ScriptedBackend([State.UNAVAILABLE, VIOLATED])
    address = serve(backend)
    dossier = checked(SILENT)[1]
    assert ask_sidecar(address, TOKEN, dossier, 20).state == "unavailable"
    assert ask_sidecar(address, TOKEN, dossier, 20).answered


def test_opinions_outlive_the_sidecar(tmp_path: Path) -> None:
    dossier = checked(SILENT)[1]
    first = Opinions(ScriptedBackend([VIOLATED]), tmp_path, rule_set())
    digest = first.ask(dossier)
    said = first.wait(digest, 20)
    silent = ScriptedBackend([])
    second = Opinions(silent, tmp_path, rule_set())
    assert second.wait(second.ask(dossier), 20) == said
    assert silent.requests == []
    (kept,) = tmp_path.glob(f"{digest}*.json")
    kept.write_text("{")
    third = Opinions(ScriptedBackend([VIOLATED]), tmp_path, rule_set())
    assert third.wait(third.ask(dossier), 20) == said


def test_another_model_is_asked_after_a_restart(tmp_path: Path) -> None:
    dossier = checked(SILENT)[1]

    def said_by(name: str, answer: Any) -> tuple[str, int]:
        backend = ScriptedBackend([answer])
        backend.name = name
        opinions = Opinions(backend, tmp_path, rule_set())
        opinion = opinions.wait(opinions.ask(dossier), 20)
        assert opinion is not None
        return opinion.state, len(backend.requests)

    assert said_by("openai:small", answer()) == ("answered", 1)
    assert said_by("openai:large", VIOLATED) == ("answered", 1)
    assert said_by("openai:small", answer()) == ("answered", 0)
    assert said_by("openai:odd", "no JSON") == ("invalid", 1)
    assert said_by("openai:odd", answer()) == ("answered", 1), "no answer is worth keeping"


def test_without_a_model_without_a_sidecar_with_a_wrong_token(serve: Serve) -> None:
    dossier = checked(SILENT)[1]
    address = serve(None)
    assert ask_sidecar(address, TOKEN, dossier, 5).state == "no_model"
    assert ask_sidecar(address, "wrong", dossier, 5).state == "unauthorized"
    assert ask_sidecar("http://127.0.0.1:9", TOKEN, dossier, 5).state == "unavailable"


def test_bad_bodies_are_refused(serve: Serve) -> None:
    address = serve(ScriptedBackend([]))
    with httpx.Client(
        base_url=address, headers={"Authorization": f"Bearer {TOKEN}"}, trust_env=False
    ) as client:
        assert client.post("/v1/opinions", content=b"{").status_code == 422
        assert client.post("/v1/opinions", json={"file": 3}).status_code == 422
        assert client.post("/v1/opinions", content=b"x" * (2 << 20)).status_code == 413
        assert client.get("/v1/opinions/" + "0" * 64).status_code == 404
        assert client.get("/v1/opinions/x?wait=nan").status_code == 422
        values = to_json(checked(SILENT)[1]) | {"source": 7}
        assert client.post("/v1/opinions", json=values).status_code == 422


def _guarded(text: str) -> str:
    return "from aegis_ot import guard\n" + textwrap.dedent(text).replace(
        "def run(protocol):", "@guard(opinion='ask', rules='strict')\ndef run(protocol):"
    )


GUARDED = _guarded(SILENT)


def _simulate(text: str) -> list[str]:
    """Run a guarded protocol in Opentrons' simulator, as an analysis does; what it commented."""
    log, _ = opentrons_simulate(io.StringIO(text), "protocol.py")
    return [entry["payload"]["text"] for entry in log if "aegis_ot" in entry["payload"]["text"]]


def test_the_guard_rejects_what_the_model_shows(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = answer(findings=[finding("PCR-2", ["2:A2", "4:H12"], [13, 17])])
    backend = ScriptedBackend(lambda _: lines)
    monkeypatch.setenv("AEGIS_OT_SIDECAR", serve(backend))
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    with pytest.raises(Exception, match="PCR-2"):
        _simulate(GUARDED)
    with pytest.raises(Exception, match="PCR-2"):
        _simulate(GUARDED)
    assert len(backend.requests) == 1


def test_a_live_run_takes_the_remembered_verdict(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = answer(findings=[finding("PCR-2", ["2:A2", "4:H12"], [13, 17])])
    backend = ScriptedBackend(lambda _: lines)
    monkeypatch.setenv("AEGIS_OT_SIDECAR", serve(backend))
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    with pytest.raises(Exception, match="PCR-2"):
        _simulate(_on_p300(GUARDED))
    live = _live(_on_p300(GUARDED))
    assert "PCR-2 (found by the model)" in live.told
    assert len(backend.requests) == 1, "the analysis had asked"
    assert not any(command.commandType == "pickUpTip" for command in live.commands)


def test_a_live_run_waits_for_nobody(serve: Serve, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the checks decided ends it, with the model still thinking."""
    backend = Slow()
    monkeypatch.setenv("AEGIS_OT_SIDECAR", serve(backend))
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    monkeypatch.setenv("AEGIS_OT_OPINION_TIMEOUT_S", "600")
    live = _live(_on_p300(_guarded(CONTAMINATED)))
    assert "PCR-2" in live.told
    assert backend.asked == 1
    assert not backend.let.is_set()


def _on_p300(text: str) -> str:
    """The pipette that the live run's hardware has."""
    return text.replace("tiprack_20ul", "tiprack_300ul").replace("p20_single", "p300_single")


def _live(text: str) -> LiveRun:
    live = LiveRun(text).start()
    live.play()
    return live.join(60)


def test_the_guard_is_served_by_imported_answers(
    serve: Serve, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What `aegis-ot llm export` wrote is what the robot's sidecar asks."""
    request = hybrid_request(checked(GUARDED)[1], rule_set())
    said = answer(findings=[finding("PCR-2", ["2:A2", "4:H12"], [13, 17])])
    (tmp_path / "a.jsonl").write_text(json.dumps({"id": request.hash, "answer": said}))
    import_answers(tmp_path / "a.jsonl", tmp_path / "kept")
    monkeypatch.setenv("AEGIS_OT_SIDECAR", serve(make_backend(f"replay:{tmp_path / 'kept'}")))
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    with pytest.raises(Exception, match=r"PCR-2 \(found by the model\)"):
        _simulate(GUARDED)


def test_the_guard_goes_on_without_the_model(serve: Serve, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_SIDECAR", "http://127.0.0.1:9")
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    said = _simulate(GUARDED)
    assert any("Layer 1: pass" in line and "8 undecided" in line for line in said)
    assert any("gave no answer (unavailable)" in line for line in said), "never a silent pass"


def test_analysis_and_rehearsal_make_the_same_dossier(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    backend = ScriptedBackend(lambda _: answer())
    address = serve(backend)
    monkeypatch.setenv("AEGIS_OT_SIDECAR", address)
    monkeypatch.setenv("AEGIS_OT_TOKEN", TOKEN)
    _simulate(GUARDED)
    assert len(backend.requests) == 1
    # A live run rehearses the text instead of running it.
    rehearsed = checked(GUARDED)[1]
    assert ask_sidecar(address, TOKEN, rehearsed, 20).answered
    assert len(backend.requests) == 1, "the live run finds what the analysis asked for"
