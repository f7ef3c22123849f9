"""Checks on the order in which things happen in wells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...vocabulary import Site
from ..rules import role_names
from ..source import comparable
from ..trace import Transfer, Visit, Well
from .check import Check, Doubt, Result, Violation, site_of
from .rule_context import RoleSet, RuleContext, at


def arrivals(case: RuleContext, well: Well, liquid: RoleSet) -> list[Transfer]:
    """What brought a liquid of these roles to a well.

    Not with what another well of the assay was given it in: that goes to a reader's plate, say.
    """
    return [
        one
        for one in well.received
        if case.has(one.source, liquid)
        or (case.brings(one, liquid) and _is_reagent(case, one.source, liquid))
    ]


_MANY = 3
"""What one sample's reaction goes on to are fewer wells: a reader's, a gel's."""


def _is_reagent(case: RuleContext, source: Well, liquid: RoleSet) -> bool:
    """Whether a well holds a reagent that the run makes or takes along, and no sample's reaction:
    many get it, or nothing else is in it.
    """
    return len(case.destinations.get(source, {})) >= _MANY or all(
        case.has(origin, liquid) for one in source.received for origin in one.liquid
    )


_BY_HAND = "None of the wells that receive it is mixed in the run; that may be done by hand."


@dataclass(frozen=True)
class MixedAfter(Check):
    """Each well that receives ``liquid`` is mixed after the last of it, but those that hold a
    reagent which the run makes and shares out.

    Any mixing counts: ``mix``, ``mix_after``, repeated aspirating and dispensing, a shaker, or
    a pause that asks someone to shake.

    Attributes:
        liquid: Roles of the liquid.
    """

    liquid: tuple[str, ...] = role_names(required=True)

    def find(self, case: RuleContext) -> Iterator[Result]:
        receivers = list(self._receivers(case))
        by_hand = not any(
            case.destinations.get(well) or case.trace.mixed_since(well, -1, math.inf)
            for well, _ in receivers
        )
        what = case.titles(self.liquid)
        for well, last in receivers:
            if case.trace.mixed_since(well, last.index, math.inf):
                continue
            yield Violation(
                f"{well.ref} receives {what} {at(last.line)} and is never mixed afterwards.",
                (site_of(last, f"received {what}, never mixed"),),
                (what,) if by_hand else (last.line, what),
                warning=_BY_HAND if by_hand else "",
            )

    def _receivers(self, case: RuleContext) -> Iterator[tuple[Well, Visit]]:
        """The wells that are judged, each with the visit that brought the last of the liquid."""
        for well in case.trace.wells.values():
            if case.has(well, self.liquid) or well.ref in case.waste:
                continue
            if case.destinations.get(well) and _is_reagent(case, well, self.liquid):
                continue
            came = arrivals(case, well, self.liquid)
            if came:
                yield well, came[-1].visit


@dataclass(frozen=True)
class ReceivedBefore(Check):
    """A well that receives both gets all of ``first`` before any of ``then``.

    Attributes:
        first: Roles of the liquid that comes first.
        then: Roles of the liquid that comes after it.
    """

    first: tuple[str, ...] = role_names(required=True)
    then: tuple[str, ...] = role_names(required=True)

    def find(self, case: RuleContext) -> Iterator[Result]:
        for well in case.trace.wells.values():
            begun = _begun(case, arrivals(case, well, self.then), self.then)
            if begun is None:
                continue
            late = [
                one for one in arrivals(case, well, self.first) if one.visit.index > begun.index
            ]
            for one in late[:1]:
                what = case.titles(self.then)
                title, line = case.title(one.source), one.visit.line
                yield Violation(
                    f"{well.ref} receives {what} {at(begun.line)}, before the "
                    f"{title} that is added {at(line)}.",
                    (
                        site_of(begun, f"received {what}"),
                        site_of(one.visit, f"received {title} after it"),
                    ),
                    (begun.line, line),
                )


def _begun(case: RuleContext, came: Sequence[Transfer], liquid: RoleSet) -> Visit | None:
    """When the last of several liquids of these roles first came: of two reagents one develops
    nothing without the other.
    """
    first: dict[Well, Visit] = {}
    for one, origin in ((brought, o) for brought in came for o in brought.liquid):
        holder = origin if case.has(origin, liquid) else one.source
        if case.has(holder, liquid):
            first.setdefault(holder, one.visit)
    return max(first.values(), key=lambda visit: visit.index, default=None)


@dataclass(frozen=True)
class RisingOrder(Check):
    """Within one tip session, liquids of ``liquid`` are dispensed in order of rising level.

    Attributes:
        liquid: Roles of the liquids.
    """

    liquid: tuple[str, ...] = role_names(required=True)

    def claims(self, case: RuleContext, origin: Well, well: Well) -> bool | None:
        """As one of its liquids in another, or where another is given."""
        held = (well, *case.meant.get(well, ()))
        if case.of(origin) and not case.has(origin, self.liquid):
            return False
        if any(case.has(one, self.liquid) for one in held):
            return True if case.of(origin) else None
        return False if all(map(case.of, held)) else None

    def find(self, case: RuleContext) -> Iterator[Result]:
        last: dict[tuple[int, int], Transfer] = {}
        done: set[tuple[int, int, Well]] = set()
        for one in case.trace.transfers:
            source, visit = one.source, one.visit
            if not case.has(source, self.liquid) or case.has(one.well, self.liquid):
                continue  # where the one is diluted to make the other, nothing is dispensed
            key = (visit.tip.number, visit.session)
            before = last.get(key)
            last[key] = one
            if before is None or before.source is source:
                continue
            was = before.visit
            level, level_before = case.roles.level(source.ref), case.roles.level(before.source.ref)
            if level_before is None or level is None or not comparable(level_before, level):
                yield Doubt(
                    f"one tip dispenses {before.source.ref} and then "
                    f"{source.ref}, and nothing says which is more concentrated",
                    (before.source, source),
                )
            elif level < level_before and (*key, source) not in done:
                done.add((*key, source))
                yield Violation(
                    f"The tip that dispensed {case.title(before.source)} from "
                    f"{before.source.ref} {at(was.line)} goes on with the less "
                    f"concentrated one from {source.ref} into {one.well.ref} "
                    f"{at(visit.line)}.",
                    (
                        Site(was.line, before.source.ref, "dispensed the higher one", was.index),
                        Site(one.drawn, source.ref, "drew the lower one"),
                        site_of(visit, "dispensed the lower one after"),
                    ),
                    (was.line, visit.line),
                )
