"""What a protocol needs on the deck, against what the robot says is there."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from .places import place_at

_TRASH = re.compile(r"movableTrash([A-D][13])")
_STAGING = re.compile(r"([A-D])4")
_SLOT = re.compile(r"[A-D][1-3]")
_NO_SLOT = {"trashBinAdapter": "a trash bin", "wasteChute": "a waste chute"}
_UNPLUGGED = ("magneticBlock",)
"""Modules without a plug: the robot cannot tell whether they are there."""


class Needs(NamedTuple):
    """What the commands of an analysis use.

    Attributes:
        areas: Slots and other places on the deck, as the robot names them.
        modules: Model and slot of each.
    """

    areas: tuple[str, ...] = ()
    modules: tuple[tuple[str, str], ...] = ()


def needs_of(commands: Iterable[Mapping[str, Any]]) -> Needs:
    """From the commands of an analysis."""
    areas: dict[str, None] = {}
    modules: list[tuple[str, str]] = []
    for command in commands:
        kind, params = command.get("commandType"), command.get("params") or {}
        if kind == "loadModule":
            slot = place_at(params.get("location"), {}).slot
            modules.append((str(params.get("model") or ""), slot))
        elif kind in ("loadLabware", "moveLabware"):
            areas[place_at(params.get("location") or params.get("newLocation"), {}).slot] = None
        elif isinstance(params.get("addressableAreaName"), str):
            areas[params["addressableAreaName"]] = None
    areas.pop("", None)
    return Needs(tuple(areas), tuple(modules))


def lacking(
    needs: Needs, attached: Iterable[Mapping[str, Any]], configured: Mapping[str, str]
) -> list[str]:
    """What is not there, a sentence each; what cannot be told is the robot's to judge.

    Args:
        needs: Of the protocol.
        attached: The modules that are plugged in, as the robot tells them.
        configured: Fixture by cutout; empty where it is not known.
    """
    return [*_modules_lacking(needs, attached), *_fixtures_lacking(needs, configured)]


def _modules_lacking(needs: Needs, attached: Iterable[Mapping[str, Any]]) -> Iterator[str]:
    there = Counter(_kind(str(module.get("moduleModel"))) for module in attached)
    wanted = Counter(_kind(model) for model, _ in needs.modules)
    for kind, count in wanted.items():
        if kind.startswith(_UNPLUGGED) or there[kind] >= count:
            continue
        slots = ", ".join(slot for model, slot in needs.modules if _kind(model) == kind)
        known = f"{there[kind]} of {count} are" if count > 1 else "none is"
        yield f"It uses {kind} in slot {slots}, and {known} connected."


def _kind(model: str) -> str:
    """Both generations of the temperature module serve either."""
    return "temperatureModule" if model.startswith("temperatureModule") else model


def _fixtures_lacking(needs: Needs, configured: Mapping[str, str]) -> Iterator[str]:
    if not configured:
        return
    for area in needs.areas:
        if trash := _TRASH.fullmatch(area):
            if configured.get(f"cutout{trash[1]}") != "trashBinAdapter":
                yield f"It uses a trash bin in {trash[1]}; the robot has none configured there."
        elif "WasteChute" in area:
            if "wasteChute" not in _lowered(configured.get("cutoutD3", "")):
                yield "It uses the waste chute; the robot has none configured in D3."
        elif staging := _STAGING.fullmatch(area):
            fixture = configured.get(f"cutout{staging[1]}3", "")
            if fixture.startswith(("single", "trashBin", "wasteChute")):
                yield f"It uses staging slot {area}; the robot has none configured there."
        elif _SLOT.fullmatch(area):
            fixture = configured.get(f"cutout{area}", "")
            there = next((what for name, what in _NO_SLOT.items() if fixture.startswith(name)), "")
            if there:
                yield f"It puts labware into slot {area}; the robot has {there} configured there."
    for model, slot in needs.modules:
        cutout = "cutoutB1" if model.startswith("thermocycler") else f"cutout{slot}"
        fixture = configured.get(cutout, "")
        if fixture.startswith(("single", "trashBin", "wasteChute")):
            yield f"It uses {model} in slot {slot}; the robot has none configured there."


def _lowered(fixture: str) -> str:
    """``"stagingAreaSlotWithWasteChuteRightAdapterCovered"`` holds a waste chute too."""
    return fixture.replace("WasteChute", "wasteChute")
