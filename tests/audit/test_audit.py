"""The look back at a real store: what it ranks first, why, and what it makes of gaps."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from aegis_ot.audit import audit_run
from aegis_ot.audit.models import world_model
from aegis_ot.audit.process import AuditProcess
from aegis_ot.errors import ConfigurationError, StoreError
from aegis_ot.progress import Progress
from aegis_ot.reports.audit_html import audit_html
from aegis_ot.sidecar import SidecarConfig, make_detector
from aegis_ot.sidecar.overview import run_overview
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.wire import Decision, HoldReport
from aegis_ot.vision.gates import GateDecision, GateInput
from aegis_ot.vision.gates.case import Cost
from aegis_ot.vocabulary import FailureType, Gate, KeyframeKind, Outcome
from tests.audit.conftest import STRUCK, pass_silently
from tests.cli.commands import Command
from tests.sidecar.browser import CHROMIUM, chromium
from tests.worldmodel.stores import make_store


class Model:
    """A vision model that fails the well it is told to, until its budget is spent."""

    gate = Gate.VLM
    screens = False

    def __init__(self, fails: str, calls: int) -> None:
        self.fails, self.calls = fails, calls
        self.seen: list[str] = []

    def examine(self, case: GateInput) -> GateDecision:
        if len(self.seen) == self.calls:
            return GateDecision(Outcome.UNDECIDED, self.gate, "spent")
        self.seen.append(case.sample.well)
        assert case.sample.frames[KeyframeKind.TRANSIT].ndim == 3
        assert case.normal is not None
        cost = (Cost("stub", 1, 900, 80, 0.01),)
        if case.sample.well == self.fails:
            return GateDecision(
                Outcome.FAIL, self.gate, "A column.", FailureType.NO_DISPENSE, costs=cost
            )
        return GateDecision(Outcome.PASS, self.gate, "Empty.", costs=cost)


class Stages(Progress):
    def __init__(self) -> None:
        self.done: dict[str, list[int]] = {}
        """Steps of each stage: how many there are, and how many were done."""

    def begin(self, what: str, total: int) -> None:
        self.done[what] = [total, 0]

    def step(self) -> None:
        list(self.done.values())[-1][1] += 1


def test_a_fault_among_the_first_wells_stands_first_and_says_why(passed: Path) -> None:
    store, stages = Store(passed), Stages()
    audit = audit_run(store, "run-1", make_detector(), world_model(), progress=stages)
    assert stages.done == {"Reading tips": [8, 8], "Comparing wells": [8, 8]}
    first, *others = audit.suspects
    assert (first.kind, first.trajectories, first.stands_out) == ("well", (STRUCK,), True)
    assert "µL" in first.why[0]
    assert first.score > 2 * others[0].score
    assert (audit.wells, audit.left_out, audit.silent) == (8, 0, 8)
    assert audit.frames == "simulated"
    told = json.loads(json.dumps(audit.to_json()))
    assert [one["rank"] for one in told["suspects"]] == [*range(1, len(audit.suspects) + 1)]

    page = audit_html(run_overview(store, "run-1"), told, lambda n: store.frame("run-1", n))
    assert "simulated" in page
    assert "C1 of plate" in page
    assert page.count("data:image/jpeg") >= 8
    assert "http" not in page


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
def test_the_page_fits_a_phone_and_the_plate_leads_to_its_wells(
    passed: Path, tmp_path: Path
) -> None:
    store = Store(passed)
    told = audit_run(store, "run-1", make_detector(), world_model()).to_json()
    page = tmp_path / "page.html"
    text = audit_html(run_overview(store, "run-1"), told, lambda n: store.frame("run-1", n))
    page.write_text(text, encoding="utf-8")
    with chromium((390, 844)) as browser:
        browser.open(page.as_uri())
        browser.until("document.querySelectorAll('article').length === 5")
        assert browser.run("document.querySelector('a.cell[href=\"#w2\"]').textContent") == "1"
        assert browser.run("document.querySelector('#w2').closest('article') !== null")
        assert browser.run("document.documentElement.scrollWidth <= innerWidth")
        assert browser.errors == []


def test_a_well_that_a_person_decided_is_no_silent_pass(copied: Callable[[], Store]) -> None:
    store = copied()
    store.add_decision("run-1", STRUCK, Decision(outcome=Outcome.FAIL, by="Ada"))
    (first := sorted(store.frame_path("run-1", 0).parent.glob("*.jpg"))[0]).unlink()
    assert not first.exists()
    audit = audit_run(store, "run-1", make_detector(), world_model())
    assert (audit.wells, audit.left_out, audit.silent) == (7, 1, 6)
    assert not any(STRUCK in one.trajectories for one in audit.suspects)
    assert not any(one.kind == "well" and one.stands_out for one in audit.suspects)
    near = next(one for one in audit.suspects if one.trajectories == (STRUCK + 1,))
    assert any("C1, served just before it from the same source, failed" in w for w in near.why)


@pytest.mark.parametrize("answer", ["none", "decided", "resumed"])
def test_what_a_person_found_right_is_listed_and_alarms_nobody(answer: str, tmp_path: Path) -> None:
    store = Store(make_store(tmp_path / "empty", ("no_aspirate",) * 8))
    for trajectory in range(8):
        pass_silently(store, trajectory)
    if answer == "decided":
        store.add_decision("run-1", 0, Decision(outcome=Outcome.PASS, by="Ada"))
    elif answer == "resumed":
        store._write(
            "UPDATE verdicts SET verdict = json_set(verdict, '$.outcome', 'undecided') "
            "WHERE trajectory = ?",
            (0,),
        )
        hold = HoldReport(
            number=0, trajectory=0, seconds=0.1, resolution="verdict", policy="pause",
            paused_s=9.0, answered="robot",
        )  # fmt: skip
        store.add_hold("run-1", hold)
    audit = audit_run(store, "run-1", make_detector(), world_model())
    first = audit.suspects[0]
    assert (first.kind, first.stands_out) == ("no_liquid", answer == "none")
    said = "may have been empty" if answer == "none" else "A person was asked about A1 and went on"
    assert said in first.why[-1]


def test_a_model_is_asked_in_order_and_within_its_budget(passed: Path) -> None:
    model = Model(fails="C1", calls=2)
    audit = audit_run(Store(passed), "run-1", make_detector(), world_model(), model)
    assert model.seen[0] == "C1"
    assert len(model.seen) == len(audit.costs) == 2
    assert audit.suspects[0].why[-1] == "A vision model fails it: A column."
    assert audit.suspects[0].model == {"outcome": "fail", "reason": "A column."}
    assert sum(one.model is not None for one in audit.suspects) == 2


def test_an_unknown_run_is_told(passed: Path) -> None:
    with pytest.raises(ConfigurationError, match="holds no run 'zebra'"):
        audit_run(Store(passed), "zebra", make_detector(), world_model())


def test_a_process_of_its_own_finds_the_same_and_can_be_stopped(passed: Path) -> None:
    process = AuditProcess(SidecarConfig(data=passed))
    found = process.audit("run-1")
    assert found["suspects"][0]["trajectories"] == [STRUCK]
    process.stop()
    with pytest.raises(StoreError, match="stopped"):
        process.audit("run-1")


def test_the_command_keeps_the_audit_and_writes_the_page(
    copied: Callable[[], Store], tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    store, aegis = copied(), Command(capfdbinary)
    page, told = tmp_path / "audit.html", tmp_path / "audit.json"
    done = aegis("audit", "--data", store.folder, "--out", page, "--json", told)
    assert done.code == 1
    assert "1. C1 of plate" in done.out
    assert "<article" in page.read_text(encoding="utf-8")
    kept = run_overview(store, "run-1")["audit"]
    assert kept == json.loads(told.read_text(encoding="utf-8"))
    assert "Name one with --model" in aegis("audit", "--data", store.folder, "--calls", 3).err
    store._write("UPDATE runs SET finished = NULL WHERE run = ?", ("run-1",))
    unfinished = aegis("audit", "run-1", "--data", store.folder)
    assert (unfinished.code, "has not ended yet" in unfinished.err) == (2, True)
