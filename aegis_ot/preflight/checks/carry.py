"""Checks on what a tip carries from one liquid into another well."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from ...adapters.opentrons.instrumentation import Operation, OperationKind
from ..rules import role_names
from ..trace import Contact, Met, Tip, Visit, Well
from .check import Check, Doubt, Result, Violation, site_of, surest
from .practice import (
    goes_back,
    is_given_to_all,
    is_own,
    is_pooled,
    is_rising,
    on_purpose,
    rinsed_with,
    was_filled,
    was_rinsed,
)
from .rule_context import RuleContext, carried_liquids

_IN_ALL = "All that is still made of it is given that liquid too: the tip brought nothing new."
_RINSED = "The tip was rinsed in between: what is left on it is a trace."
_UNSAID = "Nothing in the protocol says what these wells held."
_KEPT = "All that the run makes of it is given that liquid too; what is left of it is not clean."
_ONE_NAME = "All that it reaches is loaded as '{}': if that is one liquid, nothing new came to it."


_Exempt = Literal["", "now", "ever"]
"""Until when a liquid may be carried into a well."""


@dataclass(frozen=True)
class Carry(Check):
    """No tip that has met a liquid of ``carried`` touches, or delivers below the top of, a
    well of ``into`` that no measured volume of it is meant for.

    Attributes:
        carried: Roles of the liquids that must not be carried.
        into: Roles of the wells that they must not be carried into.
        stock: Whether the wells are stocks: then liquid that was mixed into the stock on
            purpose beforehand is let be, and nothing else is.
        pooled: Whether carrying one source into another is let be when all that is ever made
            of the second is meant to hold the first too (pooling, water and then sample); into
            a stock it then warns.
        via_destination: ``only``: judge liquids met in wells that the run had put something
            into; ``not``: judge the others; empty: all.
        shared: Whether only wells that serve several destinations are judged.
        unnamed: Whether sources of which nothing says what they hold are carried as well.
        not_into: Roles whose wells are let be, although they have a role of ``into`` as well.
        rinsable: Whether a tip that was rinsed in between warns: nothing amplifies a trace. So it
            is in plain transfers.
    """

    lasting = True

    carried: tuple[str, ...] = role_names(required=True)
    into: tuple[str, ...] = role_names(required=True)
    stock: bool = False
    pooled: bool = False
    via_destination: Literal["", "only", "not"] = ""
    shared: bool = False
    unnamed: bool = False
    not_into: tuple[str, ...] = role_names()
    rinsable: bool = False

    def claims(self, case: RuleContext, origin: Well, well: Well) -> bool:
        """As it is of the liquids and of the wells that it looks at."""
        kept = case.has(well, self.into) and not case.has(well, self.not_into)
        return kept and case.has(origin, self.carried)

    def find(self, case: RuleContext) -> Iterator[Result]:
        mixes = (isinstance(step, Operation) and step.mixing for step in case.trace.log)
        if not (case.trace.transfers or any(mixes)):
            return  # all that was drawn goes back where it came from: a run that tries its moves
        carriers = set(case.wells(self.carried))
        if self.unnamed:
            carriers.update(well for well in case.destinations if not case.of(well))
        so_far = _SoFar()
        for visit in self._visits(case) if carriers else ():
            for origin, met in so_far.carried(visit):
                if origin not in carriers or origin is visit.well:
                    continue
                if self._judge(case, visit, origin, met, so_far):
                    so_far.again(visit, origin, met)
            so_far.judged[visit.tip, visit.well] = visit.carried
        yield from so_far.results()
        if doubt := self._unnamed_contact(case, carriers) or self._mixed_contact(case):
            yield doubt

    def _visits(self, case: RuleContext) -> Iterator[Visit]:
        """Visits to wells of ``into`` that something is carried to, and does harm to."""
        # What tips are rinsed in harms nothing: nothing is made of it.
        fewest = 2 if self.shared else 1 if self.stock else 0
        made = case.made_of
        kept = {
            well: well.ref in case.waste
            for well in case.wells(self.into)
            if not case.has(well, self.not_into) and len(made.get(well, ())) >= fewest
        }
        for visit in case.trace.visits:
            is_waste = kept.get(visit.well) if visit.contact and visit.carried else None
            if is_waste is None:
                continue
            # Waste is meant for all.
            if not is_waste or (visit.kind is OperationKind.ASPIRATE and made.get(visit.well)):
                yield visit

    def _judge(
        self, case: RuleContext, visit: Visit, origin: Well, met: Met, so_far: _SoFar
    ) -> bool:
        """Note what a liquid does to the well that it is carried to; whether it may do harm at a
        later visit to the well, or surely do it then."""
        well = visit.well
        claimed = case.is_claimed(origin, well)
        if claimed is True:
            return False
        contact = min(met.contact(visit.index), visit.contact)
        place = (visit.tip, well, origin)
        known = so_far.found.get(place)
        if known and contact <= known.contact < Contact.WET:
            return True  # nothing new
        if exempt := self._exemption(case, visit, origin, met):
            if case.are_twins(origin, well):
                so_far.twins.setdefault(origin, well)
            # Without these two later visits are judged as the first.
            return exempt == "now" and (self.stock or self.pooled)
        if met.well is origin and rinsed_with(case, visit, origin):
            return self.stock or self.pooled  # what is left of a rinse
        if claimed is None or (case.left_over and self.pooled and is_rising(case, origin, well)):
            so_far.rising.setdefault(origin, well)
            return False
        violation = self._violation(case, visit, origin, met)
        # In an assay that is known, a trace of a reagent, or of what all that is made of a stock
        # is given as well, is accepted practice.
        trace = self.via_destination == "only" and case.is_one_liquid(origin)
        if not (case.beside and (trace or violation.warning == _IN_ALL)):
            surest(so_far.found, place, violation)
        return contact < Contact.WET

    def _exemption(self, case: RuleContext, visit: Visit, origin: Well, met: Met) -> _Exempt:
        """Whether the liquid may come into the well, at this visit or at all later ones too."""
        well = visit.well
        if case.same_liquid(origin, well):
            return "ever"
        if self.via_destination:
            filled = was_filled(case, visit, origin, met)
            if filled != (self.via_destination == "only"):
                # What was filled stays so; what was not may be filled until the next visit.
                return "ever" if filled or not is_own(case, origin) else "now"
        if self.stock:
            is_in_place = self._is_in_stock(case, visit, origin, met)
        elif case.is_given(well, origin):
            return "ever"
        else:
            pooled = self.pooled and is_pooled(case, visit, origin)
            is_in_place = pooled and not goes_back(case, visit, met)
        return "now" if is_in_place else ""

    def _is_in_stock(self, case: RuleContext, visit: Visit, origin: Well, met: Met) -> bool:
        """Whether the stock holds the liquid already, or is meant to."""
        well = visit.well
        if met.well is well or (origin.liquids and origin.liquids == well.liquids):
            return True  # it was in the stock already, or is loaded as the same
        drawn_for = case.destinations.get(well, {})
        told = case.beside and self.via_destination == "not" and origin.liquids
        if told and all(origin.liquids == dest.liquids for dest in drawn_for):
            return True  # cells of one name stand in all wells that it serves
        if len(drawn_for) == 1 and all(origin in (dest, *case.meant[dest]) for dest in drawn_for):
            return True  # all that is drawn from it goes to one well, which holds that as well
        return origin in case.meant.get(well, {}) and (
            on_purpose(well, origin, visit) or self._made_of(case, visit, origin)
        )

    def _unnamed_contact(self, case: RuleContext, carriers: Set[Well]) -> Doubt | None:
        """The first contact that would break a rule if an unnamed source were what it may be.

        A rule counts as decided only if every well that could break it has a role, or is shown to
        be harmless: an unnamed trough that a tip enters with template on it may well be the water.
        The tip carries a liquid of ``carriers`` into an unnamed source that serves several wells,
        or what it drew from an unnamed source into a well of ``into``, or into another such source.
        """
        unnamed = [well for well in case.trace.wells.values() if not case.of(well)]
        drawn = {well for well in unnamed if case.is_drawn_first(well)}
        sources, stocks = set[Well](), set[Well]()
        if any(case.family.roles[role].side != "destination" for role in self.into):
            stocks = {well for well in unnamed if len(case.made_of.get(well, ())) > 1}
            sources = stocks & drawn if self.shared else drawn
        judged: dict[Well, Set[Well]] = {
            well: (carriers if well in stocks else set())
            | (drawn if well in sources or case.has(well, self.into) else set())
            for well in (case.trace.wells.values() if drawn or stocks else ())
            if well.ref not in case.waste and not (self.stock and not case.made_of.get(well))
        }
        for visit in case.trace.visits if any(judged.values()) else ():
            met_before = judged.get(visit.well, set()) if visit.contact else set()
            for origin, met in carried_liquids(visit) if met_before else ():
                if origin in met_before and self._may_harm(case, visit, origin, met):
                    named = (one for one in unnamed if one in drawn or one is visit.well)
                    return Doubt(_why_unnamed(case, visit, origin, met), roles_of=tuple(named))
        return None

    def _may_harm(self, case: RuleContext, visit: Visit, origin: Well, met: Met) -> bool:
        well = visit.well
        if case.is_claimed(origin, well) or origin in case.meant.get(well, {}):
            return False
        return not self._exemption(case, visit, origin, met)

    def _mixed_contact(self, case: RuleContext) -> Doubt | None:
        """The first return to a stock of a tip that mixed it, and nothing else as far as is known,
        in wells of which nobody says that they were empty: one mixes what is not one liquid.
        """
        mixed: dict[Well, str] = {}
        for visit in case.trace.visits if self.via_destination == "only" else ():
            stock, tip = visit.well, visit.tip
            if not visit.contact or not case.has(stock, self.into):
                continue
            if len(case.made_of.get(stock, ())) < 2:
                continue
            if not all(case.same_liquid(origin, stock) for origin, _ in carried_liquids(visit)):
                continue
            for one in tip.visits:
                if one.index >= visit.index:
                    break
                if one.mixing and not (one.well is stock or one.well in mixed):
                    enters = f"that mixed in it {case.at(one)} enters {stock.ref} {case.at(visit)}"
                    why = f"nothing says what {one.well.ref} held before, and the tip {enters}"
                    mixed[one.well] = why
        open_ = [
            one
            for one in mixed
            if not (one.prefilled or one.liquids or case.roles.is_given(one.ref))
        ]
        if not open_:
            return None
        return Doubt(mixed[open_[0]], roles_of=tuple(open_), side="destination")

    def _made_of(self, case: RuleContext, visit: Visit, origin: Well) -> bool:
        """Whether the liquid is brought as a measured volume to make what the well is drawn for.

        Then nothing made of the well afterwards is given such a liquid in another way.
        """
        well = visit.well
        given = [
            one
            for one in well.received
            if origin in one.liquid
            and one.visit.tip is visit.tip
            and one.visit.index <= visit.index
        ]
        if not given:
            return False
        before = (one.well for one in visit.tip.visits if one.index < visit.index)
        if all(one is origin or one is well for one in before):
            return True  # a part of what is made there, brought by a tip of its own
        drawn_for = case.destinations.get(well, {})
        later = [dest for dest, index in drawn_for.items() if index > visit.index]
        if drawn_for and not later:
            return False
        return not any(
            one.source is not well and case.roles.is_called(one.source.ref, self.carried)
            for dest in later
            for one in dest.received
        )

    def _violation(self, case: RuleContext, visit: Visit, origin: Well, met: Met) -> Violation:
        well = visit.well
        what = case.title(origin)
        where = f"{met.well.ref} {case.at(met)}"
        if met.well is origin:
            began = f"The tip that met {what} in {where}"
        else:
            held = f"{what} from" if case.of(origin) else "the liquid of"
            beside = origin.ref.labware == met.well.ref.labware
            source = origin.ref.name if beside else origin.ref
            began = f"The tip that touched {where}, which holds {held} {source},"
        message = f"{began} entered the {case.title(well)} {well.ref} {case.at(visit)}."
        contact = min(met.contact(visit.index), visit.contact)
        judged = self.pooled or self.rinsable
        warning = self._why_warning(case, visit, origin, met) if judged else ""
        # Tips that are washed are washed throughout: told once.
        cause = (warning,) if warning == _RINSED else (visit.line, met.line, what)
        return Violation(
            message,
            (site_of(met, f"met {what}"), site_of(visit, f"entered the {case.title(well)}")),
            cause,
            (origin, well),
            tip=(visit.tip.number, what, case.title(well)),
            contact=contact,
            warning=warning,
            shown=self.stock,
            # A liquid that stands in all wells may be meant to come along.
            in_any_assay=contact is Contact.WET and not case.is_one_liquid(origin),
        )

    def _why_warning(self, case: RuleContext, visit: Visit, origin: Well, met: Met) -> str:
        """Why it is a warning at most, in a sentence; empty for what is surely wrong."""
        if (case.family.default or self.rinsable) and was_rinsed(case, visit, origin):
            return _RINSED
        if not self.pooled:
            return ""
        others = case.made_of.get(visit.well, ()) if self.stock else (visit.well,)
        loaded = [one for one in others if one.liquids]
        if loaded and case.go_by_one_name(origin, loaded):
            return _ONE_NAME.format(origin.liquids[0])
        if not (self.stock or self.via_destination) and is_pooled(case, visit, origin):
            return _KEPT
        if self.via_destination == "not":
            told = not self.shared or case.is_said_to_hold(origin)
            return "" if told else _UNSAID
        back = self.via_destination == "only" and not met.well.prefilled
        return _IN_ALL if back and is_given_to_all(case, visit, origin, met) else ""


class _SoFar:
    """What was found in the visits so far.

    Attributes:
        judged: How many of the liquids that a tip carries have been judged at a well.
        found: The violation of each tip, well and liquid.
        rising, twins: Liquids with a well where it is open whether they harm it.
    """

    def __init__(self) -> None:
        self.judged: dict[tuple[Tip, Well], int] = {}
        self.found: dict[tuple[Tip, Well, Well], Violation] = {}
        self.rising: dict[Well, Well] = {}
        self.twins: dict[Well, Well] = {}
        self._open: dict[tuple[Tip, Well], list[tuple[Well, Met]]] = {}

    def carried(self, visit: Visit) -> tuple[tuple[Well, Met], ...]:
        """What is to be judged at a visit: what was left open there, and what the tip has met
        since."""
        key = (visit.tip, visit.well)
        return (*self._open.pop(key, ()), *carried_liquids(visit, self.judged.get(key, 0)))

    def again(self, visit: Visit, origin: Well, met: Met) -> None:
        """It is judged again at the tip's next visit to the well."""
        self._open.setdefault((visit.tip, visit.well), []).append((origin, met))

    def results(self) -> Iterator[Result]:
        """All violations, and the first of each kind of doubt."""
        yield from self.found.values()
        for origin, well in islice(self.rising.items(), 1):
            why = f"{origin.ref} and {well.ref} may hold rising standards, or two samples"
            yield Doubt(why, roles_of=tuple(self.rising))
        for origin, well in islice(self.twins.items(), 1):
            name = origin.liquids[0]
            yield Doubt(
                f"{origin.ref} and {well.ref}, both '{name}', may hold the same or two things"
            )


def _why_unnamed(case: RuleContext, visit: Visit, origin: Well, met: Met) -> str:
    well = visit.well
    if case.of(well):
        enters = f"its tip enters the {case.title(well)} {well.ref} {case.at(visit)}"
        return f"nothing says what {origin.ref} holds, and {enters}"
    what = case.title(origin) if case.of(origin) else str(origin.ref)
    enters = f"that met {what} {case.at(met)} enters it {case.at(visit)}"
    return f"nothing says what {well.ref} holds, and the tip {enters}"
