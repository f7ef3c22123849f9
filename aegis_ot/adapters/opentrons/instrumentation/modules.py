"""What the modules on the deck are told to do: shaking, lids, temperatures, magnets, stackers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_STACKER = ("retrieve", "store", "fill", "fill_items", "empty")
_METHODS = (
    "set_and_wait_for_shake_speed",
    "set_shake_speed",
    "open_labware_latch",
    "close_labware_latch",
    "open_lid",
    "close_lid",
    "engage",
    "engage_to_labware",
    "disengage",
    "set_target_temperature",
    "wait_for_target_temperature",
    "set_target_block_temperature",
    "start_set_target_block_temperature",
    "wait_for_block_temperature",
    "set_target_lid_temperature",
    "start_set_target_lid_temperature",
    "wait_for_lid_temperature",
    "execute_profile",
    "start_execute_profile",
    "deactivate",
    "deactivate_lid",
    "deactivate_block",
    "deactivate_heater",
    "deactivate_shaker",
    *_STACKER,
)

MODULE_ACTIONS: Mapping[str, str] = {
    **{name: name.replace("_", " ") for name in _METHODS},
    # In words that do not speak of shaking: whoever reads them looks for a plate that was shaken.
    "deactivate_shaker": "stop moving",
}
"""From a module core's methods to the words for them."""


def action_text(name: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> str:
    """What is done, with its numbers: ``"set and wait for shake speed 500"``."""
    numbers = [
        f"{value:g}"
        for value in (*args, *kwargs.values())
        if isinstance(value, (int, float)) and not isinstance(value, bool)
    ]
    return " ".join([MODULE_ACTIONS[name], *numbers])


def carried_by(protocol_core: Any, module_core: Any) -> Any:
    """The topmost labware on a module: the plate, not the adapter under it. ``None`` if bare."""
    found = protocol_core.get_labware_on_module(module_core)
    while found is not None and hasattr(found, "is_adapter") and found.is_adapter():
        above = protocol_core.get_labware_on_labware(found)
        if above is None:
            break
        found = above
    return found
