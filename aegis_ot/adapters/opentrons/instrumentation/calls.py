"""Reads the arguments of an instrument core's methods into an :class:`Operation`."""

from __future__ import annotations

import functools
import inspect
import weakref
from collections import deque
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ....vocabulary import WellRef
from .callsite import CallSite
from .labware import LabwareInfo
from .operation import Operation, OperationKind, PipetteInfo
from .tip_layers import ROUNDING_UL
from .wells import Nozzles, WellResolver

CORE_METHODS: Mapping[str, OperationKind] = {
    "pick_up_tip": OperationKind.PICK_UP_TIP,
    "drop_tip": OperationKind.DROP_TIP,
    "drop_tip_in_disposal_location": OperationKind.DROP_TIP,
    "aspirate": OperationKind.ASPIRATE,
    "dispense": OperationKind.DISPENSE,
    "blow_out": OperationKind.BLOW_OUT,
    "air_gap_in_place": OperationKind.AIR_GAP,
    "touch_tip": OperationKind.TOUCH_TIP,
    "move_to": OperationKind.MOVE,
    # A probe dips the tip into the liquid: to the tip and the well it is a touch.
    "detect_liquid_presence": OperationKind.TOUCH_TIP,
    "liquid_probe_with_recovery": OperationKind.TOUCH_TIP,
    "liquid_probe_without_recovery": OperationKind.TOUCH_TIP,
    "resin_tip_seal": OperationKind.PICK_UP_TIP,
    "resin_tip_unseal": OperationKind.DROP_TIP,
    # Pressure pushes an unknown amount through the resin, whatever volume is asked for.
    "resin_tip_dispense": OperationKind.TOUCH_TIP,
}

_PROBES = frozenset(name for name in CORE_METHODS if "liquid_p" in name)
_EMPTYING = frozenset({OperationKind.PICK_UP_TIP, OperationKind.DROP_TIP, OperationKind.BLOW_OUT})
_DISPOSALS = frozenset({"TrashBin", "WasteChute"})
_RECENT = 4


class CallReader:
    """Reads the calls of one instrument core; remembers where its last operations went.

    Attributes:
        busy: Whether an operation is under way; calls from inside it are not read.
    """

    def __init__(self, core: Any, pipette: PipetteInfo, wells: WellResolver) -> None:
        self._core = core
        self._core_type: Any = type(core)
        self._weak_core = weakref.ref(core)
        self._pipette = pipette
        self._wells = wells
        self._move_to = core.move_to
        self._targets: deque[tuple[Operation, Any, Any]] = deque(maxlen=_RECENT)
        self._nozzles: Nozzles | None = None
        self._counts_below_none = not hasattr(core, "pipette_id")
        self._below = 0.0
        self.busy = False

    def read(
        self, name: str, args: tuple[Any, ...], kwargs: Mapping[str, Any], site: CallSite
    ) -> Operation | None:
        """The operation that this call is, or ``None`` if the call cannot be understood.

        A call with wrong arguments is left to Opentrons, which has an error for it.
        """
        values = dict(zip(_parameters(self._core_type, name), args, strict=False))
        values.update(kwargs)
        try:
            return self._operation(name, values, site)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            return None

    def set_anew(self) -> None:
        """The pipette was set for other volumes."""
        self._pipette = replace(self._pipette, min_volume=least_volume(self._core))

    def move_above(self, operation: Operation) -> None:
        """Move to the top of the first well of a recent operation, unheard by listeners.

        Nothing moves where the operation was not aimed at a well.
        """
        for recent, location, well_core in reversed(self._targets):
            if recent is operation and well_core is not None:
                self._move(location, well_core)
                return

    def _move(self, location: Any, well_core: Any) -> None:
        top = type(location)(well_core.get_top(z_offset=0), location.labware)
        self.busy = True
        try:
            self._move_to(
                top, well_core=well_core, force_direct=False, minimum_z_height=None, speed=None
            )
        finally:
            self.busy = False

    def _operation(self, name: str, values: dict[str, Any], site: CallSite) -> Operation:
        kind = CORE_METHODS[name]
        if kind is OperationKind.ASPIRATE and site.call == "air_gap":
            kind = OperationKind.AIR_GAP  # before apiLevel 2.22 an air gap is an aspirate
        location = values.get("location", values.get("loc", values.get("disposal_location")))
        well_core = values.get("well_core")
        if well_core is None:
            well_core = _well_core_of(location) or _well_core_below(location)
        nozzles = self._nozzles = Nozzles.of(self._core, self._nozzles)
        wells: tuple[WellRef | None, ...] = (None,) * len(nozzles.names)
        disposal = name == "drop_tip_in_disposal_location" or type(location).__name__ in _DISPOSALS
        from_top = from_bottom = None
        if well_core is not None:
            info = self._wells.info_of(well_core)
            if info.is_trash:
                disposal = True
            else:
                target = str(well_core.get_name())
                several = len(nozzles.names) > 1
                aside = self._aside(values, location, info, target, well_core, several)
                wells = self._wells.covered(info, target, nozzles, aside)
                from_top = self._height(name, values, location, info, target, well_core)
                if from_top is not None:
                    from_bottom = from_top + info.wells[target].depth
        volume, written = self._volumes(kind, values, site.volume)
        operation = Operation(
            kind=kind,
            pipette=self._pipette,
            nozzles=nozzles.names,
            wells=wells,
            disposal=disposal,
            volume=volume,
            written=written,
            lead=nozzles.lead,
            from_top=from_top,
            from_bottom=from_bottom,
            from_liquid=0.0 if name in _PROBES else _over_liquid(values),
            position=_position(location),
            in_place=bool(values.get("in_place", False)),
            line=site.line,
            lines=site.lines,
            call=site.call,
            mixing=site.mixing,
            probes=name in _PROBES,
            core=self._weak_core,
            method=name,
            arguments=values,
        )
        aimed = getattr(getattr(location, "labware", None), "is_well", False) and not disposal
        self._targets.append((operation, location, well_core if aimed else None))
        return operation

    def _volumes(
        self, kind: OperationKind, values: Mapping[str, Any], asked: Any
    ) -> tuple[float, float | None]:
        """The volume that moves, and the one that is written if that is another."""
        if kind is OperationKind.TOUCH_TIP:
            return 0.0, None
        volume = float(values.get("volume") or 0.0)
        if kind in _EMPTYING:
            self._below = 0.0
        elif kind is OperationKind.DISPENSE or self._counts_below_none:
            # Older apiLevels clamp a dispense to what is in the tip, air included. The oldest ones'
            # simulator does not: it counts below nothing, and so short until the tip is emptied.
            count = float(self._core.get_current_volume() or 0.0)
            self._below = min(self._below, count)
            held = count - self._below
            if kind is OperationKind.DISPENSE and volume > held + ROUNDING_UL:
                return (held if held > ROUNDING_UL else volume), volume
        # They take 0 for "as much as there is room for", or as there is in the tip.
        return volume, 0.0 if asked == 0 and volume > 0 else None

    def _aside(
        self,
        values: Mapping[str, Any],
        location: Any,
        info: LabwareInfo,
        target: str,
        well_core: Any,
        several: bool,
    ) -> tuple[float, float]:
        point = getattr(location, "point", None)
        if values.get("meniscus_tracking") is not None or not hasattr(point, "x"):
            return (0.0, 0.0)  # a place by the meniscus is no place on the deck
        return self._wells.aside(info, target, well_core, point, several)

    def _height(
        self,
        name: str,
        values: Mapping[str, Any],
        location: Any,
        info: LabwareInfo,
        target: str,
        well_core: Any,
    ) -> float | None:
        if name == "touch_tip":
            return float(values["z_offset"])
        if name in _PROBES:
            return -0.1  # it goes down until it meets the liquid: inside, how deep is unknown
        if values.get("meniscus_tracking") is not None:
            return None
        point = getattr(location, "point", None)
        if point is None or not isinstance(getattr(point, "z", None), (int, float)):
            return None
        return round(float(point.z) - self._wells.top_of(info, target, well_core), 3)


def least_volume(core: Any) -> float:
    """The least that a pipette is made to move as it is set now, µL; 0 if unknown."""
    return float(core.get_min_volume()) if hasattr(core, "get_min_volume") else 0.0


@functools.cache
def _parameters(core_type: type, name: str) -> tuple[str, ...]:
    """Names of the arguments of a core's method, after ``self``."""
    return tuple(inspect.signature(getattr(core_type, name)).parameters)[1:]


def _well_core_of(location: Any) -> Any:
    labware = getattr(location, "labware", None)
    if labware is not None and getattr(labware, "is_well", False):
        return labware.as_well()._core
    return None


def _well_core_below(location: Any) -> Any:
    """The well that a point of a labware lies in, seen from above."""
    labware = getattr(location, "labware", None)
    if labware is None or not getattr(labware, "is_labware", False):
        return None
    point = location.point
    for well in labware.as_labware().wells():
        top = well.top().point
        reach_x = (well.diameter or well.length) / 2
        reach_y = (well.diameter or well.width) / 2
        if abs(top.x - point.x) <= reach_x and abs(top.y - point.y) <= reach_y:
            return well._core
    return None


def _over_liquid(values: Mapping[str, Any]) -> float | None:
    """Height over the liquid that the call leaves behind; the level before it is another."""
    for place, tracking in (
        ("end_location", "end_meniscus_tracking"),
        ("location", "meniscus_tracking"),
    ):
        if getattr(values.get(tracking), "value", None) == "end":
            return float(values[place].point.z)
    return None


def _position(location: Any) -> tuple[float, float, float] | None:
    point = getattr(location, "point", None)
    try:
        return (float(point.x), float(point.y), float(point.z))  # type: ignore[union-attr]
    except (AttributeError, TypeError, ValueError):
        return None
