"""A dry run that a person follows on the page: it stands still until it is answered there."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any

import httpx
import pytest

from aegis_ot.dryrun import (
    DryRun,
    DryRunProgress,
    DryRunSettings,
    dry_run,
    read_script,
    watched_page,
)
from aegis_ot.run_view import RunView, run_view
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe
from tests.sidecar.helpers import StubAnalyser, StubRun

HELLO = Path(__file__).resolve().parents[2] / "examples" / "demo" / "hello_guard.py"


class SecondFails(StubAnalyser):
    """Looks at no frame: of the deliveries the second one fails."""

    def begin(self, run: str, history: Any = ()) -> StubRun:
        return Unseen(self, run)


class Unseen(StubRun):
    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        pass


class Person(DryRunProgress):
    """Answers the first pause, and looks at the page once more at the end."""

    def __init__(self, answer: str) -> None:
        self.answer = answer
        self.paused: RunView | None = None
        self.last: RunView | None = None

    def serves(self, address: str) -> None:
        self.http = httpx.Client(base_url=address, trust_env=False, timeout=60)
        threading.Thread(target=self._watch, daemon=True).start()

    def ended(self) -> None:
        self.last = self._view()
        self.layer1 = self.http.get("/v1/runs/dry-run-0").json()["layer1"]

    def _view(self) -> RunView:
        return run_view(self.http.get("/v1/runs/dry-run-0").json(), time.time())

    def _watch(self) -> None:
        version = 0
        while self.paused is None:
            answer = self.http.get("/v1/runs", params={"after": version, "wait": 15}).json()
            version = answer["version"]
            view = self._view() if answer["runs"] else None
            if view is not None and view.state == "paused":
                self.paused = view
        form = {"by": "Ada", "answer": self.answer}
        self.http.post(f"/runs/dry-run-0/wells/{self.paused.asks[0].trajectory}", data=form)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody looks on: no stroke takes its time."""
    monkeypatch.setattr(watched_page, "_STEP_S", {})


def run(answer: str) -> tuple[Person, DryRun]:
    person = Person(answer)
    settings = DryRunSettings(live=True)
    return person, dry_run(read_script(HELLO), settings, SecondFails(fails=[1]), person)


def test_the_run_waits_for_the_answer_and_goes_on() -> None:
    person, result = run("fail resume")
    assert person.paused is not None
    assert person.paused.headline.startswith("B1 failed")
    assert person.paused.wells_planned == 8
    assert (person.paused.name, result.outcome) == ("Hello, guard", "succeeded")
    cause = person.paused.asks[0].answers[0].causes
    assert cause == "B1 stays marked as failed; the tip is dropped, then C1 is filled"
    assert person.last is not None
    assert person.last.headline == "Ended: 1 well failed"
    assert person.last.counts["wells"] == 8
    assert person.layer1["verdict"] == "pass", "the live page says what Layer 1 said"


def test_the_run_ends_where_the_person_stops_it() -> None:
    person, result = run("stop")
    assert result.outcome == "stopped"
    assert result.detail == "Ada ended the run on the sidecar's page."
    assert result.touched_after_failure == ()
    assert person.last is not None
    assert person.last.counts["wells"] == 2
