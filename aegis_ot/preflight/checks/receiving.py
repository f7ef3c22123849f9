"""Checks on what wells receive as measured volumes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...vocabulary import Site
from ..evidence import Kind
from ..trace import Well
from .case import Case, RoleSet, delivered
from .check import Check, Doubt, Result, Violation, at, place, role_field
from .received import filled, received


def _unknown_source(case: Case, well: Well, served: set[tuple[str, str]]) -> Well | None:
    """A source without a role that serves this well and others that lack the liquid too.

    It may well hold what is missing.
    """
    for visit in case.trace.deliveries(well):
        for _, _, source, _ in delivered(visit):
            if case.of(source):
                continue
            others = [
                other
                for other in case.destinations.get(source, {})
                if (other.ref.labware, other.ref.name) not in served
            ]
            if len(others) > 1:
                return source
    return None


def _last_line(case: Case, well: Well) -> int | None:
    """The line that last brought something to the labware of a well that nothing ever enters."""
    lines = [
        visit.line
        for visit in case.trace.visits
        if visit.well.ref.labware == well.ref.labware and visit.parts
    ]
    return lines[-1] if lines else None


def _never_received(
    case: Case, well: Well, title: str, given: tuple[int | None, Well, Well] | None
) -> Violation:
    """A well without the liquid of this title.

    Args:
        given: The line that draws the liquid for others, from where, and what it came from.
    """
    total, line = filled(case, well)
    message = f"The {case.title(well)} {place(well)} never receives {title}" + (
        f", though it receives {total:.4g} µL {at(line)}." if total > 0 else "."
    )
    lacking = Site(line or _last_line(case, well), well.ref, f"receives no {title}")
    if given is None:
        return Violation(message, (lacking,), well, (case.title(well),), (well,))
    others = Site(given[0], given[1].ref, f"{title} is given to other wells")
    return Violation(message, (others, lacking), well, (case.title(well),), (well, given[2]))


@dataclass(frozen=True)
class Receives(Check):
    """Every well of ``wells`` receives a liquid of ``liquid``.

    Judged only in labware where some well receives it; a plate that was replaced in a pause is
    judged together with its predecessor. Where the liquid stands on the deck by name and no well
    ever receives it, the wells of ``always`` alone are judged.

    Attributes:
        wells: Roles of the wells; those that receive nothing at all are judged only if they
            have a role of ``always``.
        liquid: Roles of the liquid.
        always: Roles whose wells are judged even if the run never touches them.
    """

    name: ClassVar[str] = "receives"
    wells: tuple[str, ...] = role_field()
    liquid: tuple[str, ...] = role_field()
    always: tuple[str, ...] = role_field(())

    def find(self, case: Case) -> Iterator[Result]:
        """Look at each well that should receive it."""
        liquid = frozenset(self.liquid)
        served = {
            (well.ref.labware, well.ref.name)
            for well in case.trace.wells.values()
            if received(case, well, liquid)[0] > 0 or case.has(well, liquid)
        }
        plates = self._plates(case, liquid)
        if not plates and self._stands_unused(case, liquid):
            plates = {ref.labware for ref, used in case.usage.items() if used.received}
            always = frozenset(self.always)
            judged = [well for well in self._judged(case) if case.has(well, always)]
        else:
            judged = list(self._judged(case))
        if not plates or not judged:
            names = ", ".join(case.family.roles[role].title for role in self.liquid)
            yield Doubt(f"no well is seen to receive {names}; it may be added by hand")
            return
        reported: set[tuple[str, str]] = set()
        given = [
            (visit.line, source, origin)
            for visit in case.trace.visits
            for origin, _, source, _ in delivered(visit)
            if case.has(origin, liquid)
        ]
        # The best evidence for what the liquid is: a comment alone makes no error.
        given.sort(key=lambda one: case.roles.is_doubtful(one[2].ref))
        title = " or ".join(case.family.roles[role].title for role in self.liquid)
        for well in judged:
            place_key = (well.ref.labware, well.ref.name)
            if place_key in served or place_key in reported:
                continue
            if well.ref.labware not in plates:
                continue
            if reason := self._why_not_judged(case, well, served):
                yield Doubt(reason)
                continue
            reported.add(place_key)
            yield _never_received(case, well, title, given[0] if given else None)

    def _why_not_judged(self, case: Case, well: Well, served: set[tuple[str, str]]) -> str:
        """Why nobody can say whether a well that lacks the liquid should have it, or ``""``."""
        if unknown := _unknown_source(case, well, served):
            return (
                f"{place(well)} receives something from {place(unknown)}, and nothing says "
                "what stands there"
            )
        sources = case.sources_of(well)
        if sources and all(case.has(source, frozenset(self.wells)) for source in sources):
            return f"{place(well)} is filled from wells like it, at a later stage perhaps"
        if case.roles.is_named_by_labware(well.ref):
            return f"nothing but its plate's name says what {place(well)} is for"
        return ""

    def _plates(self, case: Case, liquid: RoleSet) -> set[str]:
        """Labware where some well is given the liquid, and their replicates.

        A well that is given what stood in such a well before, liquid and all, is another stage.
        """
        wells = frozenset(self.wells)
        return {
            visit.well.ref.labware
            for visit in case.trace.visits
            for origin, volume, source, _ in delivered(visit)
            if volume > 0
            and (
                case.has(source, liquid)
                or (case.has(origin, liquid) and not case.has(source, wells))
            )
        }

    @staticmethod
    def _stands_unused(case: Case, liquid: RoleSet) -> bool:
        """Whether a well of its own is named for the liquid: then nobody adds it by hand."""
        return any(
            not liquid.isdisjoint(case.roles.closure(assigned.role))
            and assigned.kind >= Kind.NAME
            and not assigned.whole
            for assigned in case.roles.by_well.values()
        )

    def _judged(self, case: Case) -> Iterator[Well]:
        wanted, always = frozenset(self.wells), frozenset(self.always)
        for well in case.trace.wells.values():
            if not case.has(well, wanted):
                continue
            usage = case.usage.get(well.ref)
            if usage is not None and usage.first_drawn:
                continue
            if (usage is not None and usage.received) or case.has(well, always):
                yield well
        visited = {well.ref for well in case.trace.wells.values()}
        drawn = {ref.labware for ref, usage in case.usage.items() if usage.first_drawn}
        for ref in case.roles.by_well:
            if ref.labware in drawn:
                continue  # among sources: a tube that this run leaves out
            if ref not in visited and not always.isdisjoint(case.roles.of(ref)):
                yield Well(ref)
