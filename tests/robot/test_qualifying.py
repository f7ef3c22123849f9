"""``aegis-ot qualify --robot`` against Opentrons' engine and a real sidecar."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest
from fastapi import Request

from aegis_ot.qualification.plan import make_plan
from aegis_ot.sidecar import SidecarConfig, running_sidecar

from ..cli.commands import Command
from ..sidecar.helpers import StubAnalyser, StubCamera
from ..support.robot_server import RobotServer

PLANNED = make_plan("p300_single_gen2", "right", ["dye"], 15, 3)
FAULTS = [number for number, each in enumerate(PLANNED.deliveries) if each.fault]


def test_a_robot_is_qualified_blind(
    aegis: Command, robot: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It fails as planned, is not paused by that, and every verdict meets what was planted."""
    data = tmp_path / "sidecar"
    config = SidecarConfig(port=0, data=data)
    with running_sidecar(config, StubCamera(), StubAnalyser(FAULTS[1:])) as url:
        # This machine knows the sidecar; whether the robot does, nobody can see.
        monkeypatch.setenv("AEGIS_OT_SIDECAR", url)
        done = aegis(
            "qualify", "--robot", robot.url, "--pipette", "right", "--liquid", "dye",
            "--minutes", 15, "--seed", 3, "--yes", "--data", data,
            "--out", "qualified",
        )  # fmt: skip
    assert done.code == 0, done.out + done.err
    made = json.loads(Path("qualified/certificate.json").read_text(encoding="utf-8"))
    (dye,) = made["liquids"]
    assert (made["outcome"], made["delivered"]) == ("succeeded", 24)
    assert (dye["caught"]["hits"], dye["caught"]["of"]) == (len(FAULTS) - 1, len(FAULTS))
    assert dye["normals_flagged"]["hits"] == 0
    assert f"sidecar='{url}'" in Path("qualified/qualification.py").read_text(encoding="utf-8")


def _store(folder: Path) -> Path:
    with running_sidecar(SidecarConfig(port=0, data=folder), StubCamera(), StubAnalyser()):
        return folder


def test_a_start_that_is_declined_opens_nothing(
    aegis: Command, robot: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answers = io.StringIO("n\n")
    monkeypatch.setattr(answers, "isatty", lambda: True)
    monkeypatch.setattr("sys.stdin", answers)
    with running_sidecar(SidecarConfig(port=0, data=tmp_path), StubCamera(), StubAnalyser()) as url:
        done = aegis(
            "qualify", "--robot", robot.url, "--pipette", "right", "--minutes", 15,
            "--sidecar", url, "--data", tmp_path, "--out", "q",
        )  # fmt: skip
    assert done.code == 1
    assert "It was not run" in done.out
    assert not any(Path("q").iterdir())
    assert not robot.runs


def test_a_refused_analysis_opens_nothing(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    done = aegis(
        "qualify", "--robot", robot.url, "--pipette", "right", "--yes", "--tips", "no_such_rack",
        "--sidecar", "http://127.0.0.1:9", "--data", _store(tmp_path), "--out", "q",
    )  # fmt: skip
    assert done.code == 1
    assert "the robot's analysis failed" in done.out
    assert "It was not run" in done.out


def test_a_run_that_is_left_says_how_to_open_what_was_done(
    aegis: Command, robot: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C leaves it to the App."""

    def leave(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("aegis_ot.robot.running.follow", leave)
    with running_sidecar(SidecarConfig(port=0, data=tmp_path), StubCamera(), StubAnalyser()) as url:
        done = aegis(
            "qualify", "--robot", robot.url, "--pipette", "right", "--minutes", 15, "--yes",
            "--sidecar", url, "--data", tmp_path, "--out", "q",
        )  # fmt: skip
    assert done.code == 1
    assert "Left to the App" in done.out
    assert "--out q-opened" in done.out.replace("\n", " ")


def test_a_run_that_is_stopped_says_how_to_open_what_was_done(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    def stop_it(request: Request) -> None:
        if request.method == "GET" and request.url.path.endswith("/commands") and robot.current:
            robot.runs[robot.current].stop_soon()

    robot.fault = stop_it
    with running_sidecar(SidecarConfig(port=0, data=tmp_path), StubCamera(), StubAnalyser()) as url:
        done = aegis(
            "qualify", "--robot", robot.url, "--pipette", "right", "--minutes", 15, "--yes",
            "--sidecar", url, "--data", tmp_path, "--out", "q",
        )  # fmt: skip
    assert done.code == 1
    assert f"--of {Path('q/qualification.py')} --out q-opened" in done.out.replace("\n", " ")
    assert not Path("q/certificate.json").exists()


def test_what_would_fail_after_the_run_is_refused_before_it(
    aegis: Command, robot: RobotServer, tmp_path: Path
) -> None:
    Path("old.json").write_text('{"format": "aegis-ot qualification"}', encoding="utf-8")
    asked = (
        "qualify", "--robot", robot.url, "--pipette", "right", "--yes",
        "--sidecar", "http://127.0.0.1:9",
    )  # fmt: skip
    done = aegis(*asked, "--data", _store(tmp_path / "data"), "--previous", "old.json")
    assert done.code == 2
    assert "no certificate of this version" in done.err
    done = aegis(*asked, "--data", tmp_path / "nowhere")
    assert done.code == 2
    assert "name the data folder of a sidecar" in done.err
    assert not robot.protocols


def test_nothing_is_run_unwatched(aegis: Command, robot: RobotServer) -> None:
    done = aegis("qualify", "--robot", robot.url, "--pipette", "right", "--out", "q")
    assert done.code == 2
    assert "Nobody would watch it" in done.err
    assert not Path("q").exists()


def test_a_mount_without_a_pipette_is_told(aegis: Command, robot: RobotServer) -> None:
    done = aegis("qualify", "--robot", robot.url, "--pipette", "left")
    assert done.code == 2
    assert "has no pipette on its left mount" in done.err
