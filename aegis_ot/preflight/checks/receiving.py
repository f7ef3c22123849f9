"""What wells receive as measured volumes, and the checks on it."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from ...vocabulary import Site, WellRef
from ..evidence import Kind
from ..rules import role_names
from ..trace import EMPTY_UL, Transfer, Usage, Well
from .check import Check, Doubt, Result, Violation, microlitres, site_of
from .rule_context import RoleSet, RuleContext, at

_MOST_TUBES = 24
"""Labware of no more wells is a rack or a reservoir, in which various things stand."""


def received(case: RuleContext, well: Well, liquid: RoleSet) -> tuple[float, int | None]:
    """µL of a liquid that a well receives in the run, and the line that first brought it."""
    total, line = 0.0, None
    for one in well.received:
        share = sum(part for origin, part in one.liquid.items() if case.has(origin, liquid))
        if not share and case.has(one.source, liquid):
            share = 1.0  # it stood there mixed before the run
        if share:
            total += one.volume * share
            line = line or one.visit.line
    return total, line


def filled(well: Well) -> tuple[float, int | None]:
    """µL that a well receives in the run altogether, and the line that brought the last."""
    line = well.received[-1].visit.line if well.received else None
    return sum(one.volume for one in well.received), line


def came_from(case: RuleContext, well: Well, liquid: RoleSet) -> set[Well]:
    """The wells that a liquid came into this one from.

    Those that it stood in to begin with; where the run makes it, those of what it is made of.
    """
    stood = {origin for origin in case.meant.get(well, {}) if case.has(origin, liquid)}
    if stood:
        return stood
    made_in = {one.source for one in well.received if case.has(one.source, liquid)}
    return {part for made in made_in for part in case.meant.get(made, {made: 0})}


def is_made_of(case: RuleContext, well: Well, wells: RoleSet) -> bool:
    """Whether a well is filled from such wells alone, or from what they were cleaned up in: a later
    stage, a gel.
    """

    def passes_on(source: Well) -> bool:
        return any(case.has(one, wells) for one in (source, *(r.source for r in source.received)))

    return bool(well.received) and all(passes_on(one.source) for one in well.received)


def _unknown_source(case: RuleContext, well: Well, served: set[WellRef]) -> Well | None:
    """A source without a role that serves this well and others that lack the liquid too.

    It may well hold what is missing.
    """
    for source in (one.source for one in well.received if not case.of(one.source)):
        if sum(other.ref not in served for other in case.destinations[source]) > 1:
            return source
    return None


def _last_line(case: RuleContext, well: Well) -> int | None:
    """The line that last brought something to the labware of a well that nothing ever enters."""
    latest, key = reversed(case.trace.transfers), well.ref.labware
    return next((one.visit.line for one in latest if one.well.ref.labware == key), None)


def _never_received(
    case: RuleContext, well: Well, title: str, given: tuple[int | None, Well, Well] | None
) -> Violation:
    """A well without a liquid that others are ``given``: at which line, whence, what it was."""
    total, line = filled(well)
    message = f"The {case.title(well)} {well.ref} never receives {title}" + (
        f", though it receives {microlitres(total)} {at(line)}." if total > 0 else "."
    )
    lacking = Site(line or _last_line(case, well), well.ref, f"receives no {title}")
    if given is None:
        return Violation(message, (lacking,), (case.title(well),), (well,))
    others = Site(given[0], given[1].ref, f"{title} is given to other wells")
    return Violation(message, (others, lacking), (case.title(well),), (well, given[2]))


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

    wells: tuple[str, ...] = role_names(required=True)
    liquid: tuple[str, ...] = role_names(required=True)
    always: tuple[str, ...] = role_names()

    def demanded(self, case: RuleContext) -> Collection[str]:
        return self.liquid

    def find(self, case: RuleContext) -> Iterator[Result]:
        liquid = self.liquid
        served = {
            well.ref
            for well in case.trace.wells.values()
            if received(case, well, liquid)[0] > 0 or case.has(well, liquid)
        }
        plates, judged = self._plates(case), list(self._judged(case))
        if not plates and (why := case.left_out(None, liquid)):
            yield Doubt(f"no well receives {case.titles(liquid)}: {why}")
            return
        if not plates and self._stands_unused(case):
            plates = {ref.labware for ref, used in case.trace.usage.items() if used.received}
            judged = [well for well in judged if case.has(well, self.always)]
        if not plates:
            names = case.titles(liquid, ", ")
            yield Doubt(f"no well is seen to receive {names}; it may be added by hand")
            return
        if not judged:
            there = [well for well in case.trace.wells.values() if well.ref.labware in plates]
            why = f"nothing says which well is the {case.titles(self.wells)}"
            yield Doubt(why, roles_of=tuple(there), role=self.wells[0])
            return
        reported: set[WellRef] = set()
        given = [
            (one.visit.line, one.source, origin)
            for one in case.trace.transfers
            for origin in one.liquid
            if case.has(origin, liquid)
        ]
        # The best evidence for what the liquid is: a comment alone makes no error.
        given.sort(key=lambda one: case.roles.is_doubtful(one[2].ref))
        title = case.titles(liquid)
        for well in judged:
            if well.ref in served | reported or well.ref.labware not in plates:
                continue
            if reason := self._why_not_judged(case, well, served):
                yield Doubt(reason)
                continue
            reported.add(well.ref)
            yield _never_received(case, well, title, given[0] if given else None)

    def _why_not_judged(self, case: RuleContext, well: Well, served: set[WellRef]) -> str:
        """Why nobody can say whether a well that lacks the liquid should have it, or ``""``."""
        if unknown := _unknown_source(case, well, served):
            return (
                f"{well.ref} receives something from {unknown.ref}, and nothing says "
                "what stands there"
            )
        if why := case.left_out(well, self.liquid):
            return f"{well.ref} receives no {case.titles(self.liquid)}: {why}"
        if self._held_more(case, well):
            return f"more is drawn from {well.ref} than the run puts there: it held more before"
        if is_made_of(case, well, self.wells):
            return f"{well.ref} is filled from wells like it, at a later stage perhaps"
        if case.roles.is_named_by_labware(well.ref):
            return f"nothing but its plate's name says what {well.ref} is for"
        return ""

    def _held_more(self, case: RuleContext, well: Well) -> bool:
        """Whether a well that is no control, and gets nothing of its own, is drawn from as if it
        had held something: product in a clean-up. What is missing where a sample comes is the mix.
        """
        return (
            any(
                one.visit.well is well and not one.overfilled and not one.visit.mixing
                for one in case.trace.imbalances
            )
            and not case.has(well, self.always)
            and bool(well.received)
            and all(case.is_one_liquid(one.source) for one in well.received)
        )

    def _plates(self, case: RuleContext) -> set[str]:
        """Labware where some well is given the liquid, and their replicates.

        A well that is given what stood in such a well before, liquid and all, is another stage.
        """
        return {
            one.well.ref.labware
            for one in case.trace.transfers
            if case.has(one.source, self.liquid)
            or (case.brings(one, self.liquid) and not case.has(one.source, self.wells))
        }

    def _stands_unused(self, case: RuleContext) -> bool:
        """Whether a well of its own is named for the liquid: then nobody adds it by hand."""
        return any(
            assigned.kind >= Kind.NAME
            and not assigned.whole
            and case.roles.is_called(ref, self.liquid)
            for ref, assigned in case.roles.by_well.items()
        )

    def _judged(self, case: RuleContext) -> Iterator[Well]:
        for well in case.trace.wells.values():
            if not case.has(well, self.wells) or self._is_circular(case, well):
                continue
            usage = case.trace.usage.get(well.ref, Usage())
            if not usage.first_drawn and (usage.received or case.has(well, self.always)):
                yield well
        visited = {well.ref for well in case.trace.wells.values()}
        drawn = {ref.labware for ref, usage in case.trace.usage.items() if usage.first_drawn}
        for ref in case.roles.by_well:
            if ref.labware in drawn:
                continue  # among sources: a tube that this run leaves out
            if ref not in visited and case.roles.has(ref, self.always):
                yield Well(ref)

    def _is_circular(self, case: RuleContext, well: Well) -> bool:
        """Whether only the liquid in question tells what the well is: its control's tube."""
        if well.ref not in case.roles.followed:
            return False
        roles = case.family.roles
        return any(set(self.liquid) & set(roles[role].follows) for role in case.of(well))


@dataclass(frozen=True)
class NeverReceives(Check):
    """No measured volume of ``liquid`` is dispensed into a well of ``wells``.

    Where nothing says what such a well is given, that may be ``liquid``, too, if it stands in
    the place of that in some other wells.

    Attributes:
        wells: Roles of the wells.
        liquid: Roles of the liquid.
        own: Whether only wells are judged that are given a liquid of their own as well: the first
            of a row of standards may be the blank.
    """

    lasting = True

    wells: tuple[str, ...] = role_names(required=True)
    liquid: tuple[str, ...] = role_names(required=True)
    own: bool = False

    def find(self, case: RuleContext) -> Iterator[Result]:
        for well in case.wells(self.wells):
            seen: set[Well] = set()
            if self.own and not any(self._is_own(case, one) for one in case.meant.get(well, ())):
                continue
            for one in well.received:
                for origin, share in one.liquid.items():
                    if origin in seen or one.volume * share <= EMPTY_UL:
                        continue
                    if not case.of(origin) and self._may_be(case, origin, well):
                        seen.add(origin)
                        yield Doubt(
                            f"nothing says what {origin.ref} holds, which goes into the "
                            f"{case.title(well)} {well.ref} as well",
                            roles_of=(origin,),
                        )
                    elif case.has(origin, self.liquid) and not case.has(origin, self.wells):
                        seen.add(origin)
                        if self._is_named_loosely(case, origin):
                            yield Doubt(
                                f"only the name of its labware, or one that held other wells too, "
                                f"calls {origin.ref} {case.title(origin)}, and it goes into "
                                f"{case.title(well)}s alone",
                                roles_of=(origin,),
                            )
                        else:
                            yield _given(case, one, origin)

    def _is_own(self, case: RuleContext, origin: Well) -> bool:
        """Whether a liquid is no other well's: the blank's buffer."""
        allowed = case.has(origin, self.wells) or not case.has(origin, self.liquid)
        return allowed and all(case.has(w, self.wells) for w in case.made_of.get(origin, ()))

    def _is_named_loosely(self, case: RuleContext, origin: Well) -> bool:
        """Whether a loop or a rack names one that only such wells get: their water, the dose 0.

        Of a plate that is stamped each well serves one: that says nothing.
        """
        assigned = case.roles.by_well.get(origin.ref)
        if assigned is None or not (assigned.whole or assigned.kind is Kind.PASSING_NAME):
            return False
        if assigned.whole and len(case.trace.labware[origin.ref.labware].wells) > _MOST_TUBES:
            return False
        return all(case.has(well, self.wells) for well in case.destinations.get(origin, ()))

    def _may_be(self, case: RuleContext, source: Well, well: Well) -> bool:
        """Whether some other wells of a plate, but not most, get a source and no ``liquid``."""
        others = {
            other: origins
            for other, origins in case.meant.items()
            if other.ref.labware == well.ref.labware and not case.has(other, self.wells)
        }
        served = [origins for other, origins in others.items() if source in origins]
        in_its_place = any(not any(case.has(o, self.liquid) for o in origins) for origins in served)
        return in_its_place and 2 * len(served) < len(others)


def _given(case: RuleContext, one: Transfer, origin: Well) -> Violation:
    """A measured volume of a liquid in a well that must not have it."""
    what, title = case.title(origin), case.title(one.well)
    line = one.visit.line
    return Violation(
        f"{microlitres(one.visit.volume)} drawn from {what} in {one.source.ref} {at(one.drawn)} "
        f"are dispensed into the {title} {one.well.ref} {at(line)}.",
        (
            Site(one.drawn, one.source.ref, f"drew {what}"),
            site_of(one.visit, f"gave it to the {title}"),
        ),
        (line, one.drawn, what, title),
        (origin, one.well),
    )
