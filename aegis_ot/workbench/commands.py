"""From the commands of a robot's software to what a rehearsal records: a producer beside the tap.

An analysis, a run, and what a Protocol Designer file turns into, are lists of Opentrons' commands.
They have no source lines: the number of a command, from 1, stands where a line does.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ..adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    Operation,
    OperationKind,
    PipetteInfo,
)
from ..adapters.opentrons.instrumentation.labware_definitions import describe
from ..adapters.opentrons.instrumentation.modules import MODULE_ACTIONS
from ..adapters.opentrons.instrumentation.wells import wells_under
from ..adapters.opentrons.rehearsal import Recorder, Recording
from ..vocabulary import WellRef
from ..vocabulary.pipette_names import channels_of, largest_volume, least_volume
from .nozzles import Layout, layout_of, offsets_of, whole_head

KINDS = {
    "pickUpTip": OperationKind.PICK_UP_TIP,
    "dropTip": OperationKind.DROP_TIP,
    "dropTipInPlace": OperationKind.DROP_TIP,
    "unsafe/dropTipInPlace": OperationKind.DROP_TIP,
    "aspirate": OperationKind.ASPIRATE,
    "aspirateInPlace": OperationKind.ASPIRATE,
    "aspirateWhileTracking": OperationKind.ASPIRATE,
    "dispense": OperationKind.DISPENSE,
    "dispenseInPlace": OperationKind.DISPENSE,
    "dispenseWhileTracking": OperationKind.DISPENSE,
    "blowout": OperationKind.BLOW_OUT,
    "blowOutInPlace": OperationKind.BLOW_OUT,
    "airGapInPlace": OperationKind.AIR_GAP,
    "touchTip": OperationKind.TOUCH_TIP,
    "moveToWell": OperationKind.MOVE,
    "moveToAddressableArea": OperationKind.MOVE,
    "moveToAddressableAreaForDropTip": OperationKind.MOVE,
    "moveToCoordinates": OperationKind.MOVE,
    "liquidProbe": OperationKind.MOVE,
    "tryLiquidProbe": OperationKind.MOVE,
}
"""What a pipette does by each command."""

_TRASH = re.compile(r"trash|waste", re.IGNORECASE)
_SLOT = re.compile(r"[A-D][1-4]|1?\d")
_HUMPS = re.compile(r"(?<=[a-z])(?=[A-Z])")
_MODULES = {
    "run profile": "execute profile",
    "deactivate shaker": "stop moving",
    "wait for temperature": "wait for target temperature",
}
_PROBED_MM = -0.1
"""Over the top of its well: where a probe finds liquid is not told."""
_LOADS_LABWARE = ("loadLabware", "loadLid", "flexStacker/retrieve")

Place = tuple[str, str, Mapping[str, Any]]
"""Labware and well that a pipette is at, and where in the well; the labware may be an area's."""


def recording_of(document: Mapping[str, Any], file_name: str) -> tuple[Recording, tuple[str, ...]]:
    """What was recorded, and a line of text for each command.

    Args:
        document: ``commands`` with their results, ``liquids``, ``labware``, as
            ``opentrons analyze --json-output`` writes them.
        file_name: Of the file.

    Raises:
        KeyError, TypeError, ValueError: It is not written so.
    """
    reader = _CommandReader(document)
    lines = [reader.read(number, one) for number, one in enumerate(document["commands"], 1)]
    metadata = document.get("metadata") or {}
    values = {
        str(one["variableName"]): one["value"]
        for one in document.get("runTimeParameters") or ()
        if isinstance(one.get("value"), (int, float, str)) and not isinstance(one["value"], bool)
    }
    recorder = reader.recorder
    recording = Recording(
        file_name,
        f"metadata = {dict(metadata)!r}\n" if metadata else "",
        mixes_marked(recorder.log),
        dict(reader.labware),
        parameters=values,
    )
    return recording, tuple(lines)


def mixes_marked(log: Sequence[Any]) -> list[Any]:
    """An aspirate that the next operation gives back to the same wells is a mix."""
    marked = list(log)
    for n, (first, second) in enumerate(itertools.pairwise(log)):
        if (
            isinstance(first, Operation)
            and isinstance(second, Operation)
            and first.kind is OperationKind.ASPIRATE
            and second.kind is OperationKind.DISPENSE
            and (first.pipette.key, first.wells) == (second.pipette.key, second.wells)
            and first.volume == second.volume
            and first.well is not None
        ):
            marked[n] = replace(first, mixing=True, call="mix")
            marked[n + 1] = replace(second, mixing=True, call="mix")
    return marked


class _CommandReader:
    def __init__(self, document: Mapping[str, Any]) -> None:
        config = document.get("config") or {}
        level = tuple(config.get("apiVersion") or (2, 14))
        # Commands of the older apiLevels are made up afterwards, and tell no heights.
        self._tells_heights = level >= (2, 14)
        self._liquids = {str(one["id"]): one for one in document.get("liquids") or ()}
        self._pipettes: dict[str, PipetteInfo] = {}
        self._layouts: dict[str, Layout] = {}
        self._at: dict[str, Place] = {}
        self._keys: dict[str, str] = {}
        self._locations: dict[str, Any] = {}
        self._used: set[WellRef] = set()
        self._tips: dict[str, set[WellRef]] = {}
        self.recorder = Recorder()
        self.labware: dict[str, LabwareInfo] = {}

    def read(self, number: int, command: Mapping[str, Any]) -> str:
        """Take in one command; what it does, in words."""
        name = str(command["commandType"])
        params, result = command.get("params") or {}, command.get("result") or {}
        done = command.get("status", "succeeded") == "succeeded"
        kind = KINDS.get(name)
        words = name
        if kind is not None:
            operation = self._operation(number, name, kind, params, result)
            words = _told(name, operation)
            if done:
                self._renewed(number, operation)
                self.recorder.after(operation)
        elif done or name == "waitForResume":
            for event in self._events(number, name, params, result):
                self.recorder.event(event)
                words = " ".join(filter(None, (name, event.text)))
        return words if done else f"{words} (failed)"

    def _operation(
        self,
        number: int,
        name: str,
        kind: OperationKind,
        params: Mapping[str, Any],
        result: Mapping[str, Any],
    ) -> Operation:
        pipette = self._pipettes[str(params["pipetteId"])]
        if "Probe" in name:  # it dips the tip into the liquid
            kind = OperationKind.TOUCH_TIP
        if "InPlace" not in name:
            area = str(params.get("addressableAreaName") or params.get("labwareId") or "")
            well, where = str(params.get("wellName", "")), params.get("wellLocation") or {}
            self._at[pipette.key] = (area, well, where)
        place = self._at.get(pipette.key, ("", "", {}))
        info = self.labware.get(self._keys.get(place[0], ""))
        disposal = bool(_TRASH.search(place[0])) or (info is not None and info.is_trash)
        if place[1] and info is None and not disposal:
            raise ValueError(f"command {number} names labware that no command before it loads")
        layout = self._layouts.get(pipette.key) or whole_head(pipette.channels)
        wells: tuple[WellRef | None, ...] = (None,) * len(layout.nozzles)
        height: float | None = None
        if info is not None and not disposal and place[1] in info.wells:
            names = wells_under(info, place[1], offsets_of(layout))
            wells = tuple(None if one is None else self._ref(info.key, one) for one in names)
            height = self._height(info, place)
        if "Probe" in name and height is not None:
            height = _PROBED_MM
        at = result.get("position") or {}
        depth = info.wells[place[1]].depth if info and height is not None else 0.0
        return Operation(
            kind=kind,
            pipette=pipette,
            nozzles=layout.nozzles,
            wells=wells,
            disposal=disposal,
            volume=float(params.get("volume") or 0.0),
            from_top=height,
            from_bottom=None if height is None else height + depth,
            from_liquid=0.0 if "Probe" in name else _over_liquid(place[2]),
            position=(at["x"], at["y"], at["z"]) if at else None,
            in_place="InPlace" in name,
            line=number,
            lines=(number,),
            call=kind.value,
            lead=layout.nozzles.index(layout.primary) if layout.primary in layout.nozzles else 0,
            probes="Probe" in name,
        )

    def _height(self, info: LabwareInfo, place: Place) -> float | None:
        """Of the tip end over the top of the well, mm; ``None`` where it is not told."""
        origin = place[2].get("origin", "top")
        z = float((place[2].get("offset") or {}).get("z") or 0.0)
        depth = info.wells[place[1]].depth
        if not self._tells_heights or origin not in ("top", "bottom", "center"):
            return None
        return z - {"top": 0.0, "bottom": depth, "center": depth / 2}[origin]

    def _renewed(self, number: int, operation: Operation) -> None:
        """A tip that is taken where none was left: a person has put in a new rack."""
        taken = {well for well in operation.wells if well is not None}
        key = operation.pipette.key
        if operation.kind is OperationKind.PICK_UP_TIP:
            if taken & self._used:
                racks = {well.labware for well in taken}
                self._used = {well for well in self._used if well.labware not in racks}
                for rack in sorted(racks):
                    self.recorder.event(Event(EventKind.TIPS_RESET, number, rack))
            self._used |= taken
            self._tips[key] = taken
        elif operation.kind is OperationKind.DROP_TIP:
            self._used -= taken & self._tips.pop(key, set())

    def _events(
        self, number: int, name: str, params: Mapping[str, Any], result: Mapping[str, Any]
    ) -> Iterator[Event]:
        labware = str(result.get("labwareId") or params.get("labwareId") or "")
        if name == "loadPipette":
            self._load_pipette(params, result)
        elif name == "configureNozzleLayout":
            pipette = self._pipettes[str(params["pipetteId"])]
            configured = params.get("configurationParams") or {}
            self._layouts[pipette.key] = layout_of(configured, pipette.channels)
        elif name == "loadModule":
            self._locations[str(result.get("moduleId"))] = params.get("location")
        elif name in _LOADS_LABWARE and result.get("definition"):
            yield self._load_labware(number, labware, params, result)
        elif name == "moveLabware" and labware in self._keys:
            key = self._keys[labware]
            yield Event(EventKind.LABWARE_MOVING, number, key)
            self._locations[labware] = params.get("newLocation")
            yield Event(EventKind.LABWARE_MOVED, number, key, text=self._slot(labware))
        elif name == "loadLiquid" and labware in self._keys:
            liquid = self._liquids.get(str(params.get("liquidId")), {})
            for well, volume in params["volumeByWell"].items():
                if volume == "empty":
                    continue
                yield Event(
                    EventKind.LIQUID_LOADED,
                    number,
                    self._keys[labware],
                    (self._ref(self._keys[labware], well),),
                    text=str(liquid.get("displayName", "")),
                    volume=float(volume),
                    description=str(liquid.get("description") or ""),
                )
        elif name in ("waitForResume", "pause"):
            yield Event(EventKind.PAUSED, number, text=str(params.get("message") or ""))
        elif name == "comment":
            yield Event(EventKind.COMMENT, number, text=str(params.get("message") or ""))
        elif "/" in name:
            yield from self._module(number, name, params)

    def _load_pipette(self, params: Mapping[str, Any], result: Mapping[str, Any]) -> None:
        name, mount = str(params["pipetteName"]), str(params["mount"])
        identifier = str(result.get("pipetteId") or params.get("pipetteId"))
        most, least = largest_volume(name), least_volume(name)
        self._pipettes[identifier] = PipetteInfo(mount, name, mount, channels_of(name), most, least)

    def _load_labware(
        self, number: int, labware: str, params: Mapping[str, Any], result: Mapping[str, Any]
    ) -> Event:
        self._locations[labware] = params.get("location")
        key = self._keys[labware] = f"labware-{len(self._keys) + 1}"
        info = self.labware[key] = replace(
            describe(result["definition"]),
            key=key,
            label=str(params.get("displayName") or ""),
            slot=self._slot(labware),
        )
        return Event(EventKind.LABWARE_LOADED, number, key, text=info.slot, labware_info=info)

    def _module(self, number: int, name: str, params: Mapping[str, Any]) -> Iterator[Event]:
        action = _HUMPS.sub(" ", name.partition("/")[2]).lower()
        action = _MODULES.get(action, action)
        if action not in MODULE_ACTIONS.values():
            return
        numbers = [f"{one:g}" for one in params.values() if type(one) in (int, float)]
        key = self._keys.get(self._on(str(params.get("moduleId", ""))), "")
        yield Event(EventKind.MODULE, number, key, text=" ".join([action, *numbers]))

    def _on(self, place: str) -> str:
        """The topmost labware on a module or labware; itself if nothing is on it."""
        for labware, location in self._locations.items():
            if isinstance(location, Mapping) and place in location.values() and place:
                return self._on(labware)
        return place

    def _slot(self, identifier: str) -> str:
        """Of the deck, where a labware stands, on whatever it stands; ``""`` off deck."""
        location = self._locations.get(identifier)
        if not isinstance(location, Mapping):
            return ""
        below = location.get("moduleId") or location.get("labwareId")
        if below:
            return self._slot(str(below))
        slot = str(location.get("slotName") or location.get("addressableAreaName") or "")
        return slot if _SLOT.fullmatch(slot) else ""  # as of what the gripper drops into the chute

    def _ref(self, key: str, well: str) -> WellRef:
        info = self.labware[key]
        labware = next(one for one, known in self._keys.items() if known == key)
        return WellRef(key, well, info.label or info.display_name, self._slot(labware))


def _over_liquid(where: Mapping[str, Any]) -> float | None:
    if where.get("origin") != "meniscus":
        return None
    return float((where.get("offset") or {}).get("z") or 0.0)


def _told(name: str, operation: Operation) -> str:
    volume = f" {operation.volume:g} µL" if operation.volume else ""
    place = "trash" if operation.disposal else str(operation.well or "")
    others = sum(well is not None for well in operation.wells) - 1
    more = f" and {others} more" if others > 0 else ""
    return f"{name}{volume}{': ' if place else ''}{place}{more}"
