"""Plans: what is delivered, what is planted, and how a protocol carries it."""

from __future__ import annotations

import ast
import math
from collections import Counter

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.planted import NORMAL
from aegis_ot.qualification.plan import (
    CALIBRATING,
    SECONDS_EACH,
    QualificationPlan,
    make_plan,
    plan_in,
)
from aegis_ot.qualification.protocol import protocol_text
from aegis_ot.simulation.faults import parse_faults


def plan_of(
    seed: int = 1, minutes: float = 30, liquids: tuple[str, ...] = ("dye",)
) -> QualificationPlan:
    return make_plan("p300_single_gen2", "right", liquids, minutes, seed)


def test_half_an_hour_is_48_deliveries_of_which_half_are_faults() -> None:
    plan = plan_of()
    assert len(plan.deliveries) == 48
    assert Counter(each.kind == NORMAL for each in plan.deliveries) == {True: 24, False: 24}
    assert len({each.well for each in plan.deliveries}) == 48


def test_each_half_of_a_liquid_begins_with_the_normal_wells_that_calibrate() -> None:
    plan = plan_of(minutes=60, liquids=("dye", "water"))
    for liquid in plan.liquids:
        for half in (1, 2):
            own = [e for e in plan.deliveries if (e.liquid, e.half) == (liquid, half)]
            assert {each.kind for each in own[:CALIBRATING]} == {NORMAL}
            assert len({(e.kind, e.share) for e in own}) == 12  # all that can be planted


@pytest.mark.parametrize("minutes", [15, 15.7, 16.3, 33, 60])
def test_as_many_are_delivered_as_there_is_time_for(minutes: float) -> None:
    plan = plan_of(minutes=minutes)
    assert len(plan.deliveries) == int(minutes * 60 / SECONDS_EACH)
    assert sum(each.kind != NORMAL for each in plan.deliveries) == len(plan.deliveries) // 2


def test_a_seed_gives_one_order_and_another_seed_another() -> None:
    assert plan_of(5) == plan_of(5)
    assert plan_of(5).deliveries != plan_of(6).deliveries


@pytest.mark.parametrize("seed", range(4))
def test_the_shortest_mixes_all_kinds_too(seed: int) -> None:
    kinds = [
        {each.kind for each in plan_of(seed, 15).deliveries if each.half == half} for half in (1, 2)
    ]
    assert all({"left", "nothing"} < each for each in kinds)


def test_any_plain_name_makes_a_protocol() -> None:
    ast.parse(protocol_text(plan_of(liquids=("5' primer {a} \u03bc",))))


def test_the_simulated_camera_takes_every_fault() -> None:
    faults = parse_faults(plan_of().faults())
    assert len(faults) == 24


def test_a_protocol_carries_its_plan() -> None:
    plan = plan_of(7)
    assert plan_in(protocol_text(plan)) == plan
    with pytest.raises(ConfigurationError, match="no protocol that aegis-ot qualify wrote"):
        plan_in("PLAN = 'x'\n\ndef run(protocol):\n    pass\n")
    for garbled in ("3", '"x"', "null", "[]", "{}"):
        with pytest.raises(ConfigurationError, match="has no plan"):
            plan_in(f"PLAN = {garbled!r}")


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"pipette": "p300_multi_gen2"}, "with one channel"),
        ({"minutes": 5}, "15.0 minutes at least"),
        ({"liquids": ("dye", "dye")}, "each liquid once"),
        ({"volume_ul": 900}, "µL at most"),
        # A quarter more than 272 is what a well of the plate takes.
        (
            {"volume_ul": 280, "pipette": "p1000_single_gen2", "minutes": 15},
            "272 µL at most",
        ),
        ({"volume_ul": 100, "pipette": "p50_single"}, "38 µL at most"),  # of the pipette's 50
        ({"minutes": math.nan}, "no time that a robot"),
        ({"minutes": math.inf}, "no time that a robot"),
        ({"liquids": ('a """ b',)}, "in plain words"),
        ({"liquids": ("a\\",)}, "in plain words"),
        ({"liquids": ("a\nb",)}, "in plain words"),
        ({"tips": 'x"'}, "in plain words"),
    ],
)
def test_what_cannot_be_done_is_said(changed: dict[str, object], said: str) -> None:
    given = {"pipette": "p300_single_gen2", "mount": "left", "liquids": ("dye",)} | changed
    with pytest.raises(ConfigurationError, match=said):
        make_plan(**given)  # type: ignore[arg-type]
