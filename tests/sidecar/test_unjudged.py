"""A delivery without a verdict is undecided once its run is over, wherever verdicts are counted."""

from __future__ import annotations

import json
from pathlib import Path

import httpx
import pytest

from aegis_ot.errors import LinkError
from aegis_ot.robot.verdicts import VerdictReader
from aegis_ot.run_view import run_account, state_of
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.overview import NO_VERDICT, run_overview, runs_overview
from aegis_ot.sidecar.store import Store

from ..cli.commands import Command
from .helpers import Robot, StubAnalyser, StubCamera, until
from .test_identity import guard_of


def end(robot: Robot) -> None:
    robot.post("finish", {"outcome": "succeeded", "detail": ""})


def states(robot: Robot) -> list[str]:
    return [state_of(entry) for entry in robot.overview()["trajectories"]]


def test_it_waits_while_the_sidecar_works(robot: Robot, analyser: StubAnalyser) -> None:
    robot.cycle(0)
    assert robot.verdict(0)["verdict"]["outcome"] == "pass"
    analyser.gate.clear()
    robot.cycle(1)
    end(robot)
    assert states(robot) == ["pass", "waiting"]
    analyser.gate.set()
    assert robot.verdict(1)["verdict"]["outcome"] == "fail"
    assert states(robot) == ["pass", "fail"]


def test_everywhere_it_is_undecided_and_a_person_may_decide(
    robot: Robot, config: SidecarConfig, url: str
) -> None:
    robot.cycle(0)
    assert robot.verdict(0)["verdict"]["outcome"] == "pass"
    for sequence in (4, 5, 6):  # the link was lost before the fourth
        robot.send(sequence)
    assert states(robot) == ["pass", "running"]
    end(robot)
    until(lambda: states(robot) == ["pass", "undecided"])  # its three moments are looked at first
    account = run_account(robot.overview())
    assert account["counts"] == {"pass": 1, "undecided": 1, "wells": 2, "deliveries": 2}
    assert (account["flagged"], account["wells"][1]["reason"]) == ([1], NO_VERDICT)
    assert "1 undecided" in httpx.get(f"{url}/runs", trust_env=False).text
    reader = VerdictReader(url, None, run=robot.run)
    assert [known.state for known in reader.news()] == ["pass", "undecided"]
    reader.close()
    decided = robot.post("trajectories/1/decision", {"outcome": "pass", "by": "Ada", "note": ""})
    assert decided.status_code == 200, decided.text
    assert states(robot) == ["pass", "pass"]


def test_a_sidecar_that_was_killed_leaves_it_undecided_in_its_store(
    config: SidecarConfig, capfdbinary: pytest.CaptureFixture[bytes], tmp_path: Path
) -> None:
    analyser = StubAnalyser()
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        robot.register()
        analyser.gate.clear()
        robot.cycle(0)
        end(robot)
    analyser.gate.set()
    store = Store(config.data)
    (row,) = runs_overview(store)
    assert row["wells"] == {"undecided": 1}
    assert run_account(run_overview(store, "run-1"))["counts"] == {
        "undecided": 1,
        "wells": 1,
        "deliveries": 1,
    }
    store.close()
    told = Command(capfdbinary)("runs", "list", "--data", config.data, "--json")
    assert json.loads(told.out)[0]["wells"] == {"undecided": 1}
    assert NO_VERDICT in Command(capfdbinary)("runs", "show", "--data", config.data).out


class TestWhoseRun:
    """Robots of one sidecar that run the same protocol at once: nobody reads another's verdicts."""

    @staticmethod
    def reader(url: str, robot: str) -> VerdictReader:
        return VerdictReader(url, None, "demo.py", robot=robot)

    def test_of_several_runs_it_is_that_of_the_robots_name(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            ada, eve = self.reader(url, "ada"), self.reader(url, "eve")
            for name in ("ada", "eve"):
                guard_of(url, name[0] * 32, f"of-{name}", robot_name=name).register(2.0)
            assert [r.overview()["run"] for r in (ada, eve)] == ["of-ada", "of-eve"]  # type: ignore[index]

    def test_one_that_was_there_first_is_given_back(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            eve = self.reader(url, "eve")
            guard_of(url, "a" * 32, "of-ada", robot_name="ada").register(2.0)
            eve.news()
            guard_of(url, "e" * 32, "of-eve", robot_name="eve").register(2.0)
            eve.news()
            assert eve.run == "of-eve"

    def test_what_cannot_be_told_apart_is_said(self, config: SidecarConfig) -> None:
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
            other = self.reader(url, "OT2CEP")
            guard_of(url, "a" * 32, "of-ada", robot_name="ada").register(2.0)
            assert other.overview() is not None  # the only one: it may call itself otherwise
            guard_of(url, "e" * 32, "of-eve", robot_name="eve").register(2.0)
            with pytest.raises(LinkError, match="whose verdicts are whose cannot be told"):
                other.news()
