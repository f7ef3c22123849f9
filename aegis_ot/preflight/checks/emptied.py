"""Checks on wells from which more is drawn than they can hold, or in which nothing ever was."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ...vocabulary import Site
from ..trace import Visit, Well
from .case import Case, at
from .check import Check, Result, Violation, microlitres
from .volumes import goes_to_waste


@dataclass(frozen=True)
class StockSuffices(Check):
    """No more is drawn from a well than it can hold filled to the brim, refills counted.

    What goes to the waste over-reaches to empty the well.
    """

    def find(self, case: Case) -> Iterator[Result]:
        for well, visit in case.trace.overdrawn.items():
            if well.ref in case.waste or well.runs_through or goes_to_waste(case, visit):
                continue
            needed, first = _needed(well), well.visits[0]
            told = (
                f"{microlitres(needed)} are drawn from {well.ref} in all, the first "
                f"{at(first.line)}; filled to the brim it holds {microlitres(well.brim)}, and it "
                f"runs dry {at(visit.line)}: use a larger vessel, or several with the same liquid."
            )
            site = Site(visit.line, well.ref, f"{microlitres(needed)} are drawn in all")
            yield Violation(told, (site,), (visit.line, well.ref.labware))


def _needed(well: Well) -> float:
    """µL that a run draws from a well, less what it gives it."""
    moved = [visit for visit in well.visits if not visit.mixing]
    drawn = sum(visit.volume for visit in moved if visit.kind is OperationKind.ASPIRATE)
    returned = sum(
        visit.volume - sum(one.volume for one in visit.brought)
        for visit in moved
        if visit.kind is not OperationKind.ASPIRATE
    )
    return drawn - returned


_FEWEST = 3


@dataclass(frozen=True)
class NothingFromNothing(Check):
    """Nothing is drawn from, or mixed in, a well that never held anything, in labware that the run
    itself fills: where one statement draws from wells of a labware of which the run has filled
    most, the others are empty.

    Within a labware liquid is passed on from wells that were filled by hand: that is left out.
    """

    def find(self, case: Case) -> Iterator[Result]:
        drawn: dict[tuple[object, ...], dict[Well, Visit]] = {}
        for visit in case.trace.visits:
            if visit.kind is OperationKind.ASPIRATE:
                place = (visit.line, visit.caller, *visit.well.plate)
                drawn.setdefault(place, {}).setdefault(visit.well, visit)
        for cause, visits in drawn.items():
            filled = [one for one in visits.values() if _was_filled(one)]
            if len(filled) < _FEWEST:
                continue
            begun = min(one.index for one in filled)
            bare = [
                one
                for one in visits.values()
                if one.well.assumed and one.index > begun and one is one.well.visits[0]
                if not one.well.liquids and one.well.ref not in case.unsure
                if one.mixing or not _stays(case, one.well)
            ]
            if len(bare) >= len(filled):
                continue
            for one in bare:
                done = "is mixed" if one.mixing else "is drawn from"
                message = (
                    f"{one.well.ref} {done} {case.at(one)}, and holds nothing: the run fills "
                    f"{len(filled)} other wells for that, but not this one."
                )
                site = Site(one.line, one.well.ref, "nothing was put here")
                yield Violation(message, (site,), ("bare", *cause))


def _was_filled(visit: Visit) -> bool:
    """Whether the run itself had put something into a well before it drew from it."""
    return not visit.well.assumed and not visit.well.prefilled and visit.well.fed


def _stays(case: Case, well: Well) -> bool:
    return any(other.ref.labware == well.ref.labware for other in case.destinations.get(well, ()))
