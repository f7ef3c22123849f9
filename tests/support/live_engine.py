"""Opentrons' own engine and runner as the robot server puts them together, on given hardware."""

from __future__ import annotations

from typing import Any, NamedTuple

from opentrons.hardware_control import API, HardwareControlAPI
from opentrons.protocol_engine import Config, DeckType, ProtocolEngine, error_recovery_policy
from opentrons.protocol_engine.create_protocol_engine import create_protocol_engine
from opentrons.protocol_runner import RunOrchestrator, create_protocol_runner
from opentrons.protocol_runner.protocol_runner import AnyRunner, LiveRunner
from opentrons.protocols.api_support.deck_type import should_load_fixed_trash
from opentrons.types import Mount


class Live(NamedTuple):
    """What plays one run."""

    engine: ProtocolEngine
    runner: AnyRunner
    orchestrator: RunOrchestrator


async def make_hardware(robot: str) -> Any:
    """Simulated hardware of an ``"OT-2"`` or ``"Flex"``; waits and is cancelled as a real one."""
    if robot == "OT-2":
        hardware: Any = await API.build_hardware_simulator(
            attached_instruments={
                Mount.LEFT: {"model": "p300_single_v2.1", "id": "left", "name": "p300_single_gen2"}
            }
        )
    else:
        from opentrons.hardware_control.ot3api import OT3API
        from opentrons.hardware_control.types import OT3Mount

        hardware = await OT3API.build_hardware_simulator(
            attached_instruments={
                OT3Mount.LEFT: {"model": "p1000_single_v3.6", "id": "left"},
                OT3Mount.GRIPPER: {"model": "gripperV1", "id": "gripper"},
            },
            strict_attached_instruments=False,
        )
    hardware._em_simulate = False
    return hardware


async def make_live(
    hardware: HardwareControlAPI, config: Any, robot: str = "OT-2", recover: Any = None
) -> Live:
    """What plays one run of a protocol with this configuration.

    Args:
        hardware: Of :func:`make_hardware`, or the like.
        config: Of the protocol.
        robot: ``"OT-2"`` or ``"Flex"``.
        recover: Opentrons' policy of error recovery; never to recover if ``None``.
    """
    engine = await create_protocol_engine(
        hardware_api=hardware,
        config=Config(
            robot_type="OT-2 Standard" if robot == "OT-2" else "OT-3 Standard",
            deck_type=DeckType.OT2_STANDARD if robot == "OT-2" else DeckType.OT3_STANDARD,
            use_simulated_deck_config=True,
        ),
        error_recovery_policy=recover or error_recovery_policy.never_recover,
        load_fixed_trash=should_load_fixed_trash(config),
    )
    runner = create_protocol_runner(
        protocol_config=config, protocol_engine=engine, hardware_api=hardware
    )
    others = [LiveRunner(protocol_engine=engine, hardware_api=hardware) for _ in range(3)]
    orchestrator = RunOrchestrator(
        hardware_api=hardware,
        protocol_engine=engine,
        json_or_python_protocol_runner=runner,
        fixit_runner=others[0],
        setup_runner=others[1],
        protocol_live_runner=others[2],
    )
    return Live(engine, runner, orchestrator)
