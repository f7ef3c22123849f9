"""A step that failed, and a robot server that is restarted, seen from terminal and page."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from opentrons.protocol_engine.error_recovery_policy import ErrorRecoveryType

from aegis_ot.cli import robot_screen
from aegis_ot.robot import RobotClient
from aegis_ot.robot.held_liquid import HeldLiquid
from aegis_ot.robot.keyframe_times import PastLink
from aegis_ot.robot.server_answers import Command as RobotCommand
from aegis_ot.robot.watching import watch_run
from aegis_ot.run_view.situation import situations

from ..cli.commands import Command
from ..sidecar.helpers import Robot
from ..support.robot_server import RobotServer
from .protocols import NEEDS_LIQUID, PAUSES
from .test_running import guarded, pressing, sidecar, written
from .test_watching import Shown, begin

__all__ = ["pressing"]


@pytest.fixture
def flex() -> Iterator[RobotServer]:
    with RobotServer(robot="Flex") as server:
        server.recover = lambda *_: ErrorRecoveryType.WAIT_FOR_RECOVERY
        yield server


def kinds(robot: RobotServer) -> list[tuple[str, str]]:
    (run,) = robot.runs.values()
    return [(c["commandType"], c["status"]) for c in run.commands(0, 100)["data"]]


def test_a_failed_step_is_named_and_r_goes_on_after_it(
    aegis: Command, flex: RobotServer, pressing: dict[str, str]
) -> None:
    pressing["Paused: A step failed"] = "r"
    done = aegis("run", written(NEEDS_LIQUID), "--robot", flex.url, "--yes")
    assert done.code == 0, done.out + done.err
    assert "A step failed (liquidProbe A1: " in done.out
    assert kinds(flex).count(("liquidProbe", "failed")) == 1
    (run,) = flex.runs.values()
    assert [one["actionType"] for one in run.actions] == ["play", "resume-from-recovery"]


def test_t_tries_the_step_again_and_says_where_it_fails_once_more(
    aegis: Command, flex: RobotServer, pressing: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import opentrons.hardware_control.ot3api as ot3

    levels: Iterator[float | None] = iter((None, None, 10.0))

    async def liquid_probe(_self: Any, *_: Any, **__: Any) -> float:
        level = next(levels)
        if level is None:
            raise ot3.PipetteLiquidNotFoundError("none")
        return level

    monkeypatch.setattr(ot3.OT3API, "liquid_probe", liquid_probe)
    pressing["Paused: A step failed"] = "t"

    def once_more(count: int = 0) -> None:
        while kinds(flex).count(("liquidProbe", "failed")) < 2:
            time.sleep(0.02)
        pressing["Paused: A step failed"] = "t"

    def wait_for_run() -> None:
        while not flex.runs:
            time.sleep(0.02)
        once_more()

    somebody = threading.Thread(target=wait_for_run)
    somebody.start()
    done = aegis("run", written(NEEDS_LIQUID), "--robot", flex.url, "--yes")
    somebody.join()
    assert done.code == 0, done.out + done.err
    assert done.out.count("Paused: A step failed") == 2
    probes = [status for kind, status in kinds(flex) if kind == "liquidProbe"]
    assert probes == ["failed", "failed", "succeeded"]


def test_a_failed_step_is_tried_again_from_the_page(
    flex: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown, titles = Shown(), []
    with RobotClient(flex.url) as client, sidecar(tmp_path) as url:
        run = begin(client, tmp_path, NEEDS_LIQUID)

        def answer() -> None:
            with Robot(url, f"watch-{run.id}") as page:
                for value in ("retry", "resume"):
                    until = time.monotonic() + 60
                    while time.monotonic() < until:
                        overview = page.overview()
                        known = "trajectories" in overview  # the run has reached the sidecar
                        found = [
                            one
                            for one in (situations(overview, 0.0) if known else ())
                            if one.title == "A step failed"
                        ]
                        if found and found[0].answers:
                            break
                        time.sleep(0.05)
                    titles.append(found[0].text)
                    answers = [(one.words, one.label) for one in found[0].answers]
                    assert answers[:2] == [
                        ("retry", "Try that step again"), ("resume", "Go on after it")
                    ]  # fmt: skip
                    form = {"answer": value, "by": "Ada", "note": ""}
                    path = f"/runs/watch-{run.id}/wells/{found[0].trajectory}"
                    httpx.post(url + path, data=form, headers={"Origin": url})

        somebody = threading.Thread(target=answer)
        somebody.start()
        watch_run(client, run, PastLink(url, None), shown, poll_s=0.05)
        somebody.join()
    assert run.status == "succeeded", shown.said
    assert len(titles) == 2
    assert titles[0].startswith("liquidProbe A1: ")
    assert kinds(flex).count(("liquidProbe", "failed")) == 2
    assert shown.waited.count("") >= 1


def test_a_restarted_server_is_told_with_what_the_tip_may_hold(
    aegis: Command, robot: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = PAUSES.replace("    protocol.pause", '    pipette.pick_up_tip()\n    '
        'pipette.aspirate(70, plate["C1"])\n    protocol.pause')  # fmt: skip

    waited = robot_screen.TerminalScreen.waits

    def waits(screen: robot_screen.TerminalScreen, text: str, recovery: bool = False) -> None:
        waited(screen, text, recovery)
        for run in robot.runs.values():
            run.lost = run.lost or bool(text)

    monkeypatch.setattr(robot_screen.TerminalScreen, "waits", waits)
    with sidecar(tmp_path) as url:
        done = aegis(
            "run", written(guarded(text, url)), "--robot", robot.url, "-y", "--sidecar", url
        )
        (row,) = httpx.get(f"{url}/v1/runs").json()["runs"]
        ended = httpx.get(f"{url}/v1/runs/{row['run']}").json()["finished"]
    assert done.code == 2, done.out + done.err
    told = (
        "The robot's server was restarted: this run is gone and cannot be resumed. The tip on the "
    )
    assert f"{told}left p300_single_gen2 may hold 70 µL from C1 of" in done.out
    assert ended["outcome"] == "failed"
    assert "The robot's server was restarted" in ended["detail"]


def test_a_watched_run_ends_with_its_server(robot: RobotServer, tmp_path: Path) -> None:
    shown = Shown()
    with RobotClient(robot.url) as client, sidecar(tmp_path) as url:
        run = begin(client, tmp_path)

        def restart() -> None:
            while not shown.verdicts:
                time.sleep(0.05)
            for one in robot.runs.values():
                one.lost = True

        somebody = threading.Thread(target=restart)
        somebody.start()
        watch_run(client, run, PastLink(url, None), shown, poll_s=0.05)
        somebody.join()
        with Robot(url, f"watch-{run.id}") as page:
            ended = page.overview()["finished"]
    assert run.status == "failed"
    assert "was restarted" in run.errors[0]
    assert ended["outcome"] == "failed"
    assert "was restarted" in ended["detail"]


def test_what_a_tip_may_hold() -> None:
    held = HeldLiquid()

    def step(kind: str, status: str = "succeeded", **params: Any) -> None:
        command = RobotCommand(0, kind, status, {"pipetteId": "p", **params})
        held.began(command)
        held.done(command)

    step("pickUpTip")
    assert held.told(None) == "The pipette has a tip on."
    step("aspirate", volume=50, wellName="A1", labwareId="x")
    step("dispense", volume=20)
    assert held.told(None) == "The tip on the pipette may hold 30 µL from A1."
    step("dispense", "failed", volume=30)
    assert "30 µL" in held.told(None)
    step("blowout")
    assert held.told(None) == "The pipette has a tip on."
    step("dropTip")
    assert held.told(None) == ""
