"""``aegis-ot run`` against Opentrons' engine, a guarded protocol and a real sidecar."""

from __future__ import annotations

import json
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from opentrons_shared_data.labware import load_definition

from aegis_ot.cli import robot_screen
from aegis_ot.robot import Command as RobotCommand
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.vocabulary import FailureType

from ..cli.commands import Command
from ..sidecar.helpers import StubAnalyser, StubCamera
from ..support.robot_server import RobotServer
from .protocols import BAD, GOOD, PAUSES, WAITS, WITH_INPUTS


@contextmanager
def sidecar(folder: Path, *fails: int) -> Iterator[str]:
    config = SidecarConfig(port=0, data=folder / "sidecar")
    with running_sidecar(config, StubCamera(), StubAnalyser(fails)) as url:
        yield url


@pytest.fixture
def pressing(monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Keys that the person presses once a text is shown, by that text."""
    presses: dict[str, str] = {}
    waiting: list[str] = []
    shown = robot_screen.TerminalScreen._print

    def print_and_press(screen: object, text: str, style: str = "") -> None:
        shown(screen, text, style)  # type: ignore[arg-type]
        for word in list(presses):
            if word in text:
                waiting.append(presses.pop(word))

    monkeypatch.setattr(robot_screen.TerminalScreen, "_print", print_and_press)
    monkeypatch.setattr(
        robot_screen.Keys, "pressed", lambda self: waiting.pop(0) if waiting else ""
    )
    return presses


def written(text: str, name: str = "protocol.py") -> Path:
    path = Path(name)
    path.write_text(text, encoding="utf-8")
    return path


def guarded(text: str, url: str) -> str:
    head, _, rest = text.partition("def run")
    return f"{head}from aegis_ot import guard\n@guard(sidecar={url!r})\ndef run{rest}"


def test_a_good_protocol_runs_and_is_reported(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    with sidecar(tmp_path) as url:
        done = aegis(
            "run", written(guarded(GOOD, url)), "--robot", robot.url, "--yes",
            "--sidecar", url, "--report", "out/run.json",
        )  # fmt: skip
    assert done.code == 0, done.out + done.err
    assert "Layer 1: pass" in done.out
    assert "succeeded" in done.out
    assert "2 deliveries: 2 pass" in done.out
    report = json.loads(Path("out/run.json").read_text(encoding="utf-8"))
    assert (report["status"], report["pauses"], report["errors"]) == ("succeeded", [], [])
    assert [v["outcome"] for v in report["verdicts"]] == ["pass", "pass"]
    assert report["sidecar"]["counts"]["wells"] == 2


def test_a_run_that_is_not_as_rehearsed_is_no_clean_one(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    live = "plate.wells()[8:10][:: 1 if protocol.is_simulating() else -1]"
    text = GOOD.replace("plate.wells()[8:10]", live)
    with sidecar(tmp_path) as url:
        done = aegis(
            "run", written(guarded(text, url)), "--robot", robot.url, "--yes", "--sidecar", url
        )
    assert done.code == 1, done.out + done.err
    assert "2 deliveries: 2 pass" in done.out
    assert "was not as rehearsed" in done.out


def test_a_failed_well_is_told_and_the_person_resumes(
    aegis: Command, robot: RobotServer, tmp_path: Path, pressing: dict[str, str]
) -> None:
    pressing["Paused: "] = "r"
    with sidecar(tmp_path, 0) as url:
        done = aegis(
            "run", written(guarded(GOOD, url)), "--robot", robot.url, "-y", "--sidecar", url
        )
    assert done.code == 1, done.out + done.err
    assert "A2 of Corning 96 Well Plate 360 µL Flat (slot 2): fail (partial dispense)" in done.out
    assert "Delivery into A2" in done.out.split("Paused: ")[1]
    assert "succeeded" in done.out
    assert "1 pause" in done.out


def test_a_well_that_the_robot_put_right_asks_for_nobody(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    analyser = StubAnalyser([0])
    analyser.failure = FailureType.NO_DISPENSE
    config = SidecarConfig(port=0, data=tmp_path / "sidecar")
    with running_sidecar(config, StubCamera(), analyser) as url:
        text = guarded(GOOD, url).replace("@guard(", '@guard(recover={"no_dispense": "retry"}, ')
        done = aegis(
            "run", written(text), "--robot", robot.url, "-y",
            "--sidecar", url, "--report", "out/run.json",
        )  # fmt: skip
    assert done.code == 0, done.out + done.err
    assert "A2 of Corning 96 Well Plate 360 µL Flat (slot 2): put right by the robot" in done.out
    assert "3 deliveries: 2 pass, 1 put right" in done.out
    report = json.loads(Path("out/run.json").read_text(encoding="utf-8"))
    assert [v["state"] for v in report["verdicts"]] == ["recovered", "pass", "pass"]


def test_the_person_stops_the_run(
    aegis: Command, robot: RobotServer, pressing: dict[str, str]
) -> None:
    pressing["Paused: Take the lid off."] = "s"
    done = aegis("run", written(PAUSES), "--robot", robot.url, "--yes")
    assert done.code == 1, done.out + done.err
    assert "stopped" in done.out
    assert " failed: " not in done.out


def test_the_person_pauses_and_resumes(
    aegis: Command, robot: RobotServer, pressing: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pressing["hello"] = "p"
    pressing["Paused: The run is paused."] = "s"
    shown = robot_screen.TerminalScreen.doing
    monkeypatch.setattr(
        robot_screen.TerminalScreen,
        "doing",
        lambda screen, command: (
            shown(screen, command),
            command.kind == "waitForDuration" and screen._print("hello"),
        ),
    )
    done = aegis("run", written(WAITS), "--robot", robot.url, "--yes")
    assert done.code == 1, done.out + done.err
    assert "Paused: The run is paused." in done.out
    assert "stopped" in done.out


def test_ctrl_c_pauses_and_a_second_one_leaves_the_run_paused(
    aegis: Command, robot: RobotServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = robot_screen.TerminalScreen.doing
    waited = robot_screen.TerminalScreen.waits

    def doing(screen: robot_screen.TerminalScreen, command: RobotCommand) -> None:
        shown(screen, command)
        if command.kind == "waitForDuration" and not screen._interrupted:
            signal.raise_signal(signal.SIGINT)

    def waits(screen: robot_screen.TerminalScreen, text: str, recovery: bool = False) -> None:
        waited(screen, text, recovery)
        if text:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(robot_screen.TerminalScreen, "doing", doing)
    monkeypatch.setattr(robot_screen.TerminalScreen, "waits", waits)
    done = aegis("run", written(WAITS), "--robot", robot.url, "--yes")
    assert done.code == 130, done.out + done.err
    assert "Left to the App" in done.out
    (run,) = robot.runs.values()
    assert run.status == "paused"


def test_a_protocol_that_fails_its_analysis_does_not_start(
    aegis: Command, robot: RobotServer
) -> None:
    done = aegis("run", written(BAD), "--robot", robot.url, "--yes")
    assert done.code == 1
    assert "ValueError [line 5]: no such thing" in done.out
    assert robot.runs == {}


def test_layer_1_refuses_a_guarded_protocol_in_the_robots_analysis(
    aegis: Command, robot: RobotServer
) -> None:
    bad = Path(__file__).parents[2] / "examples" / "demo" / "pcr_setup_contaminated.py"
    done = aegis("run", written(bad.read_text(encoding="utf-8")), "--robot", robot.url, "--yes")
    assert done.code == 1, done.out
    assert "Layer 1 found" in done.out
    assert robot.runs == {}


def test_labware_and_parameters_of_its_own_go_with_it(aegis: Command, robot: RobotServer) -> None:
    definition = load_definition("corning_96_wellplate_360ul_flat", 2)
    definition["parameters"]["loadName"] = "my_plate"
    definition["namespace"] = "my_lab"
    Path("labware").mkdir()
    Path("labware/my_plate.json").write_text(json.dumps(definition), encoding="utf-8")
    done = aegis(
        "run", written(WITH_INPUTS), "--robot", robot.url, "--yes",
        "--labware", "labware", "--parameter", "wells=3",
    )  # fmt: skip
    assert done.code == 0, done.out + done.err
    (run,) = robot.runs.values()
    kinds = [command["commandType"] for command in run.commands(0, 100)["data"]]
    assert kinds.count("aspirate") == 3


def test_a_package_that_the_robot_lacks_is_named_with_what_to_do(
    aegis: Command, robot: RobotServer
) -> None:
    text = GOOD.replace("    tips =", "    from aegis_ot.nothing import there\n    tips =")
    done = aegis("run", written(text), "--robot", robot.url, "--yes")
    assert done.code == 1
    assert "aegis-ot is not on this robot" in done.out
    assert "aegis-ot wrap protocol.py" in done.out


def test_without_a_person_to_ask_the_run_needs_a_yes(aegis: Command, robot: RobotServer) -> None:
    done = aegis("run", written(GOOD), "--robot", robot.url)
    assert done.code == 2
    assert "Add --yes" in done.err
    assert robot.runs == {}


def test_a_robot_that_is_not_there_is_one_sentence(aegis: Command) -> None:
    done = aegis("run", written(GOOD), "--robot", "127.0.0.1:9", "--yes")
    assert done.code == 2
    assert "cannot be reached" in done.err
    assert "Traceback" not in done.err


def test_a_sidecar_that_is_not_there_keeps_the_run_from_starting(
    aegis: Command, robot: RobotServer
) -> None:
    done = aegis(
        "run", written(GOOD), "--robot", robot.url, "-y", "--sidecar", "http://127.0.0.1:9"
    )
    assert done.code == 2
    assert "sidecar" in done.err
    assert robot.runs == {}
