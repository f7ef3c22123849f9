"""Checks on the order in which things happen in wells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...vocabulary import Site
from ..source import comparable
from ..trace import Visit, Well
from .case import Case, RoleSet, delivered
from .check import Check, Doubt, Result, Violation, at, place, role_field


def arrivals(case: Case, well: Well, liquid: RoleSet) -> list[Visit]:
    """Visits that brought a liquid of these roles to a well.

    Not with what another well of the assay was given it in: that goes to a reader's plate, say.
    """
    return [
        visit
        for visit in case.trace.deliveries(well)
        if any(
            volume > 0
            and (
                case.has(source, liquid)
                or (case.has(origin, liquid) and _is_reagent(case, source, liquid))
            )
            for origin, volume, source, _ in delivered(visit)
        )
    ]


_MANY = 3
"""What one sample's reaction goes on to are fewer wells: a reader's, a gel's."""


def _is_reagent(case: Case, source: Well, liquid: RoleSet) -> bool:
    """Whether a well holds a reagent that the run makes or takes along, and no sample's reaction:
    many get it, or nothing else is in it.
    """
    return len(case.destinations.get(source, {})) >= _MANY or all(
        case.has(origin, liquid)
        for visit in case.trace.deliveries(source)
        for origin, _, _, _ in delivered(visit)
    )


_BY_HAND = "None of the wells that receive it is mixed in the run; that may be done by hand."


@dataclass(frozen=True)
class MixedAfter(Check):
    """Each well of ``wells`` that receives ``liquid`` is mixed after the last of it.

    Any mixing counts: ``mix``, ``mix_after``, repeated aspirating and dispensing, a shaker, or
    a pause that asks someone to shake.

    Attributes:
        liquid: Roles of the liquid.
        wells: Roles of the wells that are judged; else all that receive the liquid, but those
            that hold a reagent which the run makes and shares out.
    """

    name: ClassVar[str] = "mixed_after"
    liquid: tuple[str, ...] = role_field()
    wells: tuple[str, ...] = role_field(())

    def find(self, case: Case) -> Iterator[Result]:
        """Look for a mix after the last arrival."""
        unmixed = []
        by_hand = True
        for well, came in self._receivers(case):
            ever = case.trace.mixed_since(well, -1, math.inf)
            by_hand = by_hand and not ever and not case.destinations.get(well)
            if not (ever and case.trace.mixed_since(well, came[-1].index, math.inf)):
                unmixed.append((well, came[-1]))
        what = " or ".join(case.family.roles[role].title for role in self.liquid)
        for well, last in unmixed:
            yield Violation(
                f"{place(well)} receives {what} {at(last.line)} and is never mixed afterwards.",
                (Site(last.line, well.ref, f"received {what}, never mixed"),),
                well,
                (last.line, what),
                warning=_BY_HAND if by_hand else "",
            )

    def _receivers(self, case: Case) -> Iterator[tuple[Well, list[Visit]]]:
        """The wells that are judged, each with the visits that brought it the liquid."""
        liquid, wanted = frozenset(self.liquid), frozenset(self.wells)
        for well in case.trace.wells.values():
            if case.has(well, liquid) or (wanted and not case.has(well, wanted)):
                continue
            if well.ref in case.waste:
                continue
            if not wanted and case.destinations.get(well) and _is_reagent(case, well, liquid):
                continue
            came = arrivals(case, well, liquid)
            if came:
                yield well, came


@dataclass(frozen=True)
class ReceivedBefore(Check):
    """A well that receives both gets all of ``first`` before any of ``then``.

    Attributes:
        first: Roles of the liquid that comes first.
        then: Roles of the liquid that comes after it.
        wells: Roles of the wells that are judged; else all that receive both.
    """

    name: ClassVar[str] = "received_before"
    first: tuple[str, ...] = role_field()
    then: tuple[str, ...] = role_field()
    wells: tuple[str, ...] = role_field(())

    def find(self, case: Case) -> Iterator[Result]:
        """Compare the arrivals of both."""
        first, then = frozenset(self.first), frozenset(self.then)
        wanted = frozenset(self.wells)
        for well in case.trace.wells.values():
            if wanted and not case.has(well, wanted):
                continue
            begun = _begun(case, arrivals(case, well, then), then)
            if begun is None:
                continue
            for visit in arrivals(case, well, first):
                if visit.index <= begun.index:
                    continue
                what = " or ".join(case.family.roles[role].title for role in self.then)
                source = next(
                    (s for o, _, s, _ in delivered(visit) if case.has(o, first)), visit.well
                )
                yield Violation(
                    f"{place(well)} receives {what} {at(begun.line)}, before the "
                    f"{case.title(source)} that is added {at(visit.line)}.",
                    (
                        Site(begun.line, well.ref, f"received {what}"),
                        Site(visit.line, well.ref, f"received {case.title(source)} after it"),
                    ),
                    well,
                    (begun.line, visit.line),
                )
                break


def _begun(case: Case, came: Sequence[Visit], liquid: RoleSet) -> Visit | None:
    """When the last of several liquids of these roles first came: of two reagents one develops
    nothing without the other.
    """
    first: dict[Well | None, Visit] = {}
    for visit in came:
        for origin, volume, source, _ in delivered(visit):
            if volume > 0 and case.has(origin, liquid):
                first.setdefault(origin, visit)
            elif volume > 0 and case.has(source, liquid):
                first.setdefault(source, visit)
    return max(first.values(), key=lambda visit: visit.index, default=None)


@dataclass(frozen=True)
class RisingOrder(Check):
    """Within one tip session, liquids of ``liquid`` are dispensed in order of rising level.

    Attributes:
        liquid: Roles of the liquids.
    """

    name: ClassVar[str] = "rising_order"
    liquid: tuple[str, ...] = role_field()

    def find(self, case: Case) -> Iterator[Result]:
        """Follow each tip session's deliveries."""
        liquid = frozenset(self.liquid)
        last: dict[tuple[int, int], tuple[Well, float | None, Visit]] = {}
        doubted = False
        done: set[tuple[int, int, int]] = set()
        for visit in case.trace.visits:
            for source, volume, _, draw_line in visit.parts:
                if source is None or source is visit.well or volume <= 0:
                    continue
                if not case.has(source, liquid) or case.has(visit.well, liquid):
                    continue  # where the one is diluted to make the other, nothing is dispensed
                key = (visit.tip.number, visit.session)
                level = case.level(source)
                before = last.get(key)
                if before is not None and before[0] is not source:
                    if before[1] is None or level is None or not comparable(before[1], level):
                        if not doubted:
                            doubted = True
                            yield Doubt(
                                f"one tip dispenses {place(before[0])} and then "
                                f"{place(source)}, and nothing says which is more concentrated",
                                (before[0], source),
                            )
                    elif level < before[1] and (*key, id(source)) not in done:
                        done.add((*key, id(source)))
                        yield Violation(
                            f"The tip that dispensed {case.title(before[0])} from "
                            f"{place(before[0])} {at(before[2].line)} goes on with the less "
                            f"concentrated one from {place(source)} into {place(visit.well)} "
                            f"{at(visit.line)}.",
                            (
                                Site(before[2].line, before[0].ref, "dispensed the higher one"),
                                Site(draw_line, source.ref, "drew the lower one"),
                                Site(visit.line, visit.well.ref, "dispensed the lower one after"),
                            ),
                            visit.well,
                            (before[2].line, visit.line),
                        )
                last[key] = (source, level, visit)
