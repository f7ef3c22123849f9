from __future__ import annotations

import json

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.fleet import FleetConfig, Job, read_job
from aegis_ot.fleet.config import EXCHANGE_VARIABLE

TEXT = """
metadata = {"apiLevel": "2.15"}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    block = protocol.load_module("temperature module gen2", 3)
    plate = block.load_labware("corning_96_wellplate_360ul_flat")
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    p300.transfer(100, plate["A1"], plate["B1"])
"""


def test_needs_and_time_come_from_the_rehearsal(tmp_path):
    short, long = tmp_path / "short.py", tmp_path / "long.py"
    short.write_text(TEXT)
    long.write_text(TEXT + "    protocol.delay(minutes=10)\n")
    job = read_job(short)
    assert job.needs.robot_type == "OT-2"
    assert job.needs.pipettes == {"left": "p300_single_gen2"}
    assert job.needs.modules == ("temperatureModuleV2",)
    assert job.needs.labware == {"opentrons_96_tiprack_300ul", "corning_96_wellplate_360ul_flat"}
    assert job.expected_s > 10
    assert read_job(long).expected_s == pytest.approx(job.expected_s + 600)


def test_a_job_survives_the_wire(tmp_path):
    path = tmp_path / "short.py"
    path.write_text(TEXT)
    job = read_job(path, faults=["partial:50@B1"])
    assert Job.from_wire(json.loads(json.dumps(job.to_wire()))) == job


def test_the_fleet_file(tmp_path):
    path = tmp_path / "fleet.toml"
    path.write_text('exchange = "redis://u:secret@h:1"\n[[robot]]\nname = "a"\nremote = true\n')
    config = FleetConfig.load(path, {})
    assert config.exchange == "redis://u:secret@h:1"
    assert [robot.name for robot in config.robot] == ["a"]
    assert FleetConfig.load(path, {EXCHANGE_VARIABLE: "http://h:2"}).exchange == "http://h:2"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "robot: Field required"),
        ('[[robot]]\nname = "a"\n[[robot]]\nname = "a"\n', "two robots are called 'a'"),
        ('[[robot]]\nname = "a"\nremote = true\n', "needs an exchange"),
        ('[[robot]]\nname = "a"\nmodules = ["toaster"]\n', "robot.0.modules"),
        ('[[robot]]\nname = "a"\nadress = "10.0.0.1"\n', "robot.0.adress"),
    ],
)
def test_a_wrong_fleet_file_is_told(tmp_path, text, told):
    path = tmp_path / "fleet.toml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=told):
        FleetConfig.load(path, {})
