"""``aegis-ot fleet`` on one machine."""

from __future__ import annotations

import json

import pytest

from ..robot.protocols import GOOD
from ..support.robot_server import RobotServer

EMPTY = 'metadata = {"apiLevel": "2.15"}\ndef run(protocol):\n    pass\n'
FLEX = 'requirements = {"robotType": "Flex", "apiLevel": "2.16"}\ndef run(protocol):\n    pass\n'


@pytest.fixture
def robots(tmp_path):
    path = tmp_path / "fleet.toml"
    path.write_text('[[robot]]\nname = "a"\n[[robot]]\nname = "b"\n')
    return path


def test_a_clean_fleet(aegis, robots, tmp_path):
    protocol = tmp_path / "empty.py"
    protocol.write_text(EMPTY)
    done = aegis("fleet", "run", "--robots", robots, protocol, protocol)
    assert done.code == 0, done.out + done.err
    assert "2 of 2 protocols clean" in done.out
    assert "empty.py (2)" in done.out


def test_what_no_robot_can_run_is_told_and_reported(aegis, robots, tmp_path):
    flex, empty, report = tmp_path / "flex.py", tmp_path / "empty.py", tmp_path / "fleet.html"
    flex.write_text(FLEX)
    empty.write_text(EMPTY)
    done = aegis("fleet", "run", "--robots", robots, "--report", report, flex, empty)
    assert done.code == 2
    assert "flex.py: not run" in done.out
    told = json.loads(report.with_suffix(".json").read_text())
    assert [one["outcome"] for one in told["protocols"]] == ["not run", "succeeded"]
    assert "it is an OT-2, not a Flex" in told["protocols"][0]["detail"]
    assert "not a Flex" in report.read_text()


def test_nothing_starts_if_a_protocol_cannot_be_rehearsed(aegis, robots, tmp_path):
    bad = tmp_path / "bad.py"
    bad.write_text(EMPTY.replace("pass", "1 / 0"))
    done = aegis("fleet", "run", "--robots", robots, bad)
    assert done.code == 2
    assert "bad.py" in done.err
    assert "Nothing was started" in done.err
    assert "Traceback" not in done.err


def test_without_a_person_a_real_robot_needs_a_yes(aegis, tmp_path):
    path, protocol = tmp_path / "fleet.toml", tmp_path / "empty.py"
    path.write_text('[[robot]]\nname = "a"\naddress = "127.0.0.1"\n')
    protocol.write_text(EMPTY)
    done = aegis("fleet", "run", "--robots", path, protocol)
    assert done.code == 2
    assert "Add --yes" in done.err


def test_a_yes_holds_for_the_first_protocol_of_each_real_robot(aegis, tmp_path):
    path, protocol = tmp_path / "fleet.toml", tmp_path / "good.py"
    protocol.write_text(GOOD)
    with RobotServer() as robot:
        path.write_text(
            f'[[robot]]\nname = "a"\naddress = "{robot.url}"\n'
            'pipettes = {left = "p300_single_gen2"}\n'
        )
        done = aegis("fleet", "run", "--yes", "--robots", path, protocol, protocol)
        assert len(robot.runs) == 1
    assert done.code == 2
    assert "good.py on a: succeeded" in done.out
    assert "good.py (2): not run" in done.out


def test_a_report_of_another_kind_is_refused_before_anything_starts(aegis, robots, tmp_path):
    done = aegis("fleet", "run", "--robots", robots, "--report", "x.pdf", tmp_path / "no.py")
    assert done.code == 2
    assert ".json or .html" in done.err
