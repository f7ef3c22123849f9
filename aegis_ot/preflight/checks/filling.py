"""Checks on what the wells of a dilution series are filled with, and when."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from ...vocabulary import Site
from ..trace import Transfer, Well
from .check import Doubt, Result, Violation, site_of
from .dilution import SeriesCheck, diluent_arrivals, dilutions
from .rule_context import RuleContext, at
from .series import Series, SeriesFinder, first_of, wells_of

_GUESSED = "Several buffers are used, and none of them is called the diluent."


@dataclass(frozen=True)
class SeriesFilledFirst(SeriesCheck):
    """Every well of the series holds its diluent before the more concentrated solution."""

    def demanded(self, case: RuleContext) -> Collection[str]:
        return (*case.family.series.diluent, *case.family.series.diluent_else)

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        done: set[Well] = set()
        for step in dilutions(case, series):
            well = step.well
            if well in done or well.prefilled or _is_undiluted_head(case, series, well):
                continue
            done.add(well)
            fills = diluent_arrivals(case, well)
            if fills and fills[0] < first_of(step).index:
                continue
            if not fills and wrong_fill(case, series, step) is not None:
                continue
            if not fills and (why := case.left_out(well, self.demanded(case))):
                yield Doubt(f"{well.ref} is given no diluent: {why}")
                continue
            if not fills and _filled_by_hand(case, series):
                yield Doubt("no diluent is seen to be added; it may be there already")
                return
            sites = [
                Site(step.drawn, step.source.ref, "drew the more concentrated solution"),
                site_of(step.visit, "no diluent there yet"),
            ]
            if fills:
                late = next(v for v in well.visits if v.index == fills[0])
                sites.append(site_of(late, "the diluent comes only here"))
            yield Violation(
                f"{well.ref} receives the more concentrated solution {at(step.visit.line)} "
                + ("before its diluent." if fills else "and never any diluent."),
                tuple(sites),
                (step.visit.line, bool(fills)),
                warning=_GUESSED if case.roles.diluent_guessed else "",
            )


@dataclass(frozen=True)
class SeriesFilledFrom(SeriesCheck):
    """What the wells of the series are filled with comes from the diluent's own reservoir."""

    def along(self, case: RuleContext, series: Series) -> Iterator[Result]:
        diluent = case.family.series.diluent
        for source in case.wells(diluent):
            if not case.roles.is_called(source.ref, (*diluent, *case.family.series.diluent_else)):
                yield Doubt(
                    f"nothing says that {source.ref}, which fills the series, is the diluent",
                    roles_of=(source,),
                )
        done: set[Well] = set()
        for step in series.steps:
            wrong = wrong_fill(case, series, step)
            if wrong is None or step.well in done:
                continue
            done.add(step.well)
            source = wrong.source
            if not case.has(source, case.family.series.stock) and not _is_diluent_known(case):
                why = "nothing says which reservoir holds the diluent"
                yield Doubt(why, roles_of=(source,), role=diluent[0])
                return
            if not case.of(source):
                yield Doubt(f"nothing says what {source.ref} holds", roles_of=(source,))
                continue
            if case.has(source, case.family.series.stock) and _is_in_all(case, series, source):
                yield Doubt(f"all wells are given {source.ref}; it may be what dilutes")
                continue
            is_buffer = case.has(source, case.family.series.diluent_else)
            yield Violation(
                f"{step.well.ref} is filled from the {case.title(source)} "
                f"{source.ref}, {at(wrong.drawn)}, where its diluent should come.",
                (
                    Site(wrong.drawn, source.ref, "drew this in the diluent's place"),
                    site_of(wrong.visit, "filled with it"),
                ),
                (wrong.visit.line, id(source)),
                warning=_GUESSED if case.roles.diluent_guessed and is_buffer else "",
            )


def _is_diluent_known(case: RuleContext) -> bool:
    """Whether some reservoir, or some well of a plate that serves several, is the diluent's."""
    plates = {
        well.ref.labware for series in case.once(SeriesFinder).found for well in series.position
    }
    served = case.trace.served
    return any(
        (ref.labware not in plates or len(served.get(ref, ())) > 1)
        and case.roles.is_called(ref, case.family.series.diluent)
        for ref in case.roles.by_well
    )


def _is_in_all(case: RuleContext, series: Series, source: Well) -> bool:
    """Whether all wells of a chain are given this, and its head another liquid that it dilutes."""
    linked = set(wells_of(series.links))
    heads = linked - {link.well for link in series.links}
    return linked <= case.destinations.get(source, {}).keys() and any(
        one.source not in linked and one.source is not source
        for head in heads
        for one in head.received
    )


def _filled_by_hand(case: RuleContext, series: Series) -> bool:
    """Whether the run fills no series, or most wells of a chain get no diluent, and are drawn from
    as if they held some.
    """
    if not any(
        diluent_arrivals(case, well)
        for one in case.once(SeriesFinder).found
        for well in one.position
    ):
        return True
    reached = {link.well for link in series.links}
    unfilled = {well for well in reached if not diluent_arrivals(case, well)}
    beyond = {one.visit.well for one in case.trace.imbalances if not one.overfilled}
    return 2 * len(unfilled) > len(reached) and 2 * len(unfilled & beyond) > len(unfilled)


def _is_undiluted_head(case: RuleContext, series: Series, well: Well) -> bool:
    """Whether this is the first well of the series, and stock went into it while it was empty.

    It needs no diluent, and a later transfer into it runs the wrong way, which is SD-2's.
    """
    if not series.directed or series.position[well] != 0 or not well.received:
        return False
    drawn = [first_of(link).index for link in series.links if link.source is well]
    if drawn and any(index < min(drawn) for index in diluent_arrivals(case, well)):
        return False
    first = well.received[0].visit
    return first.empty_before and any(
        case.has(one.source, case.family.series.stock) for one in first.brought
    )


def wrong_fill(case: RuleContext, series: Series, step: Transfer) -> Transfer | None:
    """What a well of the series was filled with in the diluent's place, if anything."""
    if diluent_arrivals(case, step.well) or _is_undiluted_head(case, series, step.well):
        return None
    before = first_of(step).index
    return next(
        (
            one
            for one in step.well.received
            if one.visit.index < before and one.source not in series.position
        ),
        None,
    )
