from __future__ import annotations

import pytest

from aegis_ot.fleet.schedule import fitting, least_s, next_job

from .support import fleet, job


def test_the_longest_that_fits_is_next():
    config = fleet(
        {"name": "a", "pipettes": {"left": "p300_single_gen2"}},
        {"name": "b", "pipettes": {"left": "p20_single_gen2"}},
    )
    short, long = job("short", 1), job("long", 9, pipettes={"left": "p300_single_gen2"})
    fits = fitting([short, long], config.robot)
    assert next_job("a", [short, long], fits) is long
    assert next_job("b", [short, long], fits) is short
    assert next_job("b", [long], fits) is None


def test_of_equally_long_ones_the_pickiest_is_next():
    config = fleet({"name": "a", "modules": ["temperature module gen2"]}, {"name": "b"})
    anywhere, picky = job("anywhere"), job("picky", modules=("temperatureModuleV2",))
    fits = fitting([anywhere, picky], config.robot)
    assert next_job("a", [anywhere, picky], fits) is picky


@pytest.mark.parametrize(
    ("needs", "lacking"),
    [
        ({}, []),
        ({"robot_type": "Flex"}, ["it is an OT-2, not a Flex"]),
        ({"pipettes": {"right": "p20_single_gen2"}}, ["p20_single_gen2 on the right mount"]),
        ({"pipettes": {"left": "p20_single_gen2"}}, ["p20_single_gen2 on the left mount"]),
        ({"modules": ("temperatureModuleV2",)}, []),
        ({"modules": ("temperatureModuleV2",) * 2}, ["temperatureModuleV2"]),
        ({"labware": frozenset({"plate", "rack"})}, ["rack"]),
    ],
)
def test_what_a_robot_lacks_is_told(needs, lacking):
    (robot,) = fleet(
        {
            "name": "a",
            "pipettes": {"left": "p300_single_gen2"},
            "modules": ["temperature module gen2"],
            "labware": ["plate"],
        }
    ).robot
    assert robot.lacks(job("it", **needs).needs) == lacking


def test_bounds():
    assert least_s([5, 1, 1, 1], 2) == 5
    assert least_s([2, 2, 2], 2) == 3
    assert least_s([], 3) == 0
