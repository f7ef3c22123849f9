"""Which labware stands where in the commands of an analysis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

Place = tuple[str, str]
"""Definition (``"opentrons/corning_96_wellplate_360ul_flat/2"``) and slot of a labware."""


def places_of(commands: Iterable[Mapping[str, Any]]) -> Iterator[Place]:
    """Where the labware of an analysis, or of a run, stands in turn; off the deck left out."""
    slots: dict[str, str] = {}
    uris: dict[str, str] = {}
    for command in commands:
        kind, params = command.get("commandType"), command.get("params") or {}
        result = command.get("result") or {}
        if kind == "loadModule":
            slots[str(result.get("moduleId"))] = slot_of(params.get("location"), slots)
            continue
        if kind == "loadLabware":
            labware, where = str(result.get("labwareId")), params.get("location")
            definition = result.get("definition") or {}
            name = (definition.get("parameters") or {}).get("loadName") or params.get("loadName")
            named = (definition.get(part) or params.get(part) for part in ("namespace", "version"))
            uris[labware] = "{0}/{2}/{1}".format(*named, name)
        elif kind == "moveLabware":
            labware, where = str(params.get("labwareId")), params.get("newLocation")
        else:
            continue
        slots[labware] = slot_of(where, slots)
        if slots[labware] and labware in uris:
            yield uris[labware], slots[labware]


def slot_of(location: Any, slots: Mapping[str, str]) -> str:
    """Where a location is in the end: a slot, or what stands in it."""
    if not isinstance(location, Mapping):
        return ""
    on = location.get("moduleId") or location.get("labwareId")
    named = location.get("slotName") or location.get("addressableAreaName") or ""
    return slots.get(str(on), "") if on else str(named)
