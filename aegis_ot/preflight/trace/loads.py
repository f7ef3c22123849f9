"""Loads: what a pipette's tips take up, and where it goes, until they are empty again.

The channels of a pipette do the same, so one of them stands for all. Mixing is left out: it ends
as it began.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from ...adapters.opentrons.instrumentation import Operation, OperationKind, expel
from .model import Layer, Visit, Well
from .trace import Trace


class Given(NamedTuple):
    """One delivery: the operation, the visit (``None``: not to a well), µL of liquid and of air."""

    step: Operation
    visit: Visit | None
    liquid: float
    air: float

    @property
    def well(self) -> Well | None:
        """Where it went, if to a well."""
        return self.visit.well if self.visit else None


@dataclass
class Load:
    """What tips draw and give until they are empty again, or off.

    Attributes:
        session: Counts the pick-ups of its pipette.
        pipette: Key of the pipette.
        drawn: Every draw of liquid.
        given: Every delivery, in order, the waste included.
        parked: Whether they were put back into a rack with it.
    """

    pipette: str
    session: int
    drawn: list[Visit] = field(default_factory=list)
    given: list[Given] = field(default_factory=list)
    parked: bool = False

    @property
    def sources(self) -> set[Well]:
        """The wells it was drawn from."""
        return {visit.well for visit in self.drawn}


def loads_of(trace: Trace) -> Iterator[Load]:
    """Every load of a run, each once it has ended."""
    visits = {id(visit.step): visit for visit in reversed(trace.visits)}
    on: dict[str, tuple[Load, list[Layer]]] = {}
    for step in trace.log:
        if not isinstance(step, Operation) or step.mixing or step.kind is OperationKind.TOUCH_TIP:
            continue
        key, kind = step.pipette.key, step.kind
        load, layers = on.get(key) or (Load(key, 0), [])
        visit = visits.get(id(step))
        if kind is OperationKind.PICK_UP_TIP or kind is OperationKind.DROP_TIP:
            load.parked = kind is OperationKind.DROP_TIP and any(step.wells) and not step.disposal
            yield load
            on[key] = (Load(key, load.session + 1), [])
            continue
        if kind is OperationKind.ASPIRATE or kind is OperationKind.AIR_GAP:
            if visit is not None and load.given and not any(one.source for one in layers):
                yield load
                load = Load(key, load.session)
            if visit is not None:
                load.drawn.append(visit)
            layers.append(Layer(visit.well if visit else None, step.volume, {}, step.line))
        elif kind is OperationKind.DISPENSE or kind is OperationKind.BLOW_OUT:
            parts = expel(layers, step.volume) if kind is OperationKind.DISPENSE else layers
            liquid = sum(one.volume for one in parts if one.source)
            air = sum(one.volume for one in parts) - liquid
            load.given.append(Given(step, visit, liquid, air))
            layers = [] if kind is OperationKind.BLOW_OUT else layers
        on[key] = (load, layers)
    yield from (load for load, _ in on.values())
