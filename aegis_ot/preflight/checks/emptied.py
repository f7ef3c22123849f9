"""Checks on draws of nothing: of more than a well can hold, of what never was there, from above."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import OperationKind
from ..source import lexicon_of
from ..trace import FALLS_MM, Above, Visit, Well
from .check import Check, Result, Violation, microlitres, site_of
from .rule_context import RuleContext, at
from .volumes import goes_to_waste

_SMALLEST_TROUGH_UL = 1000.0
_NO_TROUGH = "It is called a reservoir, and no reservoir holds so little: mend its definition."
_SWEPT = "All of it goes into one well: it may be drawn to leave nothing behind."
_TALLER = "The run gives from far above such labware: what stands there is taller: define it."


@dataclass(frozen=True)
class StockSuffices(Check):
    """No more is drawn from a well than it can hold filled to the brim, refills counted.

    What goes to the waste over-reaches to empty the well.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        taller = _taller(case) if case.trace.overdrawn else set()
        for well, visit in case.trace.overdrawn.items():
            if well.ref in case.waste or well.runs_through or goes_to_waste(case, visit):
                continue
            needed, first = _needed(well), well.visits[0]
            warning = _NO_TROUGH if _is_no_trough(case, well) else ""
            if len(case.destinations.get(well, ())) == 1 and well.received:
                warning = _SWEPT  # no stock: what the run made there goes on as a whole
            load_name = case.trace.labware[well.ref.labware].load_name
            cause: tuple[object, ...] = (visit.line, well.ref.labware)
            if load_name in taller:
                warning, cause = _TALLER, ("taller", load_name)
            told = (
                f"{microlitres(needed)} are drawn from {well.ref} in all, the first "
                f"{at(first.line)}; filled to the brim it holds {microlitres(well.brim)}, and it "
                f"runs dry {at(visit.line)}: use a larger vessel, or several with the same liquid."
            )
            site = site_of(visit, f"{microlitres(needed)} are drawn in all")
            yield Violation(told, (site,), cause, warning=warning)


def _taller(case: RuleContext) -> set[str]:
    """Labware, by load name, that the run gives into from far above what its definition says."""
    return {
        case.trace.labware[visit.well.ref.labware].load_name
        for visit in case.trace.visits
        if visit.step and (visit.step.from_top or 0.0) > FALLS_MM
    }


def _is_no_trough(case: RuleContext, well: Well) -> bool:
    """Whether a labware that is called a reservoir is defined as one of small wells."""
    info = case.trace.labware.get(well.ref.labware)
    named = lexicon_of({"trough": case.common.pauses.get("trough", ())})
    names = (info.label, info.display_name, info.load_name) if info else ()
    return well.brim < _SMALLEST_TROUGH_UL and any(map(named.find, names))


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
    itself fills.

    Where one statement draws from wells of a labware of which the run has filled most, the others
    are empty. Where it draws from none that the run has filled, and as many that are filled are
    never touched again, it means those. A well that is only mixed, on a plate of which all others
    were filled, is empty too. Within a labware liquid is passed on from wells that were filled by
    hand: that is left out.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        drawn: dict[tuple[object, ...], dict[Well, Visit]] = {}
        plates: dict[tuple[str, int], list[Well]] = {}
        for visit in case.trace.visits:
            if visit.kind is OperationKind.ASPIRATE:
                place = (visit.line, visit.caller, *visit.well.plate)
                drawn.setdefault(place, {}).setdefault(visit.well, visit)
        for well in case.trace.wells.values():
            plates.setdefault(well.plate, []).append(well)
        for cause, visits in drawn.items():
            filled = [one.well for one in visits.values() if _was_filled(one)]
            begun = min(one.index for one in visits.values() if not filled or _was_filled(one))
            bare = [one for one in visits.values() if one.index >= begun and _is_bare(case, one)]
            if not bare:
                continue
            if len(filled) < _FEWEST or len(bare) >= len(filled):
                filled = _filled_elsewhere(bare, visits, plates[bare[0].well.plate])
            for one in bare if len(filled) >= _FEWEST else ():
                done = "is mixed" if one.mixing else "is drawn from"
                message = (
                    f"{one.well.ref} {done} {case.at(one)}, and holds nothing: the run fills "
                    f"{len(filled)} other wells for that, but not this one."
                )
                sites = (site_of(one, "nothing was put here"),)
                yield Violation(message, sites, ("bare", *cause))


def _is_bare(case: RuleContext, visit: Visit) -> bool:
    """Whether nothing but this draw says that a well holds anything."""
    well, drawn_for = visit.well, case.destinations.get(visit.well, ())
    return (
        well.assumed
        and visit is well.visits[0]
        and not (well.liquids or well.ref in case.unsure or case.left_out(well))
        and (visit.mixing or all(one.ref.labware != well.ref.labware for one in drawn_for))
    )


def _filled_elsewhere(
    bare: Sequence[Visit], visits: Mapping[Well, Visit], plate: Sequence[Well]
) -> list[Well]:
    """The wells of a plate that the run filled in the place of these."""
    if len(bare) < len(visits):
        return []
    first = min(one.index for one in bare)
    others = [well for well in plate if well not in visits and well.visits]
    filled = [well for well in others if well.received and well.received[0].visit.index < first]
    if all(one.mixing and all(v.mixing for v in one.well.visits) for one in bare):
        return filled if len(filled) == len(others) else []
    kept = [
        well
        for well in filled
        if not well.prefilled and all(v.kind is not OperationKind.ASPIRATE for v in well.visits)
    ]
    return kept if len(kept) == len(bare) else []


def _was_filled(visit: Visit) -> bool:
    """Whether the run itself had put something into a well before it drew from it."""
    return not visit.well.assumed and not visit.well.prefilled and visit.well.fed


@dataclass(frozen=True)
class DrawsReachLiquid(Check):
    """No tip draws from above the liquid.

    At a well's mouth, before a further draw, and into a tip that holds liquid, air is drawn on
    purpose. A mix at several heights rinses the tip.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        found: dict[tuple[object, ...], list[Above]] = {}
        for one in case.trace.above:
            visit, ref = one.visit, one.visit.well.ref
            if not (visit.mixing or ref in case.waste or _draws_next(visit)):
                found.setdefault((visit.line, visit.caller, ref.labware), []).append(one)
        for cause, together in found.items():
            visit, height, level, held = together[0]
            declared = "" if visit.well.declared is None else ", as declared,"
            message = (
                f"{microlitres(visit.volume)} are drawn from {visit.well.ref} {case.at(visit)} "
                f"with the tip {height:.3g} mm above its bottom, and the {microlitres(held)} that "
                f"are left{declared} reach to {level:.3g} mm: it draws air. Aim lower."
            )
            for one in together:
                site = site_of(one.visit, "the tip is above the liquid")
                yield Violation(message, (site,), cause)


def _draws_next(visit: Visit) -> bool:
    """Whether the tip goes on to draw: it took its air first."""
    visits = visit.tip.visits
    after = bisect_right(visits, visit.index, key=lambda one: one.index)
    return after < len(visits) and visits[after].kind is OperationKind.ASPIRATE
