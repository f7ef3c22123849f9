"""A simulated ``ProtocolContext`` that cleans up after itself.

``opentrons.simulate.get_protocol_api`` keeps its engine alive until the interpreter ends: on a
robot server that would leave a thread behind for each run. This builds the same context from
the same parts, inside a ``with`` block.
"""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from typing import Any

FLEX = "OT-3 Standard"


@contextmanager
def simulated_context(
    api_level: Any,
    robot_type: str,
    *,
    extra_labware: Mapping[str, Any] | None = None,
    bundled_data: Mapping[str, bytes] | None = None,
) -> Iterator[Any]:
    """Yield a homed, simulated ``ProtocolContext``.

    Args:
        api_level: ``opentrons.protocols.api_support.types.APIVersion``.
        robot_type: ``"OT-2 Standard"`` or ``"OT-3 Standard"``.
        extra_labware: Custom definitions, by URI.
        bundled_data: Data files of the protocol.
    """
    from opentrons.protocol_api import create_protocol_context
    from opentrons.protocol_api.core.engine import ENGINE_CORE_API_VERSION
    from opentrons.protocols.api_support.deck_type import for_simulation

    deck_type = for_simulation(robot_type)
    with ExitStack() as stack:
        hardware = _hardware_simulator(robot_type)
        stack.callback(hardware.clean_up)
        is_legacy = api_level < ENGINE_CORE_API_VERSION
        if is_legacy:
            stack.enter_context(_plunger_speeds())
            core_parts = {"use_simulating_core": True, "extra_labware": dict(extra_labware or {})}
        else:
            engine, loop = stack.enter_context(_engine(hardware, robot_type, deck_type, api_level))
            adding = _add(engine, extra_labware or {})
            asyncio.run_coroutine_threadsafe(adding, loop).result()
            core_parts = {"protocol_engine": engine, "protocol_engine_loop": loop}
        context = create_protocol_context(
            api_version=api_level,
            hardware_api=hardware,
            deck_type=deck_type,
            bundled_data=dict(bundled_data or {}),
            **core_parts,
        )
        stack.callback(context.cleanup)
        if is_legacy:
            _lend_modules(context._core, hardware)
        # Both have to be homed for some commands to work; see opentrons.simulate.
        hardware.sync.home()
        context.home()
        yield context


def _hardware_simulator(robot_type: str) -> Any:
    from opentrons.hardware_control import ThreadManager
    from opentrons.hardware_control.types import HardwareFeatureFlags

    if robot_type == FLEX:
        # Not importable on an OT-2.
        from opentrons.hardware_control.ot3api import OT3API as Robot
    else:
        from opentrons.hardware_control import API as Robot
    flags = HardwareFeatureFlags.build_from_ff()
    return ThreadManager(Robot.build_hardware_simulator, feature_flags=flags)


@contextmanager
def _plunger_speeds() -> Iterator[None]:
    """Let ``pipette.speed`` work: it asserts a robot's core, and the simulating one has it too."""
    from opentrons.protocol_api import instrument_context
    from opentrons.protocol_api.core.legacy_simulator import legacy_instrument_core as simulator

    names, core = vars(instrument_context), instrument_context.LegacyInstrumentCore
    names["LegacyInstrumentCore"] = (core, simulator.LegacyInstrumentCoreSimulator)
    try:
        yield
    finally:
        names["LegacyInstrumentCore"] = core


def _lend_modules(core: Any, hardware: Any) -> None:
    """Plug each simulated module in just before a legacy core looks for it.

    The core would make one itself, but from Python 3.11 on it asks for its definition under the
    name of the enumeration's member, and finds none ("Could not find a module with model
    "ThermocyclerModuleModel.THERMOCYCLER_V1""). One that is plugged in is found by its own name.
    """
    load_module = core.load_module

    def load(model: Any, *args: Any, **kwargs: Any) -> Any:
        hardware.sync.create_simulating_module(model)
        return load_module(model, *args, **kwargs)

    core.load_module = load


def _engine(hardware: Any, robot_type: str, deck_type: str, api_level: Any) -> Any:
    from opentrons.protocol_engine import Config, DeckType, error_recovery_policy
    from opentrons.protocol_engine.create_protocol_engine import create_protocol_engine_in_thread
    from opentrons.protocol_engine.types import PostRunHardwareState
    from opentrons.protocols.api_support.deck_type import (
        should_load_fixed_trash_labware_for_python_protocol,
    )

    config = Config(
        robot_type=robot_type,
        deck_type=DeckType(deck_type),
        ignore_pause=True,
        use_virtual_pipettes=True,
        use_virtual_modules=True,
        use_virtual_gripper=True,
        use_simulated_deck_config=True,
    )
    parts = {
        "hardware_api": hardware.wrapped(),
        "config": config,
        "deck_configuration": None,
        "file_provider": None,  # from 8.2 on
        "error_recovery_policy": error_recovery_policy.never_recover,
        "drop_tips_after_run": False,
        "post_run_hardware_state": PostRunHardwareState.STAY_ENGAGED_IN_PLACE,
        "load_fixed_trash": should_load_fixed_trash_labware_for_python_protocol(api_level),
    }
    known = inspect.signature(create_protocol_engine_in_thread).parameters
    return create_protocol_engine_in_thread(
        **{name: part for name, part in parts.items() if name in known}
    )


async def _add(engine: Any, definitions: Mapping[str, Any]) -> None:
    from opentrons_shared_data.labware import labware_definition

    adapter = getattr(labware_definition, "labware_definition_type_adapter", None)
    for definition in definitions.values():
        if not isinstance(definition, Mapping):
            parsed: Any = definition
        elif adapter is not None:
            parsed = adapter.validate_python(definition)
        else:  # before 8.3, with either version of pydantic
            model = labware_definition.LabwareDefinition
            parsed = (getattr(model, "model_validate", None) or model.parse_obj)(definition)
        engine.add_labware_definition(parsed)
