"""The check on tips that are to be taken from places of a rack which are empty by then."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import Event, Operation, OperationKind, wells_under
from ...vocabulary import Site, counted
from ..trace import Retaking, topics_in
from .check import Check, Doubt, Result, Violation
from .handling import called, offsets_of, target_of
from .rule_context import RuleContext, at

_EIGHT = 8
"""Of so many nozzles some are held beside a rack, or over gaps in it, to take fewer tips."""
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
        found: dict[tuple[object, ...], list[Retaking]] = {}
        for one in case.trace.retakings:
            if doubt := _why_open(one, case):
                yield Doubt(f"{target_of(one.step)} may hold no tip {at(one.step.line)}: {doubt}")
            elif not _takes_fewer(one):
                found.setdefault((one.step.pipette.key, one.step.line), []).append(one)
        for cause, together in found.items():
            first = min(together, key=lambda one: len(_pauses(one)))
            warning = _ASKED.format(at(_pauses(first)[-1].line)) if _pauses(first) else ""
            message = f"{_told(first, len(together))} {_better(first, len(together), case)}"
            for one in (first, *together):
                for place, taking in one.emptied.items():
                    took = Site(taking.step.line, place, "took the tip that stood there")
                    site = Site(one.step.line, place, "no tip stands there")
                    yield Violation(message, (took, site), cause, warning=warning)


def _pauses(one: Retaking) -> Sequence[Event]:
    """The fewest that there were since one of its places was emptied."""
    return min((taking.pauses for taking in one.emptied.values()), key=len)


def _why_open(one: Retaking, case: RuleContext) -> str:
    for pause in _pauses(one):
        said = topics_in(pause.text, case.common.pauses)
        if said.isdisjoint(_THINGS) or "rack" in pause.text.lower():
            return f"somebody may have filled the rack in the pause {at(pause.line)}"
    takers = {taking.step.pipette.key for taking in one.emptied.values()}
    if _takes_fewer(one) and takers != {one.step.pipette.key}:
        return "the column holds fewer tips than the pipette has nozzles, which may be meant"
    return ""


def _takes_fewer(one: Retaking) -> bool:
    """Whether eight nozzles find tips at the first places only."""
    step = one.step
    held = [place in one.found for place in step.wells]
    alike = len(held) == step.pipette.channels == _EIGHT
    return alike and held[0] and held == sorted(held, reverse=True)


def _told(one: Retaking, times: int) -> str:
    step, taken = one.step, next(iter(one.emptied.values())).step
    who = "it" if taken.pipette.key == step.pipette.key else f"the {called(taken)}"
    missing, nozzles = len(one.emptied), len(step.nozzles)
    none = "none is there" if nozzles == 1 else f"{missing} of them are not there"
    which = "that tip" if nozzles == 1 else "that of " + next(iter(one.emptied)).name
    often = f" It does so {times} times." if times > 1 else ""
    return (
        f"The {called(step)} goes to {target_of(step)} for {counted(nozzles, 'tip')} "
        f"{at(step.line)}, and {none}: {who} took {which} {at(taken.line)}, and nothing put it "
        f"back.{often}"
    )


def _better(one: Retaking, times: int, case: RuleContext) -> str:
    """Places of the same rack that the run leaves full, if there are enough; else a full rack."""
    steps = (step for step in case.trace.log if isinstance(step, Operation))
    taken = {w for step in steps if step.kind is OperationKind.PICK_UP_TIP for w in step.wells if w}
    rack, offsets = target_of(one.step).labware, list(offsets_of(one.step).values())
    used = {place.name for place in taken if place.labware == rack} | {None}
    info = case.trace.labware.get(rack)
    names = info.wells if info else ()
    full = [name for name in names if info and used.isdisjoint(wells_under(info, name, offsets))]
    renew = "after a pause that asks for a full rack, call the rack's reset() (or reset_tipracks())"
    if len(full) < times:
        return f"No other place of the rack has tips for it: load a further rack, or, {renew}."
    return f"Write a place that still has tips, such as {full[0]}; or, {renew}."
