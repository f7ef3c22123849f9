"""The page, in a real browser where there is one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import SecretStr

from aegis_ot.errors import CameraError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.config import BoundCameraSettings, CameraSettings, OperatorSettings

from .browser import CHROMIUM, Browser, chromium
from .helpers import Robot, StubAnalyser, StubCamera

EVIL = "<img src=x onerror=\"document.title='owned'\">.py"
SIZES = {"tablet": (1180, 820), "phone": (390, 844)}
in_browser = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")


def test_the_page_loads_nothing_from_elsewhere_and_runs_no_inline_script(robot: Robot) -> None:
    robot.cycle(0)
    for path in ("/", "/runs", "/runs/run-1", "/camera", "/login"):
        page = robot.http.get(path)
        assert page.status_code == 200, path
        assert "default-src 'none'" in page.headers["content-security-policy"]
        assert not re.search(r"<script(?![^>]*src=)|\son\w+=|\sstyle=", page.text), path
        assert not re.search(r"(src|href|action)=\"(https?:)?//", page.text), path
    for part in ("page.css", "parts.css", "page.js", "manifest.webmanifest"):
        text = robot.http.get(f"/static/{part}").text
        assert "http://" not in text
        assert "https://" not in text
        assert "innerHTML" not in text
    assert robot.http.get("/static/run.html").status_code == 404


def test_history_is_searched_and_reports_are_downloaded(robot: Robot) -> None:
    robot.cycle(0)
    robot.cycle(1)
    robot.verdict(1)
    robot.http.put("/v1/runs/other", json={"run": "other", "protocol": "pcr.py"})
    assert "pcr.py" in robot.http.get("/runs").text
    found = robot.http.get("/runs", params={"q": "DEMO running"}).text
    assert "demo.py" in found
    assert "pcr.py" not in found
    assert "1 failed" in found
    assert "No run is like that." in robot.http.get("/runs", params={"q": "%' OR 1"}).text
    report = robot.http.get("/runs/run-1/report.html")
    assert "attachment" in report.headers["content-disposition"]
    assert "52 µL stayed" in report.text
    account = robot.http.get("/runs/run-1/report.json").json()
    assert (account["format"], account["counts"]["fail"]) == ("aegis-ot run report", 1)
    assert robot.http.get("/runs/nobody/report.html").status_code == 404


def test_a_person_answers_without_a_script_and_is_remembered(robot: Robot) -> None:
    for trajectory in (0, 1):
        robot.cycle(trajectory)
        robot.verdict(trajectory)
    form = {"by": "Ada Lovelace", "note": "a drop", "answer": "pass resume"}
    answer = robot.http.post("/runs/run-1/wells/1", data=form)
    assert (answer.status_code, answer.headers["location"]) == (303, "/runs/run-1")
    trajectory = robot.overview()["trajectories"][1]
    assert [(d["by"], d["note"]) for d in trajectory["decisions"]] == [("Ada Lovelace", "a drop")]
    told = robot.http.get("/v1/runs/run-1/trajectories/1/action").json()["action"]
    assert (told["action"], told["by"]) == ("resume", "Ada Lovelace")
    assert 'value="Ada Lovelace"' in robot.http.get("/").text
    # A well that passed by itself can be corrected too.
    robot.http.post("/runs/run-1/wells/0", data=form | {"answer": "fail"})
    assert robot.verdict(0)["verdict"]["outcome"] == "fail"
    nobody = robot.http.post("/runs/run-1/wells/1", data=form | {"by": " "})
    assert nobody.status_code == 422
    assert "Write your name" in nobody.text
    nowhere = robot.http.post("/runs/run-1/wells/9", data=form)
    assert nowhere.status_code == 404
    assert "This run has no delivery 9." in nowhere.text


@pytest.fixture
def tab() -> Iterator[Browser]:
    with chromium(SIZES["tablet"]) as tab:
        yield tab


@pytest.fixture
def stage(config: SidecarConfig) -> Iterator[tuple[str, Robot, StubCamera]]:
    camera = StubCamera()
    patient = config.model_copy(update={"operator": OperatorSettings(timeout_s=90)})
    analyser = StubAnalyser(fails=[1], unsure=[2])
    with running_sidecar(patient, camera, analyser) as url, Robot(url) as robot:
        yield url, robot, camera


def register(robot: Robot, **more: Any) -> None:
    guard = {"on_fail": "pause", "on_undecided": "pause", "verdict_timeout_s": 60}
    about = {"run": "run-1", "protocol": "demo.py", "robot_name": "lab-3", "guard": guard}
    assert robot.http.put("/v1/runs/run-1", json=about | more).status_code == 200


def pause(robot: Robot, trajectory: int) -> None:
    hold = {"number": trajectory, "trajectory": trajectory, "seconds": 0.2}
    robot.post("hold", hold | {"resolution": "verdict", "policy": "pause"})


@in_browser
def test_it_opens_on_the_live_run_follows_it_and_resumes_the_robot(
    stage: tuple[str, Robot, StubCamera], tab: Browser
) -> None:
    url, robot, _ = stage
    tab.open(url)
    tab.until("document.querySelector('h1').textContent === 'No run yet'")
    register(robot, protocol=EVIL)
    tab.until("document.querySelector('#strip .name').textContent.startsWith('<img')")
    robot.cycle(0)
    robot.verdict(0)
    tab.until("document.querySelector('a.cell.pass')")
    robot.cycle(1)
    robot.verdict(1)
    pause(robot, 1)
    tab.until("document.querySelector('.ask.paused')")
    said = tab.run("document.querySelector('.ask.paused').textContent")
    assert "partial dispense" in said
    assert "52 µL stayed" in said
    # The well that asks is the one whose frames show.
    tab.until("document.querySelectorAll('#well svg image').length >= 1")
    assert "A2" in tab.run("document.querySelector('#well h2').textContent")
    tab.run("document.querySelector('.ask input[name=by]').focus()")
    tab.call("Input.insertText", text="Ada")
    robot.cycle(2)  # what is typed survives news
    tab.until("document.querySelector('.ask.question')")
    assert tab.run("document.querySelector('.ask input[name=by]').value") == "Ada"
    assert tab.run("document.title") != "owned"
    assert tab.errors == []


@in_browser
def test_a_paused_robot_is_answered_from_the_banner(
    stage: tuple[str, Robot, StubCamera], tab: Browser
) -> None:
    url, robot, _ = stage
    register(robot)
    for trajectory in (0, 1):
        robot.cycle(trajectory)
        robot.verdict(trajectory)
    pause(robot, 1)
    tab.open(url)
    tab.until("document.querySelector('.ask.paused button')")
    tab.run("document.querySelector('.ask input[name=by]').value = 'Ada'")
    tab.run("document.querySelector('.ask button[value=\"pass resume\"]').click()")
    tab.until("document.body.textContent.includes('Ada answered: continue')")
    assert robot.verdict(1)["verdict"]["outcome"] == "pass"
    robot.post("hold", {"number": 1, "trajectory": 1, "seconds": 0.2, "resolution": "verdict",
                        "policy": "pause", "paused_s": 4.0, "answered": "page"})  # fmt: skip
    tab.until("!document.querySelector('.ask.paused')")
    tab.until("document.querySelector('a.cell.decided')")
    assert tab.errors == []


@in_browser
def test_a_question_counts_down_and_trouble_of_the_camera_shows(
    stage: tuple[str, Robot, StubCamera], tab: Browser
) -> None:
    url, robot, camera = stage
    register(robot)
    for trajectory in (0, 1, 2):
        robot.cycle(trajectory)
    robot.verdict(2, wait=0.5)
    camera.failure = CameraError("the cable is out")
    robot.send(12)
    tab.open(url)
    tab.until("document.querySelector('.ask.question') && document.querySelector('.ask.camera')")
    left = "Number.parseInt(document.querySelector('[data-left]').textContent.replace(':', ''))"
    before = tab.run("document.querySelector('[data-left]').textContent")
    tab.until(f"document.querySelector('[data-left]').textContent !== {before!r} && {left} > 0")
    assert "the robot pauses" in tab.run("document.querySelector('.ask.question').textContent")
    camera.failure = None
    robot.send(12)
    tab.until("document.querySelector('.ask.camera') === null")


@in_browser
@pytest.mark.parametrize("size", SIZES)
def test_it_fits_the_screen_and_can_be_used_by_keyboard(
    size: str, stage: tuple[str, Robot, StubCamera], tab: Browser
) -> None:
    url, robot, _ = stage
    width, height = SIZES[size]
    tab.call(
        "Emulation.setDeviceMetricsOverride",
        width=width, height=height, deviceScaleFactor=1, mobile=size == "phone",
    )  # fmt: skip
    register(robot)
    for trajectory in range(12):
        robot.cycle(trajectory)
    robot.verdict(11)
    pause(robot, 1)
    for path in ("/", "/runs", "/camera"):
        tab.open(url + path)
        tab.until("document.readyState === 'complete' && document.querySelector('h1, #strip')")
        assert tab.run("document.documentElement.scrollWidth") <= width, path
    tab.open(url)
    tab.until("document.readyState === 'complete' && document.querySelector('a.cell')")
    # The banner stays in view, whatever is looked at.
    tab.run("window.scrollTo(0, document.body.scrollHeight)")
    tab.until("document.getElementById('strip').getBoundingClientRect().top <= 1")
    small = tab.run(
        "[...document.querySelectorAll('button, .cell[href], nav a')].filter((one) => {"
        " const box = one.getBoundingClientRect();"
        " return box.width && (box.width < 23.5 || box.height < 23.5); })"
        ".map((one) => one.outerHTML.slice(0, 60) + one.getBoundingClientRect().width)"
    )
    assert small == []
    unnamed = tab.run(
        "[...document.querySelectorAll('a, button, input:not([type=hidden])')].filter((one) => "
        "!(one.textContent.trim() || one.getAttribute('aria-label') || one.closest('label') "
        "|| document.querySelector(`label[for='${one.id}']`))).length"
    )
    assert unnamed == 0
    tab.run("document.querySelectorAll('a.cell')[3].focus()")
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter",
             windowsVirtualKeyCode=13, text="\r")  # fmt: skip
    tab.until("location.search.endsWith('well=3')")
    tab.until(
        "document.querySelector('a.cell[aria-current]')?.getAttribute('aria-label')[1] === '4'"
    )
    assert tab.errors == []


@in_browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stands_out_from_its_ground(
    scheme: str, stage: tuple[str, Robot, StubCamera], tab: Browser
) -> None:
    url, robot, _ = stage
    tab.call("Emulation.setEmulatedMedia",
             features=[{"name": "prefers-color-scheme", "value": scheme}])  # fmt: skip
    register(robot)
    for trajectory in (0, 1, 2):
        robot.cycle(trajectory)
    robot.verdict(2, wait=0.2)
    pause(robot, 1)
    tab.open(url)
    tab.until("document.querySelector('.ask.paused') && document.querySelector('a.cell.fail')")
    weak = tab.run(
        """(() => {
          const rgb = (text) => text.match(/[\\d.]+/g).map(Number);
          const light = (c) => { const [r, g, b] = c.slice(0, 3).map((v) => { v /= 255;
            return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
            return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
          const ground = (node) => { for (let one = node; one; one = one.parentElement) {
            const c = rgb(getComputedStyle(one).backgroundColor);
            if (c.length < 4 || c[3] === 1) return c; } return [255, 255, 255]; };
          const found = [];
          for (const node of document.querySelectorAll("body *")) {
            const own = [...node.childNodes].some((c) => c.nodeType === 3 && c.data.trim());
            if (!own || node.closest("svg, script, .skip")) continue;
            if (!node.getClientRects().length) continue;
            const a = light(rgb(getComputedStyle(node).color)), b = light(ground(node));
            const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
            if (ratio < 4.5) found.push(node.className + " " + node.textContent.trim().slice(0, 30)
              + " " + ratio.toFixed(2));
          }
          return found;
        })()"""
    )
    assert weak == []


@in_browser
def test_a_person_logs_in_by_the_form(tmp_path: Path, tab: Browser) -> None:
    token = "a-token-of-the-lab-0123"
    config = SidecarConfig(port=0, data=tmp_path / "data", token=SecretStr(token))
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
        tab.open(url)
        tab.until("document.querySelector('#token')")
        tab.run("document.querySelector('#token').value = 'wrong'")
        tab.run("document.querySelector('form').submit()")
        tab.until("document.body.textContent.includes('not the sidecar')")
        tab.run(f"document.querySelector('#token').value = {token!r}")
        tab.run("document.querySelector('form').submit()")
        tab.until("document.querySelector('h1')?.textContent === 'No run yet'")


@in_browser
def test_the_camera_is_aimed_before_the_first_run(tmp_path: Path, tab: Browser) -> None:
    config = SidecarConfig(port=0, data=tmp_path / "data", camera=CameraSettings(spec="pattern"))
    with running_sidecar(config) as url:
        tab.open(url + "/camera")
        tab.until("document.getElementById('picture').getAttribute('href')?.startsWith('data:')")
        tab.until("document.getElementById('aim-size').textContent === '640 × 480 px'")
        assert "No tip is found" in tab.run("document.getElementById('aim-said').textContent")
        first = tab.run("document.getElementById('picture').getAttribute('href')")
        tab.until(f"document.getElementById('picture').getAttribute('href') !== {first!r}")
        assert tab.errors == []


@in_browser
def test_each_of_several_cameras_can_be_aimed(tmp_path: Path, tab: Browser) -> None:
    cameras = tuple(BoundCameraSettings(spec="pattern", mount=mount) for mount in ("left", "right"))
    config = SidecarConfig(port=0, data=tmp_path / "data", cameras=cameras)
    with running_sidecar(config) as url:
        tab.open(url + "/camera")
        tab.until("document.querySelectorAll('nav[aria-label=Cameras] a').length === 2")
        tab.run("document.querySelectorAll('nav[aria-label=Cameras] a')[1].click()")
        tab.until("location.search === '?number=1'")
        tab.until("document.getElementById('picture').getAttribute('href')?.startsWith('data:')")
        assert tab.errors == []
