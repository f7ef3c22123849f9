"""Checks on what the wells of a dilution series are filled with, and when."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...vocabulary import Site
from ..trace import Transfer, Visit, Well
from .case import Case
from .check import Check, Doubt, Result, Violation, at, place
from .dilution_steps import (
    NO_SERIES,
    diluent_arrivals,
    diluent_roles,
    is_dilution,
    stock_roles,
)
from .series import Series

_GUESSED = "Several buffers are used, and none of them is called the diluent."


@dataclass(frozen=True)
class SeriesFilledFirst(Check):
    """Every well of the series holds its diluent before the more concentrated solution."""

    name: ClassVar[str] = "series_filled_first"

    def find(self, case: Case) -> Iterator[Result]:
        """Look at what each well holds when its step comes."""
        if not case.series:
            yield Doubt(NO_SERIES)
        for series in case.series:
            done: set[Well] = set()
            for step in series.steps:
                well = step.well
                if well in done or not is_dilution(case, step) or well.prefilled:
                    continue
                if _is_undiluted_head(case, series, well):
                    continue
                done.add(well)
                fills = diluent_arrivals(case, well)
                before = first_index(step)
                if any(index < before for index in fills):
                    continue
                if not fills and wrong_fill(case, series, step) is not None:
                    continue
                if not fills and (not _anyone_filled(case) or _filled_by_hand(case, series)):
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
                yield Violation(
                    message,
                    tuple(sites),
                    well,
                    (step.visit.line, bool(fills)),
                    warning=_GUESSED if case.roles.diluent_guessed else "",
                )


@dataclass(frozen=True)
class SeriesFilledFrom(Check):
    """What the wells of the series are filled with comes from the diluent's own reservoir."""

    name: ClassVar[str] = "series_filled_from"

    def find(self, case: Case) -> Iterator[Result]:
        """Look at the source of each filling."""
        if not case.series:
            yield Doubt(NO_SERIES)
        diluent, stock = diluent_roles(case), stock_roles(case)
        spec = case.family.series
        buffers = frozenset(spec.diluent_else) if spec else frozenset()
        plates = {well.ref.labware for series in case.series for well in series.wells}
        served = case.trace.served()
        known = any(
            (ref.labware not in plates or len(served.get(ref, ())) > 1)
            and not diluent.isdisjoint(case.roles.closure(assigned.role))
            for ref, assigned in case.roles.by_well.items()
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
                if not case.of(source) and not _stands_in_for_diluent(case, series, step, source):
                    yield Doubt(f"nothing says what {place(source)} holds")
                    continue
                if case.has(source, stock) and _is_in_all(case, series, source):
                    yield Doubt(f"all wells are given {place(source)}; it may be what dilutes")
                    continue
                is_buffer = case.has(source, buffers)
                yield Violation(
                    f"{place(step.well)} is filled from the {case.title(source)} "
                    f"{place(source)}, {at(line)}, where its diluent "
                    "should come.",
                    (
                        Site(line, source.ref, "drew this in the diluent's place"),
                        Site(visit.line, step.well.ref, "filled with it"),
                    ),
                    step.well,
                    (visit.line, id(source)),
                    warning=_GUESSED if case.roles.diluent_guessed and is_buffer else "",
                )

    @staticmethod
    def _wants(case: Case, series: Series, step: Transfer) -> bool:
        """Whether a first well that gets stock was meant to be diluted: something came before."""
        return wrong_fill(case, series, step) is not None


def _stands_in_for_diluent(case: Case, series: Series, step: Transfer, source: Well) -> bool:
    """Whether a well gets as much of this as another one of its series gets of the diluent."""
    given = sum(visit.volume for visit in case.straight(source, step.well))
    volumes = [
        sum(visit.volume for visit in case.straight(other, well))
        for well in series.wells
        for other in case.sources_of(well)
        if case.has(other, diluent_roles(case))
    ]
    return any(abs(given - volume) <= 0.05 * volume for volume in volumes)


def _is_in_all(case: Case, series: Series, source: Well) -> bool:
    """Whether all wells of a chain are given this, and its head another liquid that it dilutes."""
    linked = {well for link in series.links for well in (link.source, link.well)}
    heads = linked - {link.well for link in series.links}
    return linked <= case.destinations.get(source, {}).keys() and any(
        case.sources_of(head) - linked - {source} for head in heads
    )


def first_index(step: Transfer) -> int:
    """Index of the first delivery of a step that took several."""
    return min(
        visit.index
        for visit in step.well.visits
        if any(part[0] is step.source for part in visit.parts)
    )


def _anyone_filled(case: Case) -> bool:
    return any(diluent_arrivals(case, well) for series in case.series for well in series.wells)


def _filled_by_hand(case: Case, series: Series) -> bool:
    """Whether most wells of a chain get no diluent, and are drawn from as if they held some."""
    reached = {link.well for link in series.links}
    unfilled = {well for well in reached if not diluent_arrivals(case, well)}
    beyond = {one.visit.well for one in case.trace.imbalances if not one.overfilled}
    return 2 * len(unfilled) > len(reached) and 2 * len(unfilled & beyond) > len(unfilled)


def _is_undiluted_head(case: Case, series: Series, well: Well) -> bool:
    """Whether this is the first well of the series, and stock went into it while it was empty.

    It needs no diluent, and a later transfer into it runs the wrong way, which is SD-2's.
    """
    first = next(case.trace.deliveries(well), None)
    if not series.directed or series.position[well] != 0:
        return False
    stock = stock_roles(case)
    drawn = [first_index(link) for link in series.links if link.source is well]
    if drawn and any(index < min(drawn) for index in diluent_arrivals(case, well)):
        return False
    return (
        first is not None
        and first.empty_before
        and any(part[0] is not None and case.has(part[0], stock) for part in first.parts)
    )


def wrong_fill(case: Case, series: Series, step: Transfer) -> tuple[Visit, Well, int | None] | None:
    """What a well of the series was filled with in the diluent's place, if anything."""
    diluent, members = diluent_roles(case), set(series.wells)
    if diluent_arrivals(case, step.well) or _is_undiluted_head(case, series, step.well):
        return None
    before = first_index(step)
    for visit in case.trace.deliveries(step.well):
        if visit.index >= before:
            return None
        for source, volume, _, line in visit.parts:
            if source is None or source is step.well or source in members or volume <= 0:
                continue
            if not case.has(source, diluent) and source is not step.source:
                return visit, source, line
    return None
