"""What a run will have watched, told by its rehearsal."""

from __future__ import annotations

import itertools
import json
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ..adapters.opentrons.instrumentation import Event, LabwareInfo, Operation
from ..vocabulary import Keyframe
from .steps import Abandon, Capture, Step
from .tracker import Tracker

_MOST_BYTES = 24_000
"""What the plan may take of a registration, which has to stay below 64 kB."""


class Planner:
    """A listener that collects the keyframes which a run of the same operations will emit.

    Args:
        guard: Which guard the rehearsal stands under, as a number; ``None`` under none. What came
            under an earlier one is forgotten.

    Attributes:
        keyframes: In order.
    """

    def __init__(self, guard: Callable[[], int | None] = lambda: 0) -> None:
        self._guard = guard
        self._begin(None)

    def _begin(self, under: int | None) -> None:
        self._under = under
        self._tracker = Tracker("plan")
        self._abandoned: set[int] = set()
        self.keyframes: list[Keyframe] = []

    @property
    def trajectories(self) -> int:
        """How many wells will be judged."""
        seen = {keyframe.trajectory for keyframe in self.keyframes}
        return len(seen - self._abandoned)

    def before(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        if self._listens():
            self._take(self._tracker.before(operation))

    def after(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        if self._listens():
            self._take(self._tracker.after(operation))

    def event(self, event: Event) -> None:
        """Of :class:`.Listener`."""
        if self._listens():
            self._take(self._tracker.event(event))

    def finish(self) -> None:
        """The run is over: take in what it still owed."""
        self._take(self._tracker.finish())

    def about(self, labware: Mapping[str, LabwareInfo]) -> dict[str, Any]:
        """Plates, labelled tip racks and deliveries for the run's registration (``RunStart`` in
        the wire protocol).
        """
        wells = {k.trajectory: k.destinations for k in self.keyframes if k.destinations}
        last = max((keyframe.trajectory for keyframe in self.keyframes), default=-1)
        planned: list[dict[str, Any]] = []
        for number in range(last + 1):
            into = () if number in self._abandoned else wells.get(number, ())
            names = [well.name for well in into]
            planned.append({"labware": into[0].labware, "wells": names} if into else {"wells": []})
        filled = dict.fromkeys(well for number in range(last + 1) for well in wells.get(number, ()))
        first = {well.labware: well for well in reversed(filled)}
        plates = [
            {"labware": key, "label": well.label, "slot": well.slot, **size}
            for key, well in first.items()
            if (size := _size_of(labware.get(key)))
        ]
        sizes = itertools.accumulate(len(json.dumps(delivery)) for delivery in planned)
        room = sum(size < _MOST_BYTES for size in sizes)
        racks = [
            {"slot": info.slot, "label": info.label[:200]}
            for info in labware.values()
            if info.is_tip_rack and info.label
        ]
        told = {"plates": plates[:50], "planned": planned[:room], "planned_wells": len(filled)}
        return told | ({"racks": racks[:50]} if racks else {})

    def _listens(self) -> bool:
        under = self._guard()
        if under is not None and under != self._under:
            self._begin(under)
        return under is not None

    def _take(self, steps: Iterable[Step]) -> None:
        for step in steps:
            if isinstance(step, Capture):
                self.keyframes.append(step.keyframe)
            elif isinstance(step, Abandon):
                self._abandoned.add(step.trajectory)


def _size_of(labware: LabwareInfo | None) -> dict[str, int]:
    """Rows and columns, by the names of its wells."""
    names = () if labware is None else labware.wells
    places = [match for name in names if (match := re.fullmatch(r"([A-Z]+)(\d+)", name))]
    if not places:
        return {}
    rows, columns = {place[1] for place in places}, {int(place[2]) for place in places}
    return {"rows": len(rows), "columns": max(columns)}
