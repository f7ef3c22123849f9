"""Both layers on real parts: Opentrons' simulator with a sidecar, and a robot's HTTP API."""

from __future__ import annotations

import asyncio
import base64

from aegis_ot.fleet import FleetConfig, read_job, run_fleet
from aegis_ot.fleet.coordinator import FleetScreen
from aegis_ot.reports.fleet_html import fleet_report_html
from aegis_ot.sidecar import SidecarConfig, running_sidecar

from ..robot.protocols import BAD, GOOD, WAITS
from ..sidecar.helpers import StubAnalyser, StubCamera
from ..support.robot_server import RobotServer
from .support import Heard, fleet, job

WATCHED = """
metadata = {"apiLevel": "2.16"}
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "plate")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, "dye")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    red = protocol.define_liquid("red dye", "", "#ff0000")
    reservoir["A1"].load_liquid(red, 10000)
    for well in plate.wells()[:8]:
        p300.transfer(150, reservoir["A1"], well)
"""
CONTAMINATES = """
from aegis_ot import guard
metadata = {"apiLevel": "2.16"}
@guard(assay="pcr", roles={"ntc": ["1:A1"], "template": ["2:A1"]})
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    dna = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    p300.pick_up_tip()
    p300.transfer(50, dna["A1"], [plate["B1"], plate["A1"]], new_tip="never")
    p300.drop_tip()
"""
P300 = {"left": "p300_single_gen2"}


def written(folder, name, text, **more):
    path = folder / name
    path.write_text(text)
    return read_job(path, **more)


class Ready(FleetScreen):
    async def is_ready(self, robot, job):
        return True


def go(config: FleetConfig, *jobs, screen=None):
    return asyncio.run(asyncio.wait_for(run_fleet(config, jobs, screen or Ready()), 100))


def test_a_simulated_robot_runs_both_layers(tmp_path):
    heard = Heard()
    watched = written(tmp_path, "watched.py", WATCHED, faults=["no_dispense@1:G1"])
    refused = written(tmp_path, "refused.py", CONTAMINATES)
    report = go(fleet({"name": "a", "pipettes": P300}), watched, refused, screen=heard)
    first, second = report.entries
    assert first.outcome == "succeeded"
    assert first.result["frames"] == "simulated"
    assert first.result["counts"]["wells"] == 8
    assert [well["failure"] for well in first.flagged] == ["no_dispense"]
    assert "G1 of plate" in first.flagged[0]["well"]
    pictures = first.flagged[0]["pictures"]
    assert list(pictures) == ["aspirate", "transit", "dispense", "post_dispense"]
    assert base64.b64decode(pictures["transit"]).startswith(b"\xff\xd8")
    assert "pictures" not in report.to_json()["protocols"][0]["flagged"][0]
    page = fleet_report_html(report.to_json(pictures=True))
    assert all(f"base64,{picture}" in page for picture in pictures.values())
    assert second.outcome == "rejected"
    assert {finding["severity"] for finding in second.result["layer1"]["findings"]} >= {"error"}
    assert ("a", "asking") in heard.states


def test_a_real_robot_is_driven_through_its_api(tmp_path):
    with RobotServer() as robot:
        config = fleet({"name": "bench", "address": robot.url, "pipettes": P300})
        good = written(tmp_path, "good.py", GOOD)
        bad = job("bad.py", 0.1)
        bad = type(bad)(bad.name, type(bad.script)(BAD, "bad.py"), bad.needs, 0.1)
        report = go(config, good, bad)
        assert [entry.outcome for entry in report.entries] == ["succeeded", "failed"]
        assert report.entries[0].result["frames"] == "real"
        assert "no such thing" in report.entries[1].detail
        assert not report.lost
        assert len(robot.runs) == 1  # what Layer 1 could not rehearse was never sent


def test_what_a_real_robots_sidecar_saw_of_a_bad_well_is_in_the_report(tmp_path):
    settings = SidecarConfig(port=0, data=tmp_path / "sidecar")
    with (
        RobotServer() as robot,
        running_sidecar(settings, StubCamera(), StubAnalyser([1])) as url,
    ):
        config = fleet({"name": "bench", "address": robot.url, "pipettes": P300, "sidecar": url})
        head, _, rest = GOOD.partition("def run")
        guard = f'from aegis_ot import guard\n@guard(sidecar={url!r}, on_fail="continue")\n'
        (entry,) = go(config, written(tmp_path, "good.py", f"{head}{guard}def run{rest}")).entries
        assert (entry.outcome, entry.result["counts"]) == (
            "succeeded", {"pass": 1, "fail": 1, "wells": 2},
        )  # fmt: skip
        (well,) = entry.flagged
        assert well["well"].startswith("B2 of Corning 96 Well Plate")
        assert list(well["pictures"]) == ["aspirate"]  # where the stub has a tip


def test_a_real_robot_that_nobody_made_ready_is_left_alone(tmp_path):
    with RobotServer() as robot:
        config = fleet({"name": "bench", "address": robot.url, "pipettes": P300})
        report = go(config, written(tmp_path, "good.py", GOOD), screen=FleetScreen())
        assert [entry.outcome for entry in report.entries] == ["not run"]
        assert "Nobody said that bench is ready" in report.entries[0].detail
        assert not robot.protocols


def test_a_real_robot_is_paused_when_the_fleet_is_broken_off(tmp_path):
    with RobotServer() as robot:
        config = fleet({"name": "bench", "address": robot.url, "pipettes": P300})
        waits = written(tmp_path, "waits.py", WAITS)

        async def break_off():
            task = asyncio.ensure_future(run_fleet(config, [waits], Ready()))
            while not any(r["status"] == "running" for r in await statuses(robot)):
                await asyncio.sleep(0.05)
            task.cancel()
            return await task

        report = asyncio.run(asyncio.wait_for(break_off(), 60))
        assert report.broken_off
        assert [r["status"] for r in asyncio.run(statuses(robot))] == ["paused"]


async def statuses(robot):
    from aegis_ot.robot import RobotClient

    def ask():
        with RobotClient(robot.url) as client:
            return [{"status": client.run(run).status} for run in list(robot.runs)]

    return await asyncio.to_thread(ask)
