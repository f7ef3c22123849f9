"""Checks on what the wells of a dilution series are filled with, and when."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
    is_used_up,
    stock_roles,
)
from .series import Series


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
                if fills and _something_after(case, series, well, fills):
                    yield Doubt("nothing says which liquid of the first well is diluted")
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
                yield Violation(message, tuple(sites), well, (step.visit.line, bool(fills)))


@dataclass(frozen=True)
class SeriesFilledFrom(Check):
    """What the wells of the series are filled with comes from the diluent's own reservoir."""

    name: ClassVar[str] = "series_filled_from"

    def find(self, case: Case) -> Iterator[Result]:
        """Look at the source of each filling."""
        if not case.series:
            yield Doubt(NO_SERIES)
        diluent, stock = diluent_roles(case), stock_roles(case)
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
                if not known and (not case.has(source, stock) or _added_by_hand(series, source)):
                    yield Doubt("nothing says which reservoir holds the diluent")
                    return
                if not case.of(source) and (
                    _fills_a_series_alone(case, series, source)
                    or not _as_much_as_diluent(case, series, step, source)
                ):
                    yield Doubt(f"nothing says what {place(source)} holds")
                    continue
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
    def _wants(case: Case, series: Series, step: Transfer) -> bool:
        """Whether a first well that gets stock was meant to be diluted: something came before."""
        return wrong_fill(case, series, step) is not None


def _something_after(case: Case, series: Series, well: Well, fills: Sequence[int]) -> bool:
    """Whether a liquid comes into a head after its diluent and before it is drawn from."""
    drawn = [link for link in series.links if link.source is well]
    if not drawn or any(link.well is well for link in series.links):
        return False
    before = min(first_index(link) for link in drawn)
    diluent, members = diluent_roles(case), set(series.wells)
    return any(
        source is not None
        and source not in members
        and source not in case.fillers
        and not case.has(source, diluent)
        for visit in case.trace.deliveries(well)
        if fills[0] < visit.index < before
        for source, _, _, _ in visit.parts
    )


def _added_by_hand(series: Series, source: Well) -> bool:
    """Whether all wells of a chain are given this, and someone may have added to its head."""
    linked = {well for link in series.links for well in (link.source, link.well)}
    heads = linked - {link.well for link in series.links}
    return all(_given(well, source) > 0 for well in linked) and all(
        not well.known and not well.prefilled for well in heads
    )


def _fills_a_series_alone(case: Case, series: Series, source: Well) -> bool:
    """Whether one series is filled from this and another from a diluent in the same labware.

    Each may have a diluent of its own; wells of one series that differ are a mistake.
    """
    if any(diluent_arrivals(case, well) for well in series.wells):
        return False
    diluent = diluent_roles(case)
    return any(
        other is not None and other.ref.labware == source.ref.labware and case.has(other, diluent)
        for beside in case.series
        if beside is not series
        for well in beside.wells
        for visit in case.trace.deliveries(well)
        for other, _, _, _ in visit.parts
    )


def _as_much_as_diluent(case: Case, series: Series, step: Transfer, source: Well) -> bool:
    """Whether a well is given as much of this as another one of the series of its diluent."""
    here = _given(step.well, source)
    diluent = diluent_roles(case)
    volumes = [
        _given(well, other)
        for well in series.wells
        for other in {part[0] for visit in case.trace.deliveries(well) for part in visit.parts}
        if other is not None and case.has(other, diluent)
    ]
    return not volumes or any(abs(here - volume) <= 0.05 * volume for volume in volumes)


def _given(well: Well, source: Well) -> float:
    """µL that a well is given from a source."""
    return sum(part[1] for visit in well.visits for part in visit.parts if part[0] is source)


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
    given = first.parts[0][0] if first is not None and first.parts else None
    if not series.directed or series.position[well] != 0 or is_used_up(case, well, given):
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
