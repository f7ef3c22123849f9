"""From Opentrons' labware and well cores to :class:`WellRef`, nozzle by nozzle.

Two kinds of core exist: the engine's (apiLevel 2.14 and newer), which know their labware by an
identifier, and the legacy ones, which hold their geometry themselves. Here is the one place
that knows both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ....vocabulary import WellRef
from .labware import LabwareInfo
from .labware_definitions import describe

_NOZZLE_PITCH_MM = 9.0
_SLACK_MM = 0.6
"""A nozzle this far outside a well's rim still counts as over it (calibration offsets)."""
_BESIDE_MM = 2.0
"""A point so far outside the rim is not meant for that well: walls are touched with less."""


@dataclass(frozen=True, eq=False)
class Nozzles:
    """The active nozzles of a pipette, and where they are from the one that leads.

    Read anew for each operation, so the one at hand is kept as long as it holds; told apart by
    identity, which is quick.

    Attributes:
        names: ``("A1", ..., "H1")``.
        offsets: Deck x and y from the nozzle that is aimed at the target well, mm.
    """

    names: tuple[str, ...]
    offsets: tuple[tuple[float, float], ...]
    source: Any = None
    """Opentrons' own map, which is another one after each change."""
    lead: int = 0
    """Which of them is aimed at the target well."""

    @classmethod
    def of(cls, core: Any, known: Nozzles | None = None) -> Nozzles:
        """Read the active nozzles of an instrument core; ``known`` if they are still the same."""
        nozzle_map = _nozzle_map(core)
        if known is not None and known.source is nozzle_map:
            return known
        if nozzle_map is None:
            count = int(core.get_channels())
            names = tuple(f"{chr(ord('A') + row)}1" for row in range(count))
            return cls(names, tuple((0.0, -_NOZZLE_PITCH_MM * row) for row in range(count)))
        points = nozzle_map.map_store
        lead = points[nozzle_map.starting_nozzle]
        offsets = tuple((point.x - lead.x, point.y - lead.y) for point in points.values())
        names = tuple(points)
        return cls(names, offsets, nozzle_map, names.index(nozzle_map.starting_nozzle))


def _nozzle_map(core: Any) -> Any:
    try:
        nozzle_map = core.get_nozzle_map()
    except Exception:  # the legacy cores refuse it, each version in its own way
        return None
    return nozzle_map if hasattr(nozzle_map, "map_store") else None


class WellResolver:
    """Names the labware and wells of one protocol run.

    Labware get keys in the order in which the run first shows them, so that a rehearsal and
    the live run that follows it give the same labware the same key.
    """

    def __init__(self, protocol_core: Any) -> None:
        self._engine_state: Any = getattr(
            getattr(protocol_core, "_engine_client", None), "state", None
        )
        self._keys: dict[Any, str] = {}
        self._slots: dict[str, str] = {}
        self._covered: dict[tuple[Any, ...], tuple[WellRef | None, ...]] = {}
        self._refs: dict[tuple[str, str], WellRef] = {}
        self._tops: dict[tuple[str, str], Any] = {}
        self._descriptions: dict[int, tuple[Any, LabwareInfo]] = {}
        self.labware: dict[str, LabwareInfo] = {}

    def register(self, labware_core: Any) -> LabwareInfo:
        """Take in a labware core, or find it again."""
        identity = getattr(labware_core, "labware_id", None) or labware_core
        key = self._keys.get(identity)
        if key is None:
            key = self._keys[identity] = f"labware-{len(self._keys) + 1}"
            self._slots[key] = self._slot_of(labware_core)
            self.labware[key] = replace(
                self._described(labware_core),
                key=key,
                label=str(labware_core.get_user_display_name() or ""),
                slot=self._slots[key],
            )
        return self.labware[key]

    def _described(self, labware_core: Any) -> LabwareInfo:
        """What a definition says, worked out once for all labware of one kind."""
        labware_id = getattr(labware_core, "labware_id", None)
        if labware_id is None:
            return describe(labware_core.get_definition())
        definition = self._engine_state.labware.get_definition(labware_id)
        if id(definition) not in self._descriptions:
            # opentrons before 8.3, on many an OT-2, has pydantic 1.
            plain = getattr(definition, "model_dump", None) or definition.dict
            described = describe(plain(exclude_none=True))
            self._descriptions[id(definition)] = (definition, described)
        return self._descriptions[id(definition)][1]

    def knows(self, labware_core: Any) -> bool:
        """Whether a labware core was registered before."""
        return (getattr(labware_core, "labware_id", None) or labware_core) in self._keys

    def key_of_id(self, labware_id: str) -> str:
        """The key of an engine labware identifier, taken in if it was never seen before."""
        return (
            self._keys.get(labware_id)
            or self.register(_EngineLabware(labware_id, self._engine_state)).key
        )

    def moved(self, labware_core: Any) -> LabwareInfo:
        """Read again where a labware stands, and all that stand on it."""
        info = self.register(labware_core)
        self._refs.clear()
        self._covered.clear()
        self.forget_heights()
        self._slots[info.key] = self._slot_of(labware_core)
        return info

    def slot(self, key: str) -> str:
        """Where the labware with this key stands now; ``""`` off deck."""
        return self._slots[key]

    def ref(self, key: str, name: str) -> WellRef:
        """The reference to one well as it stands now."""
        ref = self._refs.get((key, name))
        if ref is None:
            info = self.labware[key]
            ref = WellRef(key, name, info.label or info.display_name, self._slots[key])
            self._refs[(key, name)] = ref
        return ref

    def covered(
        self,
        info: LabwareInfo,
        target: str,
        nozzles: Nozzles,
        aside: tuple[float, float] = (0.0, 0.0),
    ) -> tuple[WellRef | None, ...]:
        """The well at each nozzle when the leading one is aimed at the well ``target``.

        Args:
            info: The labware.
            target: Name of the well.
            nozzles: The active ones.
            aside: How far from the middle of the well the leading one is sent, mm.
        """
        cache_key = (info.key, target, nozzles, aside)
        refs = self._covered.get(cache_key)
        if refs is None:
            names = wells_under(info, target, nozzles.offsets, aside)
            refs = tuple(None if name is None else self.ref(info.key, name) for name in names)
            self._covered[cache_key] = refs
        return refs

    def info_of(self, well_core: Any) -> LabwareInfo:
        """The labware that a well core belongs to."""
        labware_id = getattr(well_core, "labware_id", None)
        if labware_id is None:
            return self.register(well_core.geometry.parent)
        return self.labware[self.key_of_id(labware_id)]

    def top_of(self, info: LabwareInfo, name: str, well_core: Any) -> float:
        """Height of a well's top on the deck, mm."""
        return float(self._top(info, name, well_core).z)

    def aside(
        self, info: LabwareInfo, name: str, well_core: Any, point: Any, several: bool
    ) -> tuple[float, float]:
        """How far beside a well a point lies, x and y, mm; 0 if it is over the well.

        ``well.top().move(Point(y=36))`` takes a pipette with half its tips to another row. In a
        well so wide that ``several`` nozzles may find room, each place in it is another one.
        """
        top, well = self._top(info, name, well_core), info.wells[name]
        x, y = round(float(point.x - top.x), 2), round(float(point.y - top.y), 2)
        if not (x or y):
            return (0.0, 0.0)  # nearly always
        wide = several and not info.centers_channels
        reach_x, reach_y = (
            _SLACK_MM if wide and size > _NOZZLE_PITCH_MM else size / 2 + _BESIDE_MM
            for size in (well.diameter or well.x_size or 0.0, well.diameter or well.y_size or 0.0)
        )
        return (x, y) if abs(x) > reach_x or abs(y) > reach_y else (0.0, 0.0)

    def _top(self, info: LabwareInfo, name: str, well_core: Any) -> Any:
        """The middle of a well's top on the deck. Kept, since the engine reckons it anew."""
        top = self._tops.get((info.key, name))
        if top is None:
            top = self._tops[(info.key, name)] = well_core.get_top(z_offset=0)
        return top

    def forget_heights(self) -> None:
        """A labware stands elsewhere, or its offset is another one."""
        self._tops.clear()

    def _slot_of(self, labware_core: Any) -> str:
        labware_id = getattr(labware_core, "labware_id", None)
        try:
            if labware_id is not None:
                slot = self._engine_state.geometry.get_ancestor_slot_name(labware_id)
                return str(getattr(slot, "id", slot))
            return str(labware_core.get_geometry().parent.labware.first_parent() or "")
        except Exception:  # off deck, in the gripper, on a stack: no slot to name
            return ""


class _EngineLabware:
    """Answers for a labware core, of a labware that is seen first through its wells."""

    def __init__(self, labware_id: str, state: Any) -> None:
        self.labware_id = labware_id
        self._state = state

    def get_user_display_name(self) -> Any:
        return self._state.labware.get_user_specified_display_name(self.labware_id)


def wells_under(
    info: LabwareInfo,
    target: str,
    offsets: Sequence[tuple[float, float]],
    aside: tuple[float, float] = (0.0, 0.0),
) -> tuple[str | None, ...]:
    """The name of the well under each nozzle, of which the leading one is aimed at ``target``.

    Args:
        info: The labware.
        target: Name of a well.
        offsets: Where the nozzles are from the leading one, x and y, mm.
        aside: How far from the middle of the well that is sent, mm.
    """
    aim = info.wells[target]
    shift_x = shift_y = 0.0
    if info.centers_channels and len(offsets) > 1:
        # The pipette's middle, not its leading nozzle, goes to the middle of the well.
        shift_x = sum(x for x, _ in offsets) / len(offsets)
        shift_y = sum(y for _, y in offsets) / len(offsets)
    return tuple(
        target
        if (x, y) == (shift_x, shift_y) and not any(aside)
        else _well_at(info, aim.x + x - shift_x + aside[0], aim.y + y - shift_y + aside[1])
        for x, y in offsets
    )


def _well_at(info: LabwareInfo, x: float, y: float) -> str | None:
    # Nozzles stand as far apart as wells, so nearly always over a well's middle.
    if (name := info.middles.get((round(x, 2), round(y, 2)))) is not None:
        return name
    for name, well in info.wells.items():
        if well.diameter is not None:
            reach = well.diameter / 2 + _SLACK_MM
            if (well.x - x) ** 2 + (well.y - y) ** 2 <= reach**2:
                return name
        elif (
            abs(well.x - x) <= (well.x_size or 0.0) / 2 + _SLACK_MM
            and abs(well.y - y) <= (well.y_size or 0.0) / 2 + _SLACK_MM
        ):
            return name
    return None
