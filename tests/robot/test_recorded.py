"""What a run really did is judged after the fact."""

from __future__ import annotations

import json
from pathlib import Path

from aegis_ot.robot import RobotClient
from aegis_ot.robot.following import follow

from ..cli.commands import Command
from ..support.robot_server import RobotServer

TWICE = """
metadata = {"apiLevel": "2.16"}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "2", "samples")
    water = protocol.define_liquid("water", "clean", "#0000ff")
    plate["A1"].load_liquid(water, 40)
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    pipette.pick_up_tip()
    pipette.aspirate(100, plate["A1"])
    pipette.dispense(100, plate["B1"])
    pipette.drop_tip()
"""


def test_a_run_is_judged_after_the_fact(
    robot: RobotServer, client: RobotClient, aegis: Command, tmp_path: Path
) -> None:
    file = tmp_path / "twice.py"
    file.write_text(TWICE)
    identifier, _ = client.upload(file)
    client.analysis(identifier, 60)
    run = client.create_run(identifier)
    client.act(run, "play")
    for _ in follow(client, run):
        pass
    done = aegis("check", "--robot", robot.url, "--run", "current", "--format", "json")
    assert done.code == 1, done.err
    (told,) = json.loads(done.out)["protocols"]
    assert told["file"] == f"run-{run}.json"
    assert told["lines_are"] == "commands"
    assert any("2:A1" in json.dumps(one) for one in told["findings"])
    assert "what the run did" in done.err


def test_a_run_goes_with_a_robot_and_without_files(aegis: Command) -> None:
    assert "--run goes with --robot" in aegis("check", "--run", "current").err
    assert "Name protocols, folders, or a run" in aegis("check").err
