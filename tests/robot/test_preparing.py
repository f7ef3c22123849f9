"""What ``aegis-ot run`` settles before the start, with Opentrons' engine behind the robot."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.robot.deck_needs import Needs, lacking, needs_of
from aegis_ot.robot.offsets import known_offsets, offsets_in_file
from aegis_ot.robot.places import Place

from ..cli.commands import Command
from ..support.robot_server import RobotServer
from .protocols import CSV, FLEX, GOOD, ON_MODULE, WITH_INPUTS
from .test_running import written

PLATE = "opentrons/corning_96_wellplate_360ul_flat/2"
AT_2 = {"definitionUri": PLATE, "location": {"slotName": "2"}, "vector": {"x": 0, "y": 0.4}}


@pytest.fixture
def flex() -> Iterator[RobotServer]:
    with RobotServer(robot="Flex") as server:
        yield server


def loaded(robot: RobotServer) -> dict[str, Any]:
    """The offset that the engine gave each labware of the last run, by slot; "" without one."""
    run = list(robot.runs.values())[-1]
    offsets = {one["id"]: one["vector"] for one in run.view()["labwareOffsets"] if "id" in one}
    return {
        one["location"].get("slotName", "module"): offsets.get(one.get("offsetId"), "")
        for one in run.view()["labware"]
        if isinstance(one["location"], dict)
    }


def test_a_run_has_the_offsets_of_the_last_run_of_that_labware_and_slot(
    aegis: Command, robot: RobotServer
) -> None:
    protocol = written(GOOD)
    done = aegis("run", protocol, "--robot", robot.url, "--yes")
    assert done.code == 0, done.err
    assert "No labware offset for corning_96_wellplate_360ul_flat in slot 2;" in done.out
    (first,) = robot.runs.values()
    first.offsets += [AT_2, AT_2 | {"location": {"slotName": "5"}, "vector": {"x": 9}}]
    assert aegis("run", protocol, "--robot", robot.url, "--yes", "--offsets", "none").code == 0
    assert loaded(robot)["2"] == "", "this one was to go without"
    done = aegis("run", protocol, "--robot", robot.url, "--yes")
    assert done.code == 0, done.err
    assert "Offset of corning_96_wellplate_360ul_flat in slot 2: x 0, y 0.4, z 0 mm" in done.out
    assert "No labware offset for opentrons_96_tiprack_300ul in slot 1." in done.out
    assert loaded(robot)["2"] == {"x": 0, "y": 0.4, "z": 0}
    assert loaded(robot)["1"] == ""


def test_an_offset_on_a_module_is_that_of_the_module(aegis: Command, robot: RobotServer) -> None:
    robot.modules = ["temperatureModuleV2"]
    robot.store = [
        AT_2 | {"location": None, "locationSequence": sequence, "vector": {"x": x}}
        for x, sequence in (
            (1, [{"kind": "onAddressableArea", "addressableAreaName": "4"}]),
            (
                2,
                [
                    {"kind": "onModule", "moduleModel": "temperatureModuleV2"},
                    {"kind": "onAddressableArea", "addressableAreaName": "4"},
                ],
            ),
        )
    ]
    done = aegis("run", written(ON_MODULE), "--robot", robot.url, "--yes")
    assert done.code == 0, done.out + done.err
    assert "360ul_flat on temperatureModuleV2 in slot 4: x 2, y 0, z 0 mm" in done.out
    assert "(from the robot's store)" in done.out
    assert loaded(robot)["module"] == {"x": 2, "y": 0, "z": 0}


def test_the_store_of_a_flex_counts_alone_and_may_say_anywhere(
    aegis: Command, flex: RobotServer
) -> None:
    plate = "opentrons/nest_96_wellplate_200ul_flat"
    done = aegis("run", written(FLEX), "--robot", flex.url, "--yes")
    assert done.code == 0, done.out + done.err
    (first,) = flex.runs.values()
    version = next(
        one["definitionUri"] for one in first.view()["labware"] if plate in one["definitionUri"]
    )
    offset = {"definitionUri": version, "vector": {"x": 1, "y": 0, "z": 0}}
    first.offsets.append(offset | {"location": {"slotName": "C2"}})
    flex.store = []
    assert aegis("run", written(FLEX), "--robot", flex.url, "--yes").code == 0
    assert loaded(flex)["C2"] == "", "cleared in the store"
    flex.store = [offset | {"locationSequence": "anyLocation", "vector": {"x": 0, "y": 0, "z": 3}}]
    assert aegis("run", written(FLEX), "--robot", flex.url, "--yes").code == 0
    assert loaded(flex)["C2"] == {"x": 0, "y": 0, "z": 3}


def test_offsets_of_a_file(aegis: Command, robot: RobotServer, tmp_path: Path) -> None:
    path = tmp_path / "offsets.json"
    path.write_text(json.dumps({"data": [AT_2]}), encoding="utf-8")
    done = aegis("run", written(GOOD), "--robot", robot.url, "--yes", "--offsets", path)
    assert done.code == 0, done.out + done.err
    assert "(from offsets.json)" in done.out
    assert loaded(robot)["2"] == {"x": 0, "y": 0.4, "z": 0}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "no JSON file"),
        ("7", "entry 1 is no labware offset"),
        (json.dumps([AT_2, AT_2 | {"vector": {"x": "1"}}]), "entry 2 is no labware offset"),
        (json.dumps([AT_2 | {"vector": {"x": float("nan")}}]), "entry 1 is no labware offset"),
        (json.dumps([AT_2 | {"location": {"slotName": "3"}}]), "360ul_flat in slot 2"),
    ],
)
def test_a_file_that_is_no_list_of_offsets_is_refused(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "offsets.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match="--offsets") as refused:
        offsets_in_file(path, [Place(PLATE, "2")])
    assert said in str(refused.value)


def test_of_several_the_newest_counts_and_what_is_no_offset_is_passed_over(
    robot: RobotServer,
) -> None:
    class Told:
        def stored_offsets(self) -> list[dict[str, Any]]:
            return [
                AT_2 | {"createdAt": "2026-02-01", "vector": {"x": 2}},
                AT_2 | {"createdAt": "2026-01-01", "vector": {"x": 1}},
                {"definitionUri": PLATE},
            ]

        def runs(self) -> list[dict[str, Any]]:
            return [{"createdAt": "2026-03-01", "labwareOffsets": None}]

    (found,) = known_offsets(Told(), [Place(PLATE, "2")], flex=False)  # type: ignore[arg-type]
    assert found.vector == (2.0, 0.0, 0.0)


def test_a_csv_file_goes_with_the_protocol(aegis: Command, robot: RobotServer) -> None:
    Path("plan.csv").write_text("A1,50\nB1,60\n", encoding="utf-8")
    protocol = written(CSV)
    lacking_one = aegis("run", protocol, "--robot", robot.url, "--yes")
    assert lacking_one.code == 1
    assert "The parameter plan needs a file: --csv plan=FILE." in lacking_one.out
    misspelt = aegis("run", protocol, "--robot", robot.url, "--yes", "--csv", "plam=plan.csv")
    assert misspelt.code == 2
    assert "there is no parameter plam; there are plan" in misspelt.err
    assert robot.runs == {}
    done = aegis("run", protocol, "--robot", robot.url, "--yes", "--csv", "plan=plan.csv")
    assert done.code == 0, done.out + done.err
    (run,) = robot.runs.values()
    volumes = [
        c["params"]["volume"]
        for c in run.commands(0, 100)["data"]
        if c["commandType"] == "aspirate"
    ]
    assert volumes == [50, 60]


def test_a_misspelt_value_is_named(aegis: Command, robot: RobotServer) -> None:
    text = WITH_INPUTS.replace(', namespace="my_lab", version=2', "").replace(
        "my_plate", "corning_96_wellplate_360ul_flat"
    )
    done = aegis("run", written(text), "--robot", robot.url, "-y", "--parameter", "welz=3")
    assert done.code == 2
    assert "there is no parameter welz; there are wells" in done.err


def test_a_module_that_is_not_connected_keeps_the_run_from_starting(
    aegis: Command, robot: RobotServer
) -> None:
    done = aegis("run", written(ON_MODULE), "--robot", robot.url, "--yes")
    assert done.code == 2
    assert "It uses temperatureModule in slot 4, and none is connected." in done.err
    assert robot.runs == {}


def test_a_deck_that_is_configured_otherwise_keeps_the_run_from_starting(
    aegis: Command, flex: RobotServer
) -> None:
    flex.fixtures["cutoutA3"] = "singleRightSlot"
    done = aegis("run", written(FLEX), "--robot", flex.url, "--yes")
    assert done.code == 2
    assert "It uses a trash bin in A3; the robot has none configured there." in done.err
    assert flex.runs == {}


@pytest.mark.parametrize(
    ("area", "cutout", "fixture", "lacks"),
    [
        ("movableTrashA3", "cutoutA3", "trashBinAdapter", False),
        ("movableTrashA3", "cutoutA3", "singleRightSlot", True),
        ("1ChannelWasteChute", "cutoutD3", "wasteChuteRightAdapterCovered", False),
        (
            "gripperWasteChute",
            "cutoutD3",
            "stagingAreaSlotWithWasteChuteRightAdapterNoCover",
            False,
        ),
        ("96ChannelWasteChute", "cutoutD3", "singleRightSlot", True),
        ("B4", "cutoutB3", "stagingAreaRightSlot", False),
        ("B4", "cutoutB3", "singleRightSlot", True),
        ("B4", "cutoutB3", "somethingNew", False),
        ("D3", "cutoutD3", "wasteChuteRightAdapterCovered", True),
        ("D3", "cutoutD3", "singleRightSlot", False),
        ("D3", "cutoutD3", "stagingAreaRightSlot", False),
    ],
)
def test_fixtures(area: str, cutout: str, fixture: str, lacks: bool) -> None:
    assert bool(lacking(Needs((area,)), (), {cutout: fixture})) == lacks


def test_of_modules_there_must_be_enough() -> None:
    commands = [
        {"commandType": "loadModule", "params": {"model": model, "location": {"slotName": slot}}}
        for model, slot in (
            ("temperatureModuleV2", "C1"), ("temperatureModuleV2", "D1"), ("magneticBlockV1", "C2")
        )
    ]  # fmt: skip
    one = [{"moduleModel": "temperatureModuleV1"}]
    (text,) = lacking(needs_of(commands), one, {})
    assert text == "It uses temperatureModule in slot C1, D1, and 1 of 2 are connected."
    assert not lacking(needs_of(commands), one * 2, {})
