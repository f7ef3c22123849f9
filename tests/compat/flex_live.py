"""Guarded runs on a live, simulated Flex: gripper, waste chute, error recovery, hold and stop.

A plain program, so that it runs in an interpreter that has nothing but ``opentrons``::

    python -m tests.compat.flex_live

prints one JSON object: what went otherwise than it should, by story.
"""

from __future__ import annotations

import json
import logging
import sys
import time
import traceback
from collections.abc import Callable
from typing import Any

from opentrons.hardware_control.ot3api import OT3API
from opentrons.protocol_engine.error_recovery_policy import ErrorRecoveryType
from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION
from opentrons_shared_data.errors.exceptions import PipetteLiquidNotFoundError

from aegis_ot.settings import Settings
from tests.runtime.fake_sidecar import FakeSidecar
from tests.runtime.live import LiveRun

API = "2.22"


def gripper_and_chute(context: Any) -> None:
    tips = context.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = context.load_labware("nest_96_wellplate_200ul_flat", "C2")
    reservoir = context.load_labware("nest_12_reservoir_15ml", "C1")
    chute = context.load_waste_chute()
    pipette = context.load_instrument("flex_1channel_1000", "left", [tips])
    pipette.pick_up_tip()
    pipette.aspirate(60, reservoir["A1"])
    pipette.dispense(50, plate["A1"])
    pipette.dispense(10, chute)
    pipette.drop_tip()
    context.move_labware(plate, "D2", use_gripper=True)
    pipette.transfer(50, reservoir["A2"], plate["B1"])
    context.move_labware(plate, chute, use_gripper=True)


def deck_with_bin(context: Any) -> tuple[Any, Any, Any]:
    """A pipette, a reservoir to draw from and a plate."""
    tips = context.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = context.load_labware("nest_96_wellplate_200ul_flat", "C2")
    reservoir = context.load_labware("nest_12_reservoir_15ml", "C1")
    context.load_trash_bin("A3")
    pipette = context.load_instrument("flex_1channel_1000", "left", [tips])
    return pipette, reservoir, plate


def needs_liquid(context: Any) -> None:
    pipette, reservoir, plate = deck_with_bin(context)
    for name in ("A1", "B1"):
        pipette.pick_up_tip()
        pipette.require_liquid_presence(reservoir["A1"])
        pipette.aspirate(50, reservoir["A1"])
        pipette.dispense(50, plate[name])
        pipette.drop_tip()


def probes(context: Any) -> None:
    pipette, reservoir, plate = deck_with_bin(context)

    def deliver(name: str) -> None:
        pipette.aspirate(50, reservoir["A1"])
        pipette.dispense(50, plate[name])

    pipette.pick_up_tip()
    pipette.detect_liquid_presence(reservoir["A1"])
    deliver("A1")
    deliver("B1")
    pipette.drop_tip()
    pipette.pick_up_tip()
    pipette.detect_liquid_presence(reservoir["A1"])
    deliver("C1")
    pipette.drop_tip()
    pipette.liquid_presence_detection = True
    pipette.pick_up_tip()
    deliver("D1")
    pipette.drop_tip()


def wait_for_recovery(config: Any, failed_command: Any, defined_error_data: Any) -> Any:
    return ErrorRecoveryType.WAIT_FOR_RECOVERY


def start(protocol: Callable[[Any], None], sidecar: FakeSidecar, recover: Any = None) -> LiveRun:
    settings = Settings(sidecar=sidecar.url, run_id="run")
    return LiveRun(protocol, settings, API, "Flex", recover).start()


def kinds(run: LiveRun) -> list[str]:
    return [command.commandType for command in run.commands]


def a_good_run_moves_labware_and_throws_away(sidecar: FakeSidecar) -> None:
    run = start(gripper_and_chute, sidecar).join(60)
    assert run.error is None, run.error
    assert run.status == "succeeded", run.told
    assert len(sidecar.stored()) == 8
    assert kinds(run).count("moveLabware") == 2
    assert run.watcher is not None
    assert "2 passed" in run.watcher.summary()


def a_failed_well_is_told_before_the_gripper_or_the_chute_move(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    run = start(gripper_and_chute, sidecar)
    run.wait_for_status("paused")
    before = [command.commandType for command in run.seen()]
    assert before[-1] == "waitForResume"
    assert before.count("dispense") == 1, "the rest is still in the tip"
    assert "moveLabware" not in before
    run.play()
    run.join(60)
    assert run.error is None, run.error
    assert len(sidecar.stored()) == 8


def a_stop_during_a_hold_is_quick(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = None
    run = start(gripper_and_chute, sidecar)
    assert sidecar.asked.wait(60)
    run.stop()
    run.join()
    assert [told["outcome"] for told in sidecar.finished] == ["stopped"]


def error_recovery_goes_on_with_the_guard(sidecar: FakeSidecar) -> None:
    """A simulated probe finds no liquid; each time a person looks, and goes on."""
    run = start(needs_liquid, sidecar, wait_for_recovery)
    for stored in (0, 4):
        in_time(lambda n=stored: len(sidecar.stored()) == n and run.status == "awaiting-recovery")
        run.retry()
    run.join(60)
    assert run.error is None, run.error
    assert run.status == "succeeded", run.told
    assert len(sidecar.stored()) == 8
    # Each time a person may have filled the well: the sensor's word is no longer one.
    assert {keyframe["liquid_found"] for keyframe in sidecar.stored()} == {None}
    assert run.watcher is not None
    assert "2 passed" in run.watcher.summary()


def what_the_sensor_says_goes_with_the_delivery(sidecar: FakeSidecar) -> None:
    levels = iter((10.0, None, 10.0))
    asked = []

    async def liquid_probe(_self: Any, *_: Any, **__: Any) -> float:
        asked.append(next(levels))
        if asked[-1] is None:
            raise PipetteLiquidNotFoundError("none")
        return asked[-1]

    real, OT3API.liquid_probe = OT3API.liquid_probe, liquid_probe
    try:
        run = start(probes, sidecar).join(60)
    finally:
        OT3API.liquid_probe = real
    assert run.error is None, run.error
    said = [keyframe["liquid_found"] for keyframe in sidecar.stored()]
    assert said == [True] * 4 + [None] * 4 + [False] * 4 + [True] * 4, said
    # The guard asks for no probe of its own.
    assert sum("iquidProbe" in kind for kind in kinds(run)) == len(asked) == 3


RECOVERED = """
from aegis_ot import guard
requirements = {{"robotType": "Flex", "apiLevel": "{api}"}}

@guard(sidecar="{sidecar}", run_id="run", rules="off", recover={{"no_aspirate": "retry"}})
def run(context):
    tips = context.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = context.load_labware("nest_96_wellplate_200ul_flat", "C2")
    context.load_trash_bin("A3")
    pipette = context.load_instrument("flex_1channel_1000", "left", [tips])
    {group}
        for source, target in (("A1", "A2"), ("B1", "B2")):
            pipette.transfer(50, plate[source], plate[target], new_tip="always")
"""


def a_recovery_is_one_group_of_steps(sidecar: FakeSidecar) -> None:
    groups = MAX_SUPPORTED_VERSION.minor >= 29
    level = f"2.{29 if groups else 22}"
    grouped = recovered(sidecar, level, "if True:")
    assert [name for name, _ in grouped] == (["aegis_ot: recovery"] if groups else [])
    if not groups:
        return
    steps = grouped[0][1]
    assert (steps[0], steps[-1]) == ("comment", "dispense"), steps
    assert steps.count("pickUpTip") == steps.count("aspirate") == 1, steps
    # There is but one group at a time; the protocol's own goes first.
    sidecar.keyframes.clear()
    grouped = recovered(sidecar, level, 'with context.group_steps("first plate"):')
    assert [name for name, _ in grouped] == ["first plate"]


def recovered(sidecar: FakeSidecar, api: str, group: str) -> list[tuple[str, list[str]]]:
    """The groups of a run in which one well is put right: name, types of the commands."""
    sidecar.outcomes[0] = "fail"
    sidecar.findings[0] = {"failure": "no_aspirate", "gate": "volumetric", "measured_ul": 0.0}
    text = RECOVERED.format(api=api, sidecar=sidecar.url, group=group)
    run = LiveRun(text, api=api, robot="Flex").start().join(60)
    assert run.told == "", run.told
    assert kinds(run).count("aspirate") == 3, kinds(run)
    return [
        (one.name, [c.commandType for c in run.commands if one.id in c.commandAnnotationIds])
        for one in run.groups
    ]


def in_time(condition: Callable[[], bool]) -> None:
    until = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.01)


STORIES = (
    a_good_run_moves_labware_and_throws_away,
    a_failed_well_is_told_before_the_gripper_or_the_chute_move,
    a_stop_during_a_hold_is_quick,
    error_recovery_goes_on_with_the_guard,
    what_the_sensor_says_goes_with_the_delivery,
    a_recovery_is_one_group_of_steps,
)


def main() -> int:
    logging.disable(logging.CRITICAL)
    told = {}
    for story in STORIES:
        begun = time.perf_counter()
        try:
            with FakeSidecar() as sidecar:
                story(sidecar)
            told[story.__name__] = ""
        except Exception:
            told[story.__name__] = traceback.format_exc()
        print(f"{time.perf_counter() - begun:.1f} s", story.__name__, file=sys.stderr)
    print(json.dumps(told))
    return 0


if __name__ == "__main__":
    sys.exit(main())
