"""What the page shows in each state of a run, in a real browser: elements and texts, no pixels."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.analysis import Judged
from aegis_ot.vocabulary import ChannelOutcome, ChannelVerdict, FailureType, WellRef

from .browser import CHROMIUM, Browser, chromium
from .helpers import Robot, StubAnalyser, StubCamera, StubRun

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")

ROWS = "ABCDEFGH"
PLATE = {"labware": "p", "label": "plate", "slot": "4", "rows": 8, "columns": 12}
PLAN = {
    "plates": [PLATE],
    "planned": [{"labware": "p", "wells": [f"A{n}"]} for n in range(1, 13)],
    "planned_wells": 12,
}


class RowAnalyser(StubAnalyser):
    """Judges rows of eight tips: of the second one the third fails."""

    def begin(self, run: str, history: Any = ()) -> StubRun:
        return RowRun(self, run)


class RowRun(StubRun):
    def judge(self, trajectory: int) -> Judged:
        verdict, evidence = super().judge(trajectory)
        failure = FailureType.NO_DISPENSE if trajectory == 1 else None
        channels = tuple(
            ChannelVerdict(
                f"{letter}1",
                WellRef("p", f"{letter}{trajectory + 1}", "plate", "4"),
                ChannelOutcome.FAIL if (trajectory, letter) == (1, "C") else ChannelOutcome.PASS,
                FailureType.NO_DISPENSE if (trajectory, letter) == (1, "C") else None,
            )
            for letter in ROWS
        )
        return replace(verdict, channels=channels, failure=failure), evidence


@pytest.fixture
def tab() -> Iterator[Browser]:
    with chromium((1440, 900)) as tab:
        yield tab
        assert tab.errors == []


@pytest.fixture
def analyser() -> StubAnalyser:
    return StubAnalyser(fails=[1, 3])


@pytest.fixture
def robot(config: SidecarConfig, analyser: StubAnalyser, tab: Browser) -> Iterator[Robot]:
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        begin(robot)
        tab.open(url)
        yield robot
        tab.open("about:blank")


def begin(robot: Robot, **more: Any) -> None:
    guard = {"on_fail": "pause", "on_undecided": "pause", "verdict_timeout_s": 60}
    about = {"run": robot.run, "protocol": "live.py", "title": "ELISA", "guard": guard, **PLAN}
    assert robot.http.put(f"/v1/runs/{robot.run}", json=about | more).status_code == 200


def deliver(robot: Robot, *trajectories: int, **changes: Any) -> None:
    for trajectory in trajectories:
        for sequence in range(4 * trajectory, 4 * trajectory + 4):
            assert robot.send(sequence, **changes).status_code == 200
        robot.verdict(trajectory)


def pause(robot: Robot, trajectory: int, **more: Any) -> None:
    hold = {"number": trajectory, "trajectory": trajectory, "seconds": 0.2}
    hold |= {"resolution": "verdict", "policy": "pause", "next": "the tip is dropped"}
    assert robot.post("hold", hold | more).status_code == 200


def text(tab: Browser, selector: str) -> str:
    return str(tab.run(f"document.querySelector({selector!r})?.textContent.trim() ?? ''"))


def shows(tab: Browser, selector: str, words: str) -> None:
    tab.until(f"document.querySelector({selector!r}).textContent.includes({words!r})")


def answer(tab: Browser, words: str) -> None:
    tab.run("document.querySelector('.ask input[name=by]').value = 'Ada'")
    tab.run(f"document.querySelector('.ask button[value=\"{words}\"]').click()")


def test_the_page_shows_the_well_that_is_asked_about_and_follows_the_next_run(
    robot: Robot, tab: Browser
) -> None:
    deliver(robot, 0, 1)
    pause(robot, 1)
    shows(tab, "#headline", "A2 failed")
    answer(tab, "fail resume")
    shows(tab, "#headline", "Ada answered: continue")
    assert tab.run("location.pathname + location.search") == "/"
    pause(robot, 1, paused_s=3.0, answered="page")
    deliver(robot, 2, 3)
    pause(robot, 3)
    shows(tab, "#headline", "A4 failed")
    shows(tab, "#well h2", "A4")
    # Who has chosen another well sees the one that is asked about next.
    tab.run("document.querySelector('a.cell.pass').click()")
    shows(tab, "#well h2", "A1")
    shows(tab, "#follow", "Back to A4")
    pause(robot, 3, paused_s=3.0, answered="robot")
    shows(tab, "#state", "Running")
    shows(tab, "#well h2", "A1")
    deliver(robot, 4)
    robot.post("finish", {"outcome": "succeeded"})
    other = Robot(str(robot.http.base_url), "run-2")
    begin(other, title="PCR")
    shows(tab, "#strip .name", "PCR")
    deliver(other, 0, 1)
    pause(other, 1)
    shows(tab, "#headline", "A2 failed")
    shows(tab, "#well h2", "A2")
    other.http.close()


@pytest.mark.parametrize("analyser", [RowAnalyser(fails=[1])])
def test_an_eight_channel_failure_names_its_well_and_wells_are_counted(
    robot: Robot, tab: Browser
) -> None:
    for number in (0, 1):
        wells = tuple(WellRef("p", f"{letter}{number + 1}", "plate", "4") for letter in ROWS)
        nozzles = tuple(f"{letter}1" for letter in ROWS)
        rows = {"channels": 8, "nozzles": nozzles, "targets": wells, "destinations": wells}
        deliver(robot, number, **rows)
    pause(robot, 1)
    shows(tab, "#headline", "C2 failed: no dispense")
    shows(tab, ".ask.paused h2", "C2 failed")
    shows(tab, "#well h2", "C2")
    assert text(tab, "#wells") == "16"
    assert "15 passed" in text(tab, "#plates .key")
    assert "1 failed" in text(tab, "#plates .key")
    assert tab.run("[...document.querySelectorAll('a.cell.fail')].map((a) => a.title)") == [
        "C2: failed, no dispense"
    ]
    told = robot.http.get("/runs/run-1/report.json").json()["counts"]
    assert told == {"pass": 15, "fail": 1, "wells": 16, "deliveries": 2}
    (row,) = robot.http.get("/v1/runs").json()["runs"]
    assert (row["wells"], row["deliveries"]) == ({"pass": 15, "fail": 1}, 2), "counted alike"
    assert "15 passed, 1 failed" in " ".join(
        re.sub(r"<[^>]+>", "", robot.http.get("/runs").text).split()
    )


def test_the_line_and_the_plate_stay_where_they_are_and_say_how_it_stands(
    robot: Robot, tab: Browser
) -> None:
    place = (
        "['#strip', '#plates .plate'].map((one) => document.querySelector(one)"
        ".getBoundingClientRect()).map((one) => [one.top, one.height])"
    )
    deliver(robot, 0)
    shows(tab, "#wells", "1")
    assert text(tab, "#state") == "Running"
    assert text(tab, "#strip .name") == "ELISA"
    assert "1 of 12 wells done" in text(tab, "#strip .line")
    assert tab.run("document.querySelectorAll('.cell').length") == 96 + 1  # and one in the key
    before = tab.run(place)
    deliver(robot, 1)
    pause(robot, 1)
    shows(tab, "#state", "Paused")
    shows(tab, "#strip .line", "paused for")
    assert tab.run("document.getElementById('say').getAttribute('aria-live')") == "assertive"
    assert tab.run(place) == before
    pause(robot, 1, paused_s=3.0, answered="robot")
    shows(tab, "#state", "Running")
    deliver(robot, 2)
    shows(tab, "#wells", "3")
    shows(tab, "#well h2", "last flagged: A2")
    assert tab.run("document.getElementById('say').getAttribute('aria-live')") == "polite"
    robot.post("finish", {"outcome": "succeeded"})
    shows(tab, "#state", "Ended: 1 well failed")
    assert tab.run(place) == before
    robot_history = robot.http.get("/runs").text
    assert "ended, 1 failed" in robot_history
    assert 'class="badge succeeded"' not in robot_history


def test_a_usual_wait_for_a_verdict_is_calm(
    robot: Robot, tab: Browser, analyser: StubAnalyser
) -> None:
    deliver(robot, 0)
    analyser.gate.clear()
    for sequence in range(4, 8):
        robot.send(sequence)
    robot.verdict(1, wait=0.1)
    tab.until("document.querySelector('a.cell.waiting')")
    assert text(tab, "#state") == "Running"
    assert tab.run("document.querySelector('.ask')") is None
    tab.run("document.querySelector('a.cell.waiting').click()")
    shows(tab, "#well h2", "A2")
    assert "being read" in text(tab, "#well")
    assert "not judged" not in text(tab, "#well")
    analyser.gate.set()
    shows(tab, "#state", "Running")
    tab.until("document.querySelectorAll('a.cell.fail').length === 1")


def test_the_buttons_say_what_they_cause_and_are_gone_once_answered(
    robot: Robot, tab: Browser
) -> None:
    deliver(robot, 0, 1)
    pause(robot, 1)
    shows(tab, ".ask.paused", "A2 stays marked as failed; the tip is dropped, then A3 is filled")
    assert "10 wells stay without their liquid" in text(tab, ".ask.paused")
    answer(tab, "pass resume")
    shows(tab, ".ask.answered", "Ada answered: continue")
    assert tab.run("document.querySelectorAll('.ask button').length") == 0
    assert tab.run("document.querySelectorAll('#stop button').length") == 1, "a stop is one always"


def test_both_frames_are_shown_large_and_looked_through_by_key(robot: Robot, tab: Browser) -> None:
    deliver(robot, 0, 1, 2, 3)
    pause(robot, 3)
    shows(tab, "#well h2", "A4")
    captions = "[...document.querySelectorAll('#well .two figcaption')].map((f) => f.textContent)"
    assert tab.run(captions) == ["Before, above the well", "After, above the well"]
    assert "partial dispense" in text(tab, "#well h2")
    assert tab.run("document.getElementById('numbers').open") is False
    assert "so it was checked a second time" in text(tab, "#numbers")
    assert "grey" not in text(tab, "#numbers")
    press = "document.dispatchEvent(new KeyboardEvent('keydown', {key: '%s', bubbles: true}))"
    press = press.replace("document.dispatch", "document.body.dispatch")
    tab.run(press % "p")
    shows(tab, "#well h2", "A2")
    tab.run(press % "n")
    shows(tab, "#well h2", "A4")
    for key, name in (("z", "zoomed"), ("o", "plain")):
        tab.run(press % key)
        tab.until(f"document.body.classList.contains('{name}')")
    assert tab.run("getComputedStyle(document.querySelector('.marks')).display") == "none"


CALLS = """
Object.defineProperty(navigator, 'serviceWorker', {value: undefined});
window.heard = [];
window.Notification = function (title, more) { heard.push(title + " | " + more.body); };
Notification.permission = "granted";
Notification.requestPermission = async () => "granted";
window.AudioContext = class {
  currentTime = 0; destination = {};
  createGain() { return { gain: {}, connect: (next) => next }; }
  createOscillator() { heard.push("sound"); return { frequency: {}, connect: (next) => next,
    start() {}, stop() {} }; }
};
"""


def test_a_pause_calls_the_person_once_with_sound_and_notification(
    robot: Robot, tab: Browser
) -> None:
    tab.call("Page.addScriptToEvaluateOnNewDocument", source=CALLS)
    tab.open(str(robot.http.base_url))
    tab.until("document.readyState === 'complete' && window.heard")
    tab.run("document.getElementById('tell').click()")
    shows(tab, "#tell-said", "This browser calls you")
    tab.run("heard.length = 0")
    deliver(robot, 0, 1)
    pause(robot, 1)
    tab.until("heard.some((one) => one.includes('A2 failed'))")
    deliver(robot, 2)
    assert [one for one in tab.run("heard") if one != "sound"] == [
        "Paused: A2 failed: partial dispense | ELISA"
    ]
    assert "sound" in tab.run("heard")
    tab.run("location.reload()")
    tab.until("document.readyState === 'complete' && document.getElementById('tell')")
    tab.until("document.getElementById('tell').getAttribute('aria-pressed') === 'true'")


def test_the_page_can_be_installed_and_shows_what_the_camera_sees(
    robot: Robot, tab: Browser
) -> None:
    deliver(robot, 0)
    tab.until("document.getElementById('now-picture')?.naturalWidth > 0")
    manifest = robot.http.get("/static/manifest.webmanifest").json()
    assert manifest["display"] == "standalone"
    assert robot.http.get(manifest["icons"][0]["src"]).status_code == 200
    tab.until("navigator.serviceWorker.controller || navigator.serviceWorker.ready")
    why_not = tab.call("Page.getInstallabilityErrors")["installabilityErrors"]
    assert {one["errorId"] for one in why_not} <= {"in-incognito"}  # as the tab of a test is
