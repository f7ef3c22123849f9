"""A rehearsal as a page plays it: what stands on the deck, and every step, as plain small values.

The page itself follows what wells and tips hold, so thousands of steps stay small: wells are
numbered through all labware, and steps that take the same nozzles to the same wells name them once.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    Operation,
    OperationKind,
    WellInfo,
)
from ..preflight import Interpretation, Report
from ..preflight.trace import Trace, Well
from ..vocabulary import Site, WellRef

NOWHERE = -1
"""Stands for the well of a nozzle that is over none."""

_KINDS = {
    OperationKind.PICK_UP_TIP: "pick",
    OperationKind.DROP_TIP: "drop",
    OperationKind.ASPIRATE: "draw",
    OperationKind.DISPENSE: "give",
    OperationKind.BLOW_OUT: "blow",
    OperationKind.AIR_GAP: "air",
    OperationKind.TOUCH_TIP: "touch",
}
_EVENTS = {
    EventKind.PAUSED: "pause",
    EventKind.COMMENT: "say",
    EventKind.MODULE: "module",
    EventKind.LABWARE_MOVED: "move",
    EventKind.TIPS_RESET: "refill",
}


def playback_of(reading: Interpretation, report: Report | None) -> dict[str, Any]:
    """All that a page needs to play a rehearsal.

    ::

        {"shapes": [{"wells": [[name, x, y, width, height, round, capacity µL]]}],
         "labware": [{"name", "slot", "shape", "first", "kind": "tips|trash|wells"}],
         "pipettes": [{"name", "mount", "channels", "max"}],
         "start": [[well, µL or null, liquid, role]], "groups": [[nozzles, wells]],
         "steps": [[kind, line, pipette, µL, group] or [kind, line, labware, text]]}

    ``first`` is the number of the labware's first well; lengths are mm. ``through`` are wells that
    hold nothing. ``numbers`` (of wells, by name) and ``places`` (of steps, in the log) serve
    :func:`marks_of` alone.
    """
    playing = _Playback(reading.recording.labware)
    roles = {} if report is None else {one.well: one.role for one in report.roles}
    playing.start(reading.trace, roles)
    playing.play(reading.trace)
    return playing.values


def marks_of(playback: Mapping[str, Any], sites: Iterable[Site]) -> list[int]:
    """The steps at which something happened, each once and in order.

    A site that names no place in the log is looked for by its line and well. Where these are met
    time and again, as in a loop, nothing tells which time is meant, and no step is marked.
    """
    found = [_step_of(playback, site) for site in sites]
    return list(dict.fromkeys(step for step in found if step is not None))


def _step_of(playback: Mapping[str, Any], site: Site) -> int | None:
    if site.place in playback["places"]:
        return int(playback["places"].index(site.place))
    if site.line is None and site.well is None:
        return None
    number = None
    if (well := site.well) is not None:
        number = playback["numbers"].get(f"{well.labware} {well.name}", NOWHERE - 1)
    first, goes_on = None, False
    for n, (_, line, *more) in enumerate(playback["steps"]):
        wells = playback["groups"][more[2]][1] if len(more) == 3 else ()
        if number is not None and all(one == NOWHERE for one in wells):
            continue  # a step over no well does not part a mix in two
        fits = site.line in (None, line) and (number is None or number in wells)
        if fits and not goes_on and first is not None:
            return None
        first = n if fits and first is None else first
        goes_on = fits
    return first


class _Playback:
    def __init__(self, labware: Mapping[str, LabwareInfo]) -> None:
        self._shapes: dict[Any, int] = {}
        self._pipettes: dict[str, int] = {}
        self._groups: dict[Any, int] = {}
        self._numbers: dict[tuple[str, str], int] = {}
        self._labware = {key: number for number, key in enumerate(labware)}
        self.values: dict[str, Any] = {
            "shapes": [], "labware": [], "pipettes": [], "start": [], "groups": [], "steps": [],
            "through": [], "places": [],
        }  # fmt: skip
        for key, info in labware.items():
            named = {
                "name": info.label or info.display_name or info.load_name,
                "slot": info.slot,
                "shape": self._shape(info.wells),
                "first": len(self._numbers),
                "kind": "trash" if info.is_trash else "tips" if info.is_tip_rack else "wells",
            }
            self.values["labware"].append(named)
            for name in info.wells:
                self._numbers[key, name] = len(self._numbers)
        self.values["numbers"] = {f"{key} {name}": n for (key, name), n in self._numbers.items()}

    def _shape(self, wells: Mapping[str, WellInfo]) -> int:
        drawn = []
        for name, well in wells.items():
            wide, high = (well.diameter or size or 0 for size in (well.x_size, well.y_size))
            middle = round(well.x, 2), round(well.y, 2)
            drawn.append([name, *middle, wide, high, int(bool(well.diameter)), well.max_volume])
        return _numbered(self._shapes, str(drawn), self.values["shapes"], {"wells": drawn})

    def start(self, trace: Trace, roles: Mapping[WellRef, str]) -> None:
        """What stands in the wells before the run: of the plates that are there first."""
        for (_, generation, _), well in trace.wells.items():
            number = self._number(well.ref)
            role = roles.get(well.ref, "")
            if well.runs_through:
                self.values["through"].append(number)
            if generation == 0 and number != NOWHERE and (well.prefilled or role):
                held = well.declared if well.prefilled else 0.0
                self.values["start"].append([number, held, " + ".join(well.liquids), role])

    def play(self, trace: Trace) -> None:
        """Every step, and between them what was replaced by hand."""
        acting: dict[int, list[Well]] = {}
        for visit in trace.visits:
            acting.setdefault(id(visit.step), []).append(visit.well)
        stands: dict[str, int] = {}
        for place, record in enumerate(trace.log, 1):
            if isinstance(record, Event):
                self._event(record)
                continue
            for well in acting.get(id(record), ()):
                if well.generation > stands.get(well.ref.labware, 0):
                    stands[well.ref.labware] = well.generation
                    self._add("fresh", record.line, self._labware[well.ref.labware], "")
            self._operation(record, id(record) in acting, place)

    def _event(self, event: Event) -> None:
        kind = _EVENTS.get(event.kind)
        if kind is not None:
            self._add(kind, event.line, self._labware.get(event.labware, -1), event.text[:300])

    def _operation(self, step: Operation, acts: bool, place: int) -> None:
        kind = _KINDS.get(step.kind)
        if kind is None:
            return
        if kind == "draw" and (step.is_air or not (acts or step.mixing)):
            kind = "air"  # above the liquid, or over no well
        info = step.pipette
        about: dict[str, Any] = {"name": info.name, "mount": info.mount}
        about |= {"channels": info.channels, "max": info.max_volume}
        pipette = _numbered(self._pipettes, info.key, self.values["pipettes"], about)
        wells = [NOWHERE if step.disposal else self._number(ref) for ref in step.wells]
        named = [list(step.nozzles), wells]
        group = _numbered(self._groups, str(named), self.values["groups"], named)
        self._add(kind, step.line, pipette, round(step.volume, 3), group)
        self.values["places"][-1] = place

    def _add(self, *step: Any) -> None:
        self.values["steps"].append(list(step))
        self.values["places"].append(NOWHERE)

    def _number(self, ref: WellRef | None) -> int:
        return NOWHERE if ref is None else self._numbers.get((ref.labware, ref.name), NOWHERE)


def _numbered(
    known: dict[Any, int], key: Any, values: list[Any], value: Sequence[Any] | Any
) -> int:
    """The place of a value among those before it, where it is added if it is new."""
    if key not in known:
        known[key] = len(values)
        values.append(value)
    return known[key]
