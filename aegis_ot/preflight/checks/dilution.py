"""What a dilution step is, and the checks on steps: each is mixed, one way, by a fresh tip."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import OperationKind
from ...vocabulary import Site
from ..trace import Tip, Transfer, Visit, Well
from .check import Check, Doubt, Result, Violation, site_of
from .rule_context import RuleContext, at
from .series import Series, SeriesFinder, branching

_BY_HAND = "None of the wells in which this series ends is mixed; that may be done by hand."
_MIXED = "Each step is mixed before the next, which rinses the tip: common practice, not exact."


@dataclass(frozen=True)
class SeriesCheck(Check):
    """A check on each dilution series by itself."""

    def find(self, case: RuleContext) -> Iterator[Result]:
        if not case.once(SeriesFinder).found:
            yield Doubt("no chain of transfers from well to well was found")
        for series in case.once(SeriesFinder).found:
            yield from self.along(case, series)

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        """What is wrong with one series, or cannot be judged of it."""
        raise NotImplementedError


def diluent_arrivals(case: RuleContext, well: Well) -> list[int]:
    """Index of each delivery of diluent to a well."""
    return [
        one.visit.index
        for one in well.received
        if case.has(one.source, case.family.series.diluent)
        or one.source in case.once(SeriesFinder).fillers
        or _is_made_diluent(case, one)
    ]


def _is_made_diluent(case: RuleContext, one: Transfer) -> bool:
    """Whether a source elsewhere was filled in the run with diluent, and with no stock."""
    return (
        one.source.ref.labware != one.well.ref.labware
        and not one.source.prefilled
        and case.brings(one, case.family.series.diluent)
        and not case.brings(one, case.family.series.stock)
    )


def dilutions(case: RuleContext, series: Series) -> list[Transfer]:
    """The steps that dilute.

    Undiluted stock in an empty first well is none: that well never gets diluent, or only after it
    was drawn from, when all wells are filled up for the reader.
    """
    return [
        step
        for step in series.steps
        if step.source in series.position
        or case.has(step.well, case.family.series.diluent)
        or any(index < _drawn_at(step) for index in diluent_arrivals(case, step.well))
    ]


def is_mixed(case: RuleContext, step: Transfer) -> bool:
    """Whether a step's well is mixed before liquid is carried on from there."""
    return case.trace.mixed_since(step.well, step.visit.index, _drawn_at(step))


def _drawn_at(step: Transfer) -> float:
    drawn = next_draw(step)
    return drawn.index if drawn else math.inf


def next_draw(step: Transfer) -> Visit | None:
    """The first draw from a step's well after it, mixing apart."""
    return next(
        (
            visit
            for visit in step.well.visits
            if visit.index > step.visit.index
            and visit.kind is OperationKind.ASPIRATE
            and not visit.mixing
        ),
        None,
    )


@dataclass(frozen=True)
class SeriesMixed(SeriesCheck):
    """Every dilution step is mixed in its well before liquid is drawn on from there."""

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        steps = dilutions(case, series)
        by_hand = _left_to_hand(case, steps)
        for step in steps:
            if is_mixed(case, step):
                continue
            drawn = next_draw(step)
            then = f"before liquid is carried on {at(drawn.line)}" if drawn else "afterwards"
            yield Violation(
                f"The dilution into {step.well.ref} {at(step.visit.line)} is not mixed {then}.",
                (
                    Site(step.drawn, step.source.ref, "drew the more concentrated solution"),
                    site_of(step.visit, "diluted here, not mixed"),
                ),
                (_BY_HAND,) if step.well in by_hand else (step.visit.line,),
                warning=_BY_HAND if step.well in by_hand else "",
            )


def _left_to_hand(case: RuleContext, steps: Sequence[Transfer]) -> set[Well]:
    """The last wells of a series that branches, where none of them is mixed: one may be forgotten,
    all are left to whoever takes them off the deck.
    """
    ends = [step for step in steps if next_draw(step) is None]
    wells = {step.well for step in ends}
    return set() if len(wells) < 2 or any(is_mixed(case, step) for step in ends) else wells


def _unknown_direction(case: RuleContext, series: Series) -> Doubt:
    ends = tuple(sorted(series.position, key=series.position.__getitem__))
    why = "nothing says which end of the series holds the stock"
    return Doubt(why, roles_of=(ends[0], ends[-1]), role=case.family.series.stock[0])


@dataclass(frozen=True)
class SeriesDirection(SeriesCheck):
    """The series runs from the most to the least concentrated well, one well at a time."""

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        if not series.directed:
            yield _unknown_direction(case, series)
        branches = branching(series.links)
        jumps = [series.position[step.well] - series.position[step.source] for step in series.links]
        backwards = 2 * jumps.count(-1) > len(jumps)
        for step, jump in zip(series.links, jumps, strict=True):
            if jump == 1:
                continue
            if step.source in branches or (branches and jump < 0 and not backwards):
                yield Doubt("a well is diluted by several factors, which no line of wells shows")
                continue
            if jump < 0 and not series.directed:
                continue
            what = (
                "towards the more concentrated end"
                if jump < 0
                else f"skipping {jump - 1} well{'s' if jump > 2 else ''} of the series"
            )
            yield Violation(
                f"The dilution runs {what}: from {step.source.ref} {at(step.drawn)} into "
                f"{step.well.ref} {at(step.visit.line)}.",
                (
                    Site(step.drawn, step.source.ref, "drew from here"),
                    site_of(step.visit, f"diluted {what}"),
                ),
                (step.visit.line, jump < 0),
            )


@dataclass(frozen=True)
class SeriesTip(SeriesCheck):
    """A tip that has touched a more concentrated well touches no later well of the series.

    The two wells of the first step that it makes are excepted.
    """

    def claims(self, case: RuleContext, origin: Well, well: Well) -> bool | None:
        """As one well of a series, or what is diluted along it, in another; two series may be two
        samples or one.
        """
        of_origin, of_well = (
            {
                id(series)
                for series in case.once(SeriesFinder).found
                if one in series.position or any(step.source is one for step in series.steps)
            }
            for one in (origin, well)
        )
        return True if of_origin & of_well else None if of_origin and of_well else False

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        if not series.entered:
            yield _unknown_direction(case, series)
        steps = dilutions(case, series)
        feeding = {link.source for link in series.links}
        goes_on = [step for step in steps if step.well in feeding]  # the last well is SD-1's
        mixed = all(is_mixed(case, step) for step in goes_on or steps)
        for tip in case.trace.tips:
            here = [v for v in tip.visits if v.contact and v.well in series.position]
            yield from _one_tip(series, steps, tip, here, _MIXED if mixed else "")


def _one_tip(
    series: Series, steps: Sequence[Transfer], tip: Tip, visits: Sequence[Visit], warning: str
) -> Iterator[Result]:
    made = {(one.source, one.well) for visit in tip.visits for one in visit.brought}
    first = next((step for step in steps if (step.source, step.well) in made), None)
    excepted = {first.source, first.well} if first else set()
    strongest: tuple[int, Visit] | None = None
    reported: set[Well] = set()
    for visit in visits:
        place_here = series.position[visit.well]
        if (
            strongest is not None
            and strongest[0] < place_here
            and visit.well not in excepted | reported
        ):
            reported.add(visit.well)
            before, did = strongest[1], "touched the more concentrated well"
            yield Violation(
                f"The tip that touched the more concentrated {before.well.ref} "
                f"{at(before.line)} entered {visit.well.ref} {at(visit.line)}.",
                (site_of(before, did), site_of(visit, "entered a later well")),
                ("series tip",),
                contact=min(before.contact, visit.contact),
                warning=warning,
            )
        entered = series.entered.get(visit.well)
        holds_stock = entered is not None and entered <= visit.index
        if visit.touches and holds_stock and (strongest is None or place_here < strongest[0]):
            strongest = (place_here, visit)
