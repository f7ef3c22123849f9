"""Opentrons' own engine and runner as the robot server puts them together, on given hardware."""

from __future__ import annotations

from typing import Any, NamedTuple

from opentrons.hardware_control import HardwareControlAPI
from opentrons.protocol_engine import Config, DeckType, ProtocolEngine, error_recovery_policy
from opentrons.protocol_engine.create_protocol_engine import create_protocol_engine
from opentrons.protocol_runner import RunOrchestrator, create_protocol_runner
from opentrons.protocol_runner.protocol_runner import AnyRunner, LiveRunner
from opentrons.protocols.api_support.deck_type import should_load_fixed_trash


class Live(NamedTuple):
    """What plays one run."""

    engine: ProtocolEngine
    runner: AnyRunner
    orchestrator: RunOrchestrator


async def make_live(hardware: HardwareControlAPI, config: Any) -> Live:
    """What plays one run of a protocol with this configuration on an OT-2."""
    engine = await create_protocol_engine(
        hardware_api=hardware,
        config=Config(
            robot_type="OT-2 Standard",
            deck_type=DeckType.OT2_STANDARD,
            use_simulated_deck_config=True,
        ),
        error_recovery_policy=error_recovery_policy.never_recover,
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
