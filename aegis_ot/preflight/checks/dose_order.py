"""The check on one tip that doses several wells."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from ..rules import role_names
from ..source import comparable, lexicon_of
from ..trace import Contact, Met, Visit, Well
from .check import Check, Doubt, Result, Violation, site_of, surest
from .rule_context import RuleContext, carried_liquids


@dataclass(frozen=True)
class DoseOrder(Check):
    """One tip never goes from a well of a higher dose, or of another compound, to ``wells``.

    Doses come from the levels of the ``liquid`` and the volumes that were given.

    Attributes:
        liquid: Roles of the dosed liquid.
        wells: Roles of the wells that are dosed.
    """

    lasting = True

    liquid: tuple[str, ...] = role_names(required=True)
    wells: tuple[str, ...] = role_names(required=True)

    def claims(self, case: RuleContext, origin: Well, well: Well) -> bool | None:
        """As a dose, or a dosed well, in another of them; and back into the dose's tube."""
        dosed = (*self.liquid, *self.wells)
        if any(case.of(one) and not case.has(one, dosed) for one in (origin, well)):
            return False
        return True if case.of(origin) and case.of(well) else None

    def find(self, case: RuleContext) -> Iterator[Result]:
        doses = self._doses(case)
        found: dict[tuple[int, int], Result] = {}
        for visit in case.trace.visits:
            if not visit.contact or not visit.carried or not case.has(visit.well, self.wells):
                continue
            here = doses.get(visit.well, {})
            key = (visit.tip.number, id(visit.well))
            seen = found.get(key)
            if seen and not (isinstance(seen, Violation) and seen.contact < Contact.WET):
                continue
            for origin, met in carried_liquids(visit):
                dosed = origin is not visit.well and case.has(origin, self.liquid)
                if not dosed or any(case.same_liquid(origin, other) for other in here):
                    continue
                if result := self._other(case, visit, origin, met, here):
                    surest(found, key, result)
            for violation in self._higher(case, visit, here, doses):
                surest(found, key, violation)
        yield from found.values()

    def _doses(self, case: RuleContext) -> dict[Well, dict[Well, float]]:
        """For each well the µL of each dosed liquid that it is given in the whole run."""
        doses: dict[Well, dict[Well, float]] = defaultdict(lambda: defaultdict(float))
        for one in case.trace.transfers:
            for origin, share in one.liquid.items():
                if case.has(origin, self.liquid):
                    doses[one.well][origin] += one.volume * share
        return doses

    def _other(
        self, case: RuleContext, visit: Visit, origin: Well, met: Met, here: dict[Well, float]
    ) -> Result | None:
        """The tip carries a liquid that this well never gets."""
        mine = case.roles.level(origin.ref)
        alike = [other for other in here if case.compound(origin) == case.compound(other)]
        own = [case.roles.level(other.ref) for other in alike or here]
        what = f"{case.title(origin)} from {origin.ref}"
        if mine is not None and any(one is not None and not comparable(mine, one) for one in own):
            mine = None  # of different scales
        if here and mine is not None and all(level is not None for level in own):
            if alike and all(level is not None and mine <= level for level in own):
                return None
            harm = "a well of a lower dose" if alike else "a well of another compound"
        elif here and (mine is not None or any(level is not None for level in own)):
            why = f"the dose in {origin.ref} or of its neighbours is not known"
            return Doubt(why, (origin, *here))
        elif here and all(_in_one_list(case, origin, other) for other in here):
            return Doubt(
                f"one tip visits several {case.title(origin)} wells, and nothing says "
                "which dose is higher",
                (origin, *here),
            )
        else:
            harm = "a treated well that is not meant for it"
        return Violation(
            f"The tip that met {what} {case.at(met)} entered {visit.well.ref}, {harm}, "
            f"{case.at(visit)}.",
            (site_of(met, f"met {case.title(origin)}"), site_of(visit, f"entered {harm}")),
            (visit.line, met.line, harm),
            (origin, visit.well),
            contact=min(met.contact(visit.index), visit.contact),
        )

    def _higher(
        self,
        case: RuleContext,
        visit: Visit,
        here: dict[Well, float],
        doses: dict[Well, dict[Well, float]],
    ) -> Iterator[Violation]:
        """The tip has touched a well that gets more of the same liquid."""
        for other, met in islice(visit.tip.touched.items(), visit.met):
            there = doses.get(other, {})
            if other is visit.well or not there or case.destinations.get(other):
                continue  # what is given on is a dilution rather than a dosed well
            if set(there) != set(here):
                continue
            first = min(case.meant[other].get(origin, met.index + 1) for origin in there)
            touched = (v.index for v in other.visits if v.tip is visit.tip and v.touches)
            if first > met.index and not any(first <= at < visit.index for at in touched):
                continue
            if any(volume > here[origin] * 1.01 for origin, volume in there.items()):
                did = "entered a well of a lower dose"
                yield Violation(
                    f"The tip that touched {other.ref}, a well of a higher dose, "
                    f"{case.at(met)} entered {visit.well.ref} {case.at(visit)}.",
                    (site_of(met, "touched a well of a higher dose"), site_of(visit, did)),
                    (visit.line, met.line, "falling"),
                    (other, visit.well),
                    contact=min(met.contact(visit.index), visit.contact),
                )


def _in_one_list(case: RuleContext, one: Well, other: Well) -> bool:
    """Whether two wells have their role from one name, and may be doses of one compound."""
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if mine is None or theirs is None:
        return mine is theirs  # nothing is said of either
    if one.liquids and one.liquids == other.liquids:
        return True
    kinds = lexicon_of({"distinct": case.common.distinct, "dosed": case.common.dose_words})
    said = {match.topic for match in kinds.find(mine.text)}
    same = case.compound(one) == case.compound(other)
    return same and ("dosed" in said or "distinct" not in said)
