"""The page, in a real browser where there is one."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar

from .browser import CHROMIUM, chromium
from .helpers import Robot, StubAnalyser, StubCamera

EVIL = "<img src=x onerror=\"document.title='owned'\">.py"


def test_the_page_loads_nothing_from_elsewhere_and_runs_no_inline_script(robot: Robot) -> None:
    page = robot.http.get("/")
    assert page.status_code == 200
    assert "default-src 'none'" in page.headers["content-security-policy"]
    for part in (page, robot.http.get("/static/page.css"), robot.http.get("/static/page.js")):
        assert part.status_code == 200
        text = part.text.replace("http://www.w3.org/2000/svg", "")
        assert "http://" not in text
        assert "https://" not in text
        assert "innerHTML" not in text
    assert robot.http.get("/static/index.html").status_code == 404


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")
def test_an_operator_sees_the_frames_and_decides(config: SidecarConfig, tmp_path: Path) -> None:
    with (
        running_sidecar(config, StubCamera(), StubAnalyser(fails=[1])) as url,
        Robot(url) as robot,
        chromium(tmp_path / "profile") as tab,
    ):
        robot.http.put("/v1/runs/run-1", json={"run": "run-1", "protocol": EVIL})
        robot.cycle(0)
        robot.verdict(0)
        tab.open(f"{url}/?run=run-1")
        tab.until("document.querySelector('#run td .pass')")
        assert tab.run("document.querySelector('#run h2').textContent").startswith("<img")
        # The page is told of the next well without being loaded again.
        robot.cycle(1)
        robot.verdict(1)
        tab.until("document.querySelectorAll('#run tbody tr').length === 2")
        tab.run("document.querySelectorAll('#run tbody tr')[1].click()")
        tab.until("document.querySelector('#well .fail')")
        assert "52 µL stayed" in tab.run("document.querySelector('#well').textContent")
        tab.until(
            "[...document.querySelectorAll('#well img')].filter((i) => i.naturalWidth).length === 4"
            " && document.querySelector('#well svg rect')"
        )
        tab.run("document.querySelector('.decide input').value = 'Ada'")
        tab.run("document.querySelector('.decide button.pass').click()")
        tab.until("document.querySelector('#well').textContent.includes('Ada decided pass')")
        assert robot.verdict(1)["verdict"]["outcome"] == "pass"
        assert tab.run("document.title") == "aegis-ot sidecar"
        assert tab.errors == []
