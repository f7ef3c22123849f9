"""The sidecar looks back at a run that has ended, once its verdicts are in, and shows it."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.audit.result import Audit, Suspect
from aegis_ot.errors import StoreError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.auditing import Audits
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.wire import RunStart
from aegis_ot.vocabulary import Outcome, Route, Verdict

from .helpers import Robot, StubAnalyser, StubCamera


class StubAuditor:
    """Suspects the first delivery."""

    def __init__(self) -> None:
        self.runs: list[str] = []
        self.failure: Exception | None = None
        self.asked = threading.Event()
        self.stopped = False

    def audit(self, run: str) -> dict[str, Any]:
        self.runs.append(run)
        self.asked.set()
        if self.failure is not None:
            raise self.failure
        why = ("About <2.4> µL may have stayed.",)
        suspect = Suspect("well", (0,), ("A1 of plate (slot 4)",), 9.0, why, True, 0)
        return Audit(run, 1.0, "simulated", 1, 0, 1, [suspect]).to_json()

    def stop(self) -> None:
        self.stopped = True


@pytest.fixture
def auditor() -> StubAuditor:
    return StubAuditor()


@pytest.fixture
def robot(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, auditor: StubAuditor
) -> Iterator[Robot]:
    with running_sidecar(config, camera, analyser, auditor=auditor) as url, Robot(url) as robot:
        assert robot.register().status_code == 200
        yield robot
    assert auditor.stopped


def wait_for_audit(robot: Robot) -> dict[str, Any]:
    version = 0
    for _ in range(50):
        overview = robot.overview()
        if overview["audit"] is not None:
            return overview["audit"]
        version = robot.http.get(
            "/v1/news", params={"after": overview["version"], "wait": 5}
        ).json()["version"]
    raise AssertionError(f"no audit after {version} news")


def test_an_ended_run_is_audited_after_its_verdicts_and_shown(
    robot: Robot, analyser: StubAnalyser, auditor: StubAuditor
) -> None:
    analyser.gate.clear()
    robot.cycle(0)
    assert robot.http.get("/runs/run-1/audit.html").status_code == 404
    assert robot.post("finish", {"outcome": "succeeded"}).status_code == 200
    assert not auditor.asked.wait(0.2), "a verdict is still to come"
    analyser.gate.set()
    assert robot.verdict(0)["verdict"]["outcome"] == "pass"
    assert wait_for_audit(robot)["suspects"][0]["trajectories"] == [0]

    page = robot.http.get("/runs/run-1").text
    assert "The look back" in page
    assert "About &lt;2.4&gt; µL may have stayed." in page
    report = robot.http.get("/runs/run-1/report.html").text
    assert "About &lt;2.4&gt; µL may have stayed." in report
    assert robot.http.get("/runs/run-1/report.json").json()["audit"]["silent"] == 1
    audit = robot.http.get("/runs/run-1/audit.html")
    assert "attachment" in audit.headers["content-disposition"]
    assert "data:image/jpeg" in audit.text
    assert robot.http.get("/runs/run-1/audit.json").json()["run"] == "run-1"


def test_trouble_of_an_audit_is_logged_and_the_next_run_has_its_own(
    robot: Robot, auditor: StubAuditor, caplog: pytest.LogCaptureFixture
) -> None:
    auditor.failure = StoreError("the frames are gone")
    robot.cycle(0)
    robot.verdict(0)
    robot.post("finish", {"outcome": "succeeded"})
    assert auditor.asked.wait(60)
    auditor.failure = None
    robot.post("finish", {"outcome": "succeeded"})
    wait_for_audit(robot)
    assert auditor.runs == ["run-1", "run-1"]
    assert "Run run-1 was not audited: the frames are gone" in caplog.text


def test_a_run_whose_verdicts_never_come_keeps_no_other_waiting(
    auditor: StubAuditor, tmp_path: Path
) -> None:
    store, done = Store(tmp_path), threading.Event()
    for run in ("stuck", "second"):
        store.register(RunStart(run=run, protocol="a.py", robot="OT-2", simulated=True))
        store.add_verdict(Verdict(run, 0, Outcome.PASS, Route.SILENT_PASS, 1.0), {})
    audits = Audits(auditor, store, lambda run: run == "second", done.set)
    for run in ("stuck", "second"):
        audits.add(run)
    assert done.wait(60)
    assert auditor.runs == ["second"]
    audits.close()
    assert store.audit("stuck") is None


def test_a_run_without_a_verdict_is_not_audited_and_none_is_if_switched_off(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, auditor: StubAuditor
) -> None:
    off = config.model_copy(update={"audit": False})
    with running_sidecar(off, camera, analyser, auditor=auditor) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        robot.verdict(0)
        robot.post("finish", {"outcome": "succeeded"})
    with running_sidecar(config, camera, analyser, auditor=auditor) as url:
        with Robot(url, "empty") as robot:
            robot.register()
            robot.post("finish", {"outcome": "succeeded"})
        with Robot(url, "full") as robot:
            robot.register()
            robot.cycle(0)
            robot.verdict(0)
            robot.post("finish", {"outcome": "succeeded"})
            wait_for_audit(robot)
    assert auditor.runs == ["full"]
