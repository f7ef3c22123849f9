"""The check on volumes that do not add up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import OperationKind
from ..trace import TO_EMPTY, Imbalance, Visit, Well
from .check import Check, Doubt, Result, Violation, microlitres, site_of
from .rule_context import RuleContext, at

_FEWEST_ALIKE = 3
_FAR_SHORT = 2.0
"""Where so many times more is drawn than the run has put in, the plate was filled by hand."""

_INEXACT = 0.05
"""What a draw may lack, as a share of it: pipettes and people who fill tubes are no more exact."""

_DECLARED = "It rests on the declared volume (load_liquid): that, or the draw, is wrong."

STOCK_SUFFICES = "HND-6"
"""The rule that tells of wells which cannot hold what is drawn from them at all."""


@dataclass(frozen=True)
class VolumeBookkeeping(Check):
    """No well is filled beyond its capacity or drawn below what it holds.

    Wells of unknown volume are judged only by what the run put into them; so are plates from
    which so much is drawn that someone must have filled them by hand. What stays below the brim,
    a draw that over-reaches only to empty a well, and one that lacks next to nothing is a warning.
    Waste may fill its well to the brim.
    """

    lasting = True

    def find(self, case: RuleContext) -> Iterator[Result]:
        """Report each kind of imbalance once in each well: the first that is sure, or the first."""
        by_hand = {
            one.visit.well.ref.labware
            for one in case.trace.imbalances
            if not (one.overfilled or _is_aliquot(case, one.visit.well))
            and _is_far_short(one.visit.well)
        }
        short = _all_short(case)
        found: dict[tuple[Well, bool], list[Imbalance]] = {}
        for one in case.trace.imbalances:
            well = one.visit.well
            if one.overfilled and well.ref in case.waste and one.volume <= well.brim:
                continue
            if well.runs_through:
                continue  # what runs through is not there to overflow, or to be drawn
            if why := case.left_out(well):
                does = "is filled to" if one.overfilled else "is drawn from by"
                yield Doubt(f"{well.ref} {does} {microlitres(one.volume)}, and {why}")
                continue
            if one.overfilled and _is_declared_as_made(one):
                yield Doubt(
                    f"{well.ref} is given {microlitres(_given(well))}, and about as much is "
                    "declared for it (load_liquid): that may be what it will hold"
                )
                continue
            by_run = not one.visit.mixing and _is_aliquot(case, well)
            if not (one.overfilled or by_run) and well.declared is None:
                if (
                    well.ref in case.unsure
                    or well.ref.labware in by_hand
                    or well.generation  # brought by hand in a pause: nobody says what it holds
                ):
                    continue  # it may have held what nobody declared
                if one.visit.mixing or well.ref.labware in short:
                    drawn, held = microlitres(one.volume), microlitres(one.limit)
                    yield Doubt(
                        f"{drawn} are drawn from {well.ref} {at(one.visit.line)}, and the run "
                        f"has put {held} there: it may have held more"
                    )
                    continue
            found.setdefault((well, one.overfilled), []).append(one)
        for together in found.values():
            told = [(one, _why_practice(case, one)) for one in together]
            # An error speaks for all; of warnings what is delivered, not what is mixed or wasted.
            first, warning = min(told, key=lambda one: (bool(one[1]), one[1] != _DECLARED))
            later = together[together.index(first) :]
            yield _violation(first, warning, max(one.volume for one in later))


def _given(well: Well) -> float:
    """µL of other wells' liquid that the run brings to a well."""
    return sum(one.volume for one in well.received)


def _is_declared_as_made(imbalance: Imbalance) -> bool:
    """Whether a well overflows only because what the run makes there is declared beforehand."""
    well, given = imbalance.visit.well, _given(imbalance.visit.well)
    declared = well.declared or 0.0
    fits = imbalance.volume - declared <= well.capacity
    return fits and declared > 0 and abs(given - declared) <= _INEXACT * declared


def _all_short(case: RuleContext) -> set[str]:
    """Labware of which all wells that the run draws from hold too little: they held more before."""
    drawn: dict[str, set[Well]] = {}
    for visit in case.trace.visits:
        if visit.kind is OperationKind.ASPIRATE and not visit.mixing:
            drawn.setdefault(visit.well.ref.labware, set()).add(visit.well)
    short = {one.visit.well for one in case.trace.imbalances if not one.overfilled}
    return {key for key, wells in drawn.items() if len(wells) >= _FEWEST_ALIKE and wells <= short}


def _is_aliquot(case: RuleContext, well: Well) -> bool:
    """Whether the run puts one liquid into a well, and hands out more from there, by two draws or
    more: then it held nothing before, whatever it is called. Where the last column of samples is
    not full, one of the draws by eight channels is for nothing; and a draw of more than the run
    puts there, a mix's too, says that it held something.
    """
    if well.generation or len({one.source for one in well.received}) != 1:
        return False
    draws = [one for one in well.visits if one.kind is OperationKind.ASPIRATE]
    if well.visits[0] in draws or len(case.made_of.get(well, ())) < _FEWEST_ALIKE:
        return False
    given, most = sum(one.volume for one in well.received), max(one.volume for one in draws)
    drawn = sum(one.volume for one in draws if not one.mixing)
    return most <= given <= drawn - 2 * most


def _is_far_short(well: Well) -> bool:
    """Whether the run draws far more from a well than it puts there, mixing apart."""
    moved = [visit for visit in well.visits if not visit.mixing]
    given = sum(visit.volume for visit in moved if visit.kind is OperationKind.DISPENSE)
    drawn = sum(visit.volume for visit in moved if visit.kind is OperationKind.ASPIRATE)
    return given * _FAR_SHORT <= drawn


def _why_practice(case: RuleContext, imbalance: Imbalance) -> str:
    """Why an imbalance is a warning, in a sentence; empty for an error."""
    visit, well = imbalance.visit, imbalance.visit.well
    if imbalance.overfilled:
        if well.declared and imbalance.volume <= well.declared:
            return "So much is declared for it before the run: that, or the labware, is wrong."
        if imbalance.volume - well.fallen <= well.capacity:
            return "Drops that fall from so high over it may land elsewhere."
        if well.declared and imbalance.volume - well.declared <= well.capacity:
            return f"{microlitres(well.declared)} of that are only declared (load_liquid)."
        if imbalance.volume > well.brim or _is_filled_again(case, visit):
            return ""
        return f"It stays below the brim ({microlitres(well.brim)})."
    if 0 < imbalance.volume - imbalance.limit <= _INEXACT * imbalance.volume:
        return "What is lacking is within what filling and pipetting are exact to."
    if visit.mixing:
        return "It is drawn to mix, not to be delivered."
    if goes_to_waste(case, visit):
        return "What is drawn goes to the waste."
    if well.declared:
        return _DECLARED
    last = all(v.index <= visit.index for v in well.visits if v.kind is OperationKind.ASPIRATE)
    if (
        last
        and 0 < imbalance.volume <= imbalance.limit * TO_EMPTY
        and len(case.destinations.get(well, ())) <= 1
    ):
        return "It is drawn to empty the well."
    return ""


def goes_to_waste(case: RuleContext, visit: Visit) -> bool:
    """Whether nothing of what is drawn comes into a well that matters."""
    fed = {
        given.well
        for given in visit.tip.visits
        if given.index > visit.index and given.session == visit.session
        if any(one.source is visit.well for one in given.brought)
    }
    return all(case.is_waste(one) for one in fed)


def _is_filled_again(case: RuleContext, visit: Visit) -> bool:
    """Whether a well gets one liquid more often than most wells beside it, and keeps it."""
    times = case.fillings
    for source in {one.source for one in visit.brought}:
        others = sorted(
            times[other][source]
            for other in case.destinations.get(source, ())
            if other is not visit.well and other.ref.labware == visit.well.ref.labware
        )
        if others and times[visit.well][source] > others[len(others) // 2]:
            return True
    return False


def _violation(imbalance: Imbalance, warning: str, most: float) -> Violation:
    visit, well = imbalance.visit, imbalance.visit.well
    volume, limit = microlitres(imbalance.volume), microlitres(imbalance.limit)
    if imbalance.overfilled:
        later = f", and to {microlitres(most)} later" if microlitres(most) != volume else ""
        message = f"{well.ref} is filled to {volume} {at(visit.line)}{later}; it holds {limit}."
        sites = [site_of(visit, f"filled to {volume}")]
    else:
        holds = f"which holds {limit} then"
        if well.declared:
            holds = f"of whose declared {microlitres(well.declared)} {limit} are left then"
            if any(one.brought for one in well.visits if one.index < visit.index):
                holds = f"which holds {limit} then, its declared volume included"
        message = f"{volume} are drawn from {well.ref} {at(visit.line)}, {holds}."
        sites = [site_of(visit, f"drew {volume} of {limit}")]
    fills = [one for one in well.visits if one.index < visit.index and one.brought]
    if fills and fills[-1].line != visit.line:
        sites.insert(0, site_of(fills[-1], "last filled here"))
    cause = (visit.line, imbalance.overfilled)
    told_by = "" if imbalance.overfilled else STOCK_SUFFICES
    return Violation(message, tuple(sites), cause, warning=warning, told_by=told_by)
