"""A robot that moves is paused or stopped from the sidecar's page, at its next exchange."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from aegis_ot.runtime import boundaries

from .fake_sidecar import FakeSidecar
from .live import LiveRun
from .test_live import in_time, settings, two_wells
from .test_page_answers import RobotServer, robot

__all__ = ["robot"]  # a fixture


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


def order(action: str, at: float = 1.0) -> dict[str, Any]:
    return {"action": action, "by": "Ada", "note": "", "at": at}


@pytest.mark.parametrize("api", ["2.15", "2.13"])
def test_a_pause_is_taken_up_once_and_tells_who_ordered_it(
    api: str, sidecar: FakeSidecar, robot: RobotServer
) -> None:
    sidecar.order = order("pause")
    run = robot.run = LiveRun(two_wells, settings(sidecar, watch_simulation=True), api).start()
    if api == "2.13":  # its hardware simulator makes it a simulation: told, not paused
        run.join()
        assert [(h["resolution"], h["policy"]) for h in sidecar.holds[:1]] == [
            ("operator", "pause")
        ]
        return
    run.wait_for_status("paused")
    assert len(sidecar.stored()) == 1
    pause = next(c for c in run.seen() if c.commandType == "waitForResume")
    assert "Ada paused the run" in pause.params.message
    sidecar.actions[0] = "resume"
    run.join()
    assert run.error is None
    ordered = [hold for hold in sidecar.holds if hold["resolution"] == "operator"]
    assert [hold.get("answered") for hold in ordered] == [None, "page"]
    assert [command.commandType for command in run.commands].count("waitForResume") == 1


def test_a_pause_is_taken_up_in_a_hold(sidecar: FakeSidecar, robot: RobotServer) -> None:
    sidecar.outcomes[0] = None
    run = robot.run = LiveRun(two_wells, settings(sidecar)).start()
    assert sidecar.asked.wait(60)
    sidecar.order = order("pause")
    run.wait_for_status("paused")
    sidecar.outcomes[0] = "pass"
    run.play()
    run.join()
    assert run.error is None
    first = [h for h in sidecar.holds if h["trajectory"] == 0]
    assert [(h["number"], h["resolution"]) for h in first] == [
        (0, "operator"), (0, "operator"), (1, "verdict"),
    ]  # fmt: skip


def test_a_stop_ends_the_run_as_the_robots_own_button_does(
    sidecar: FakeSidecar, robot: RobotServer
) -> None:
    sidecar.order = order("stop")
    run = robot.run = LiveRun(two_wells, settings(sidecar))
    run.start().join()
    assert run.error is not None
    assert robot.told == [("/runs/abc/actions", "stop")]
    assert [finish["outcome"] for finish in sidecar.finished] == ["stopped"]
    assert len(sidecar.stored()) == 1


def test_a_stop_that_the_robots_server_refuses_ends_the_run_by_an_error(
    sidecar: FakeSidecar, robot: RobotServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(boundaries, "_STOP_S", 0.1)
    robot.status = 409
    sidecar.order = order("stop")
    run = robot.run = LiveRun(two_wells, settings(sidecar))
    run.start().join()
    assert "Ada ended the run" in str(run.error)
    assert [finish["outcome"] for finish in sidecar.finished] == ["aborted"]
    in_time(lambda: len(robot.told) == 1)
