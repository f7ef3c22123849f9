"""From the commands of a run to the operations that the keyframes are made of.

An unguarded run tells of nothing but its commands. They are read as the operations that a guard
on the robot would have heard, so that both ways yield the same trajectories.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    Operation,
    OperationKind,
    PipetteInfo,
)
from ..vocabulary import WellRef
from ..workbench.commands import KINDS
from ..workbench.nozzles import Layout, layout_of, whole_head
from .deck import Deck
from .server_answers import Command

_PROBES = ("liquidProbe", "tryLiquidProbe")
_NOT_FOUND = "liquidNotFound"
_INSIDE_MM = -1.0
"""Height over the top of a well where a command says less than that it is inside it."""


class OperationReader:
    """Reads the commands of one run, in order."""

    def __init__(self, deck: Deck) -> None:
        self._deck = deck
        self._at_trash: dict[str, bool] = {}
        self._layouts: dict[str, Layout] = {}
        self._racks: dict[str, tuple[str, str]] = {}
        self._found: bool | None = None

    def operation(self, command: Command) -> Operation | None:
        """What a pipette does by this command; ``None`` if it does nothing with tip or liquid."""
        kind = KINDS.get(command.kind)
        if kind is None:
            self._note(command)
            return None
        params = command.params
        pipette = self._deck.pipette(str(params.get("pipetteId", "")))
        if pipette is None:
            return None
        in_place = "InPlace" in command.kind
        labware, well = str(params.get("labwareId", "")), str(params.get("wellName", ""))
        disposal = self._disposal(pipette, command, labware, in_place)
        layout = self._layouts.get(pipette.key) or whole_head(pipette.channels)
        wells: tuple[WellRef | None, ...] = (None,) * len(layout.nozzles)
        if labware and well and not disposal:
            wells = self._deck.wells(labware, well, layout)
        if kind is OperationKind.PICK_UP_TIP:
            self._racks[pipette.key] = (labware, well)
        return Operation(
            kind=kind,
            pipette=pipette,
            nozzles=layout.nozzles,
            wells=wells,
            disposal=disposal,
            volume=number_of(params.get("volume")),
            from_top=self._height(labware, well, params) if labware and well else None,
            in_place=in_place,
            call=command.kind,
            probes=command.kind in _PROBES,
        )

    def event(self, command: Command) -> Event | None:
        """What else changes the meaning of wells."""
        params = command.params
        if command.kind == "waitForResume":
            return Event(EventKind.PAUSED, text=command.message)
        if command.kind == "moveLabware":
            return Event(EventKind.LABWARE_MOVING, labware=str(params.get("labwareId", "")))
        if command.kind == "loadLiquid":
            labware = str(params.get("labwareId", ""))
            wells = tuple(self._deck.well(labware, name) for name in params["volumeByWell"])
            name = self._deck.liquid(str(params.get("liquidId", "")))
            return Event(EventKind.LIQUID_LOADED, wells=wells, text=name)
        return None

    def capacity(self, operation: Operation) -> float | None:
        """Working volume of the tip that is on now, µL."""
        rack = self._racks.get(operation.pipette.key)
        tip = self._deck.tip_volume(*rack) if rack is not None else None
        return None if tip is None else min(tip, operation.pipette.max_volume)

    def is_done(self, operation: Operation, command: Command) -> bool:
        """Whether ``operation`` was done, now that its command is over.

        A probe that found no liquid was, also where the protocol required some: then the robot
        calls a person, or goes on if its run was told to.
        """
        done = command.status == "succeeded"
        if operation.probes:
            self._found = self._heard(command, done)
            done = done or self._found is False
        return done

    def liquid_found(self, _operation: Operation) -> bool | None:
        """What the last probe that is over said."""
        return self._found

    def _heard(self, command: Command, done: bool) -> bool | None:
        if command.kind == "tryLiquidProbe":
            return self._deck.liquid_found(command.id) if done else None
        if done:
            return True
        return False if command.error_kind == _NOT_FOUND else None

    def _note(self, command: Command) -> None:
        params = command.params
        if command.kind == "configureNozzleLayout":
            pipette = self._deck.pipette(str(params.get("pipetteId", "")))
            if pipette is not None:
                configured: Mapping[str, Any] = params.get("configurationParams") or {}
                self._layouts[pipette.key] = layout_of(configured, pipette.channels)
        elif command.kind == "moveLabware":
            place = params.get("newLocation")
            slot = place.get("slotName", "") if isinstance(place, Mapping) else ""
            self._deck.moved(str(params.get("labwareId", "")), str(slot))

    def _disposal(
        self, pipette: PipetteInfo, command: Command, labware: str, in_place: bool
    ) -> bool:
        if in_place:
            return self._at_trash.get(pipette.key, False)
        area = str(command.params.get("addressableAreaName", ""))
        there = self._deck.is_trash(labware) if labware else "rash" in area or "aste" in area
        self._at_trash[pipette.key] = there
        return there

    def _height(self, labware: str, well: str, params: Mapping[str, Any]) -> float:
        """Of the tip end over the top of the well, mm."""
        location: Mapping[str, Any] = params.get("wellLocation") or {}
        z = number_of((location.get("offset") or {}).get("z"))
        origin = location.get("origin", "top")
        if origin == "top":
            return z
        depth = self._deck.depth(labware, well)
        if depth is None or origin == "meniscus":
            return _INSIDE_MM
        return z - (depth if origin == "bottom" else depth / 2)


def number_of(value: Any) -> float:
    return float(value) if isinstance(value, (int, float)) else 0.0
