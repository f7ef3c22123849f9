"""Checks on dilution series."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...instrumentation import OperationKind
from ...vocabulary import Site
from ..series import Series, Step
from ..trace import Visit
from ..wells import Well
from .base import Case, Check, Doubt, Result, Violation, at, place

_NO_SERIES = "no chain of transfers from well to well was found"


def _diluent(case: Case) -> frozenset[str]:
    spec = case.family.series
    return frozenset(spec.diluent) if spec else frozenset()


def _stock(case: Case) -> frozenset[str]:
    spec = case.family.series
    return frozenset(spec.stock) if spec else frozenset()


def _diluent_arrivals(case: Case, well: Well) -> list[int]:
    diluent = _diluent(case)
    return [
        visit.index
        for visit in case.trace.deliveries(well)
        if any(part[0] is not None and case.has(part[0], diluent) for part in visit.parts)
    ]


def is_dilution(case: Case, step: Step) -> bool:
    """Whether a transfer is a dilution step.

    Undiluted stock in an empty first well is none: that well never gets diluent.
    """
    if not step.from_stock:
        return True
    return bool(_diluent_arrivals(case, step.well)) or case.has(step.well, _diluent(case))


@dataclass(frozen=True)
class SeriesMixed(Check):
    """Every dilution step is mixed in its well before liquid is drawn on from there."""

    name: ClassVar[str] = "series_mixed"

    def find(self, case: Case) -> Iterator[Result]:
        """Look for a mix between each step and the next draw from its well."""
        if not case.series:
            yield Doubt(_NO_SERIES)
        for series in case.series:
            for step in series.steps:
                if not is_dilution(case, step):
                    continue
                drawn = _next_draw(step)
                before = drawn.index if drawn else math.inf
                if case.trace.mixed_since(step.well, step.visit.index, before):
                    continue
                carried_on = (
                    f" before liquid is carried on {at(drawn.line)}" if drawn else " afterwards"
                )
                yield Violation(
                    f"The dilution into {place(step.well)} {at(step.visit.line)} is not mixed"
                    f"{carried_on}.",
                    (
                        Site(step.drawn, step.source.ref, "drew the more concentrated solution"),
                        Site(step.visit.line, step.well.ref, "diluted here, not mixed"),
                    ),
                    step.well,
                    (step.visit.line,),
                )


def _next_draw(step: Step) -> Visit | None:
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
class SeriesDirection(Check):
    """The series runs from the most to the least concentrated well, one well at a time."""

    name: ClassVar[str] = "series_direction"

    def find(self, case: Case) -> Iterator[Result]:
        """Compare each link with the order of the series."""
        if not case.series:
            yield Doubt(_NO_SERIES)
        for series in case.series:
            if not series.directed:
                yield Doubt("nothing says which end of the series holds the stock")
            for step in series.links:
                jump = series.position[step.well] - series.position[step.source]
                if jump == 1:
                    continue
                if jump < 0:
                    what = "towards the more concentrated end"
                    if not series.directed:
                        continue
                else:
                    what = f"skipping {jump - 1} well{'s' if jump > 2 else ''} of the series"
                yield Violation(
                    f"The dilution runs {what}: from {place(step.source)} {at(step.drawn)} into "
                    f"{place(step.well)} {at(step.visit.line)}.",
                    (
                        Site(step.drawn, step.source.ref, "drew from here"),
                        Site(step.visit.line, step.well.ref, f"diluted {what}"),
                    ),
                    step.well,
                    (step.visit.line, jump < 0),
                )


@dataclass(frozen=True)
class SeriesFilledFirst(Check):
    """Every well of the series holds its diluent before the more concentrated solution."""

    name: ClassVar[str] = "series_filled_first"

    def find(self, case: Case) -> Iterator[Result]:
        """Look at what each well holds when its step comes."""
        if not case.series:
            yield Doubt(_NO_SERIES)
        for series in case.series:
            done: set[Well] = set()
            for step in series.steps:
                well = step.well
                if well in done or not is_dilution(case, step) or well.prefilled:
                    continue
                done.add(well)
                fills = _diluent_arrivals(case, well)
                before = _first_index(step)
                if any(index < before for index in fills):
                    continue
                if not fills and wrong_fill(case, series, step) is not None:
                    continue
                if not fills and not _anyone_filled(case):
                    yield Doubt("no diluent is seen to be added; it may be there already")
                    return
                message = (
                    f"{place(well)} receives the more concentrated solution {at(step.visit.line)} "
                    + ("before its diluent." if fills else "and never any diluent.")
                )
                sites = [
                    Site(step.drawn, step.source.ref, "drew the more concentrated solution"),
                    Site(step.visit.line, well.ref, "no diluent there yet"),
                ]
                if fills:
                    late = next(v for v in well.visits if v.index == fills[0])
                    sites.append(Site(late.line, well.ref, "the diluent comes only here"))
                yield Violation(message, tuple(sites), well, (step.visit.line, bool(fills)))


def _first_index(step: Step) -> int:
    """Index of the first delivery of a step that took several."""
    return min(
        visit.index
        for visit in step.well.visits
        if any(part[0] is step.source for part in visit.parts)
    )


def _anyone_filled(case: Case) -> bool:
    return any(_diluent_arrivals(case, well) for series in case.series for well in series.wells)


def wrong_fill(case: Case, series: Series, step: Step) -> tuple[Visit, Well, int | None] | None:
    """What a well of the series was filled with in the diluent's place, if anything."""
    diluent, members = _diluent(case), set(series.wells)
    if _diluent_arrivals(case, step.well):
        return None
    before = _first_index(step)
    for visit in case.trace.deliveries(step.well):
        if visit.index >= before:
            return None
        for source, volume, _, line in visit.parts:
            if source is None or source is step.well or source in members or volume <= 0:
                continue
            if not case.has(source, diluent) and source is not step.source:
                return visit, source, line
    return None


@dataclass(frozen=True)
class SeriesFilledFrom(Check):
    """What the wells of the series are filled with comes from the diluent's own reservoir."""

    name: ClassVar[str] = "series_filled_from"

    def find(self, case: Case) -> Iterator[Result]:
        """Look at the source of each filling."""
        if not case.series:
            yield Doubt(_NO_SERIES)
        diluent, stock = _diluent(case), _stock(case)
        known = any(
            not diluent.isdisjoint(case.roles.closure(assigned.role))
            for assigned in case.roles.by_well.values()
        )
        for series in case.series:
            done: set[Well] = set()
            for step in series.steps:
                if step.well in done or (step.from_stock and not self._wants(case, series, step)):
                    continue
                done.add(step.well)
                wrong = wrong_fill(case, series, step)
                if wrong is None:
                    continue
                visit, source, line = wrong
                if not known and not case.has(source, stock):
                    yield Doubt("nothing says which reservoir holds the diluent")
                    return
                what = (
                    f"the {case.title(source)} {place(source)}"
                    if case.of(source)
                    else f"{place(source)}, which is not the diluent"
                )
                yield Violation(
                    f"{place(step.well)} is filled from {what}, {at(line)}, where its diluent "
                    "should come.",
                    (
                        Site(line, source.ref, "drew this in the diluent's place"),
                        Site(visit.line, step.well.ref, "filled with it"),
                    ),
                    step.well,
                    (visit.line, id(source)),
                )

    @staticmethod
    def _wants(case: Case, series: Series, step: Step) -> bool:
        """Whether a first well that gets stock was meant to be diluted: something came before."""
        return wrong_fill(case, series, step) is not None


@dataclass(frozen=True)
class SeriesTip(Check):
    """A tip that has touched a more concentrated well touches no later well of the series.

    The two wells of the first step that it makes are excepted.
    """

    name: ClassVar[str] = "series_tip"

    def find(self, case: Case) -> Iterator[Result]:
        """Follow each tip along each series."""
        if not case.series:
            yield Doubt(_NO_SERIES)
        for series in case.series:
            yield from self._along(case, series)

    def _along(self, case: Case, series: Series) -> Iterator[Result]:
        by_tip: dict[int, list[Visit]] = {}
        for well in series.wells:
            for visit in well.visits:
                if visit.below:
                    by_tip.setdefault(visit.tip.number, []).append(visit)
        dilutions = [step for step in series.steps if is_dilution(case, step)]
        for visits in by_tip.values():
            visits.sort(key=lambda visit: visit.index)
            yield from self._one_tip(case, series, dilutions, visits)

    def _one_tip(
        self, case: Case, series: Series, dilutions: list[Step], visits: list[Visit]
    ) -> Iterator[Result]:
        tip = visits[0].tip
        first = next((step for step in dilutions if _made_by(step, tip.number)), None)
        excepted = {first.source, first.well} if first else set()
        strongest: tuple[int, Visit] | None = None
        reported: set[Well] = set()
        for visit in visits:
            place_here = series.position[visit.well]
            if (
                strongest is not None
                and strongest[0] < place_here
                and visit.well not in excepted
                and visit.well not in reported
            ):
                reported.add(visit.well)
                before = strongest[1]
                yield Violation(
                    f"The tip that touched the more concentrated {place(before.well)} "
                    f"{at(before.line)} entered {place(visit.well)} {at(visit.line)}.",
                    (
                        Site(before.line, before.well.ref, "touched the more concentrated well"),
                        Site(visit.line, visit.well.ref, "entered a later well"),
                    ),
                    visit.well,
                    ("series tip",),
                )
            entered = series.entered.get(visit.well)
            holds_stock = entered is not None and entered <= visit.index
            if visit.touch and holds_stock and (strongest is None or place_here < strongest[0]):
                strongest = (place_here, visit)


def _made_by(step: Step, tip: int) -> bool:
    return any(
        visit.tip.number == tip and any(part[0] is step.source for part in visit.parts)
        for visit in step.well.visits
    )
