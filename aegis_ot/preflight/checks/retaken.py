"""The check on tips that are to be taken from places of a rack which are empty by then."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

from ...adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    Operation,
    OperationKind,
    wells_under,
)
from ...vocabulary import Site, WellRef, counted
from ..trace import Retaking, topics_in
from .check import Check, Doubt, Result, Violation
from .handling import called, offsets_of, target_of
from .rule_context import RuleContext, at

Places = Mapping[WellRef, Operation]
"""Of a rack, each with what took the tip there."""

_THINGS = frozenset({"plate", "trough", "tips", "covers"})
_ASKED = "If somebody fills the rack in the pause {}, let its message say so."


@dataclass(frozen=True)
class TipsInPlace(Check):
    """Tips are taken only from places of a rack that hold some.

    A tip that is put into a place is there; so are new ones after `reset()`, `reset_tipracks()`,
    a pause that speaks of new tips, and a rack's time off the deck. A pause that speaks of other
    things makes it a warning, one that may mean the rack leaves it open. Eight nozzles over a
    column of which only the first places hold tips are used so on purpose.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        found: dict[tuple[object, ...], list[tuple[Sequence[Event], Retaking]]] = {}
        for step, emptied in case.trace.retakings:
            pauses = _pauses(case, step, emptied)
            if doubt := _why_open(case, step, emptied, pauses):
                yield Doubt(f"{target_of(step)} may hold no tip {at(step.line)}: {doubt}")
            elif not _takes_fewer(step, emptied):
                cause: tuple[object, ...] = (step.pipette.key, step.line)
                found.setdefault(cause, []).append((pauses, (step, emptied)))
        for place_of, together in found.items():
            pauses, first = min(together, key=lambda one: len(one[0]))
            warning = _ASKED.format(at(pauses[-1].line)) if pauses else ""
            message = f"{_message(*first, len(together))} {_remedy(case, first[0], len(together))}"
            for step, emptied in (first, *(one for _, one in together)):
                for place, taken in emptied.items():
                    took = Site(taken.line, place, "took the tip that stood there")
                    site = Site(step.line, place, "no tip stands there")
                    yield Violation(message, (took, site), place_of, warning=warning)


def _pauses(case: RuleContext, step: Operation, emptied: Places) -> Sequence[Event]:
    """The pauses since the last of these places was emptied."""
    steps = list(takewhile(lambda one: one is not step, case.trace.log))
    takers = set(map(id, emptied.values()))
    last = max(number for number, one in enumerate(steps) if id(one) in takers)
    since = (one for one in steps[last:] if isinstance(one, Event))
    return [one for one in since if one.kind is EventKind.PAUSED]


def _why_open(case: RuleContext, step: Operation, emptied: Places, pauses: Sequence[Event]) -> str:
    for pause in pauses:
        said = topics_in(pause.text, case.common.pauses)
        if said.isdisjoint(_THINGS) or "rack" in pause.text.lower():
            return f"somebody may have filled the rack in the pause {at(pause.line)}"
    takers = {taken.pipette.key for taken in emptied.values()}
    if _takes_fewer(step, emptied) and takers != {step.pipette.key}:
        return "the column holds fewer tips than the pipette has nozzles, which may be meant"
    return ""


def _takes_fewer(step: Operation, emptied: Places) -> bool:
    """Whether eight nozzles find tips at the first places only: they are held so on purpose."""
    held = [place is not None and place not in emptied for place in step.wells]
    alike = len(held) == step.pipette.channels == 8
    return alike and held[0] and held == sorted(held, reverse=True)


def _message(step: Operation, emptied: Places, times: int) -> str:
    place, taken = next(iter(emptied.items()))
    who = "it" if taken.pipette.key == step.pipette.key else f"the {called(taken)}"
    none, which = "none is there", "that tip"
    if len(step.nozzles) > 1:
        none, which = f"{len(emptied)} of them are not there", f"that of {place.name}"
    often = f" It does so {times} times." if times > 1 else ""
    return (
        f"The {called(step)} goes to {target_of(step)} for {counted(len(step.nozzles), 'tip')} "
        f"{at(step.line)}, and {none}: {who} took {which} {at(taken.line)}, and nothing put it "
        f"back.{often}"
    )


def _remedy(case: RuleContext, step: Operation, times: int) -> str:
    """Places of the same rack that the run leaves full, if there are enough; else a full rack."""
    steps = (one for one in case.trace.log if one.kind is OperationKind.PICK_UP_TIP)
    taken = {place for one in steps if isinstance(one, Operation) for place in one.wells if place}
    rack, offsets = target_of(step).labware, list(offsets_of(step).values())
    used = {place.name for place in taken if place.labware == rack} | {None}
    info = case.trace.labware.get(rack)
    names = info.wells if info else ()
    full = [name for name in names if info and used.isdisjoint(wells_under(info, name, offsets))]
    renew = "after a pause that asks for a full rack, call the rack's reset() (or reset_tipracks())"
    if len(full) < times:
        return f"No other place of the rack has tips for it: load a further rack, or, {renew}."
    return f"Write a place that still has tips, such as {full[0]}; or, {renew}."
