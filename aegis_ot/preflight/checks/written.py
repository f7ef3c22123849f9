"""The check that what is written is what moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from ...adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind
from ...vocabulary import Site, WellRef, counted
from ..trace import Given, Load, Visit, Well
from .check import Check, Result, Violation, microlitres
from .handling import called
from .rule_context import RuleContext, at

_SMALL = 0.05
"""A share of what is written that may be missing with no more than a warning."""

_ROUNDING = 0.1
_GAP = 0.5
"""Of what was just given so much, at most, is taken along by an air gap that draws liquid."""


@dataclass(frozen=True)
class WrittenIsMoved(Check):
    """What is written is what moves.

    0 µL that older apiLevels take for a full tip, or for all that is in it; a dispense of more
    than the tip holds; an air gap that leaves first, or is drawn from the liquid; a ``distribute``
    that ends before its last well.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        # What is sure comes first, and so speaks for all of one cause.
        yield from sorted(self._found(case), key=lambda violation: bool(violation.warning))

    def _found(self, case: RuleContext) -> Iterator[Violation]:
        for step in case.trace.log:
            if isinstance(step, Event):
                yield from _cut_short(step) if step.kind is EventKind.CUT_SHORT else ()
            elif step.mixing and step.written == 0:
                yield from _full_mix(step)
        for load in case.loads:
            found = _drawn_full(case, load)
            yield from found or _given_otherwise(case, load)
            yield from _short_by_the_gap(case, load)
        for before, load in pairwise(case.loads):
            yield from _taken_along(case, before, load)


def _full_mix(step: Operation) -> Iterator[Violation]:
    if step.well is not None and step.kind is OperationKind.ASPIRATE:
        told = (
            f"A mix of 0 µL is written {at(step.line)}; at this apiLevel the {called(step)} mixes "
            f"a full tip, {microlitres(step.volume)}, in {step.well}: leave such mixes out."
        )
        yield _violation(told, step, step.well, "mix", "It goes back where it came from.")


def _cut_short(event: Event) -> Iterator[Violation]:
    """A call that ended in silence, with the wells that it never came to."""
    done = "get anything" if event.text == "distribute" else "give anything"
    told = (
        f"{event.text} {at(event.line)} ends without a word before {event.wells[0]}: "
        f"{microlitres(event.volume or 0.0)}, with the disposal volume and the air gap, have no "
        f"room in the tip. So {counted(len(event.wells), 'well')} of it never {done}: "
        f"lower disposal_volume, or use transfer."
    )
    for ref in event.wells:
        site = Site(event.line, ref, "never reached")
        yield Violation(told, (site,), ("short", event.line))


def _matters(case: RuleContext, one: Given, load: Load) -> bool:
    """Whether liquid reaches a well that is neither waste nor where it came from."""
    well = one.well
    return well is not None and well not in load.sources and not case.is_waste(well)


def _drawn_full(case: RuleContext, load: Load) -> list[Violation]:
    found = []
    for visit in load.drawn:
        step = visit.step
        if step is None or step.written != 0:
            continue
        reached = [g for g in load.given if g.liquid > 0 and _matters(case, g, load)]
        told = (
            f"0 µL are written to be drawn from {visit.well.ref} {at(step.line)}; at this apiLevel "
            f"that fills the tip, so the {called(step)} draws {microlitres(step.volume)}"
        )
        end = visit.well
        if reached and reached[0].well is not None:
            end, given = reached[0].well, microlitres(reached[0].liquid)
            told += f" and gives {given} of them to {end.ref} {at(reached[0].step.line)}"
        told += ": leave wells of 0 µL out, or raise the apiLevel."
        why = "" if reached else "None of it reaches a well that matters."
        found.append(_violation(told, step, end.ref, "drawn", why))
    return found


def _given_otherwise(case: RuleContext, load: Load) -> Iterator[Violation]:
    last: Well | None = None
    others: set[Well] = set()
    for one in load.given:
        step, well = one.step, one.well
        if well is None:
            continue
        if step.written == 0 and one.liquid > 0 and _matters(case, one, load):
            told = (
                f"0 µL are written for {well.ref} {at(step.line)}; at this apiLevel that gives "
                f"all that is in the tip: the {called(step)} gives it {microlitres(one.liquid)}. "
                "Leave wells of 0 µL out, or raise the apiLevel."
            )
            yield _violation(told, step, well.ref, "given")
        elif step.written and _matters(case, one, load):
            emptied = _is_emptied(case, one, others - {well})
            yield from _cut(one, well, step.written, others - {well}, last, emptied)
        if one.liquid > 0:
            others.add(well)
        last = well


def _is_emptied(case: RuleContext, one: Given, others: set[Well]) -> bool:
    """Whether a tip that fed other wells is emptied into a spare one: at a line of its own, into
    labware of its own or as much as the pipette can give, and nothing is drawn from there.
    """
    well = one.well
    if well is None or not others or well in case.destinations:
        return False
    apart = all(other.ref.labware != well.ref.labware for other in others)
    full = (one.step.written or 0.0) >= one.step.pipette.max_volume
    given = (other for load in case.loads for other in load.given)
    here = {other.well for other in given if other.step.line == one.step.line}
    return (apart or full) and here == {well}


def _cut(
    one: Given, well: Well, written: float, others: set[Well], last: Well | None, emptied: bool
) -> Iterator[Violation]:
    moved = one.liquid + one.air
    short, step = written - moved, one.step
    touched = last or (one.visit and _before(one.visit))
    if short <= _ROUNDING or (moved < _ROUNDING and touched is well):
        return  # an empty tip is blown out where it just was
    told = (
        f"{microlitres(written)} are written for {well.ref} {at(step.line)}, and the tip of the "
        f"{called(step)} holds {microlitres(moved)} then: at this apiLevel the dispense is "
        f"cut in silence. Draw at least as much as is given, or give less."
    )
    why = ""
    if short <= _SMALL * written:
        why = f"{microlitres(short)} are lacking."
    elif not others and moved >= _ROUNDING:
        why = "All that was drawn goes to this well."
    elif one.visit and _mixes_next(one.visit):
        why = (
            "The tip has drawn nothing before, and mixes there next: what clings to it may matter."
        )
    elif emptied:
        why = "What is left in the tip is emptied there, and nothing is drawn from it."
    yield _violation(told, step, well.ref, "cut", why)


def _before(visit: Visit) -> Well | None:
    """The well that a tip was in before."""
    mine = [one for one in visit.tip.visits if one.session == visit.session]
    earlier = [one.well for one in mine if one.index < visit.index]
    return earlier[-1] if earlier else None


def _mixes_next(visit: Visit) -> bool:
    """Whether a tip that met nothing before mixes in the well that it is emptied into."""
    later = (one for one in visit.tip.visits if one.index > visit.index)
    following = next(later, None)
    drawn = visit.carried or visit.met
    return not drawn and following is not None and following.mixing and following.well is visit.well


def _short_by_the_gap(case: RuleContext, load: Load) -> Iterator[Violation]:
    """An air gap leaves first; where as much liquid stays in the tip, it was forgotten."""
    given = [one for one in load.given if _matters(case, one, load)]
    air = sum(one.air for one in given if one.liquid > 0)
    drawn = sum(visit.volume for visit in load.drawn)
    planned = sum(one.step.volume for one in given if one.step.kind is OperationKind.DISPENSE)
    left = drawn - sum(one.liquid for one in load.given if one.well is not None)
    if load.parked or air <= _ROUNDING or abs(air - left) > _ROUNDING:
        return
    first = next(one for one in given if one.air > 0 and one.liquid > 0)
    if abs(planned - drawn) > _ROUNDING or first.well is None:
        return
    told = (
        f"{microlitres(first.step.volume)} are written for {first.well.ref} "
        f"{at(first.step.line)}, and the air gap leaves the tip of the {called(first.step)} first: "
        f"{microlitres(first.liquid)} of liquid reach it. Give the gap as well: "
        f"{microlitres(first.step.volume + air)}, or blow out there."
    )
    why = f"{microlitres(left)} stay in the tip."
    yield _violation(told, first.step, first.well.ref, "gap", why)


def _taken_along(case: RuleContext, before: Load, load: Load) -> Iterator[Violation]:
    """A tip that goes to the waste with some of what it has just given."""
    if (before.pipette, before.session) != (load.pipette, load.session) or load.parked:
        return
    last = before.given[-1] if before.given else None
    if last is None or last.well is None or not _matters(case, last, before):
        return
    well, delivered = last.well, sum(g.liquid for g in before.given if g.well is last.well)
    drawn = sum(visit.volume for visit in load.drawn)
    kept = any(one.well is not None and not case.is_waste(one.well) for one in load.given)
    if load.sources != {well} or kept or not 0 < drawn <= _GAP * delivered:
        return
    step = load.drawn[0].step
    if step is None:
        return
    told = (
        f"The {called(step)} draws {microlitres(drawn)} from {well.ref} {at(step.line)}, where it "
        f"has just given {microlitres(delivered)}, and takes them along into the trash: the well "
        f"ends short. For an air gap draw above the liquid: aspirate({drawn:g}, well.top())."
    )
    yield _violation(told, step, well.ref, "along", "It goes to the waste.")


def _violation(told: str, step: Operation, well: WellRef, kind: str, why: str = "") -> Violation:
    site = Site(step.line, well, "moves another volume than is written")
    return Violation(told, (site,), (kind, step.line, step.pipette.key), warning=why)
