"""What a tip brings along on purpose, or by the letter only: accepted practice."""

from __future__ import annotations

import math
from itertools import islice

from ...adapters.opentrons.instrumentation import OperationKind
from ..source import comparable
from ..trace import Met, Tip, Visit, Well
from .rule_context import RuleContext

_RINSES = 2
"""So many times a tip is rinsed to be taken for clean, where nothing amplifies a trace."""


def is_given_to_all(case: RuleContext, visit: Visit, origin: Well, met: Met) -> bool:
    """Whether the tip goes back into a stock of which all that is made from now on, at last, is
    given whatever stood in the well that the tip comes from.
    """
    made = made_after(case, visit.well, visit.index, further=True) - {visit.well}
    ends = [dest for dest in made if not made_after(case, dest, visit.index, further=False)]
    brought = case.meant.get(met.well, {}).items()
    stood = {origin, *(liquid for liquid, first in brought if first < visit.index)}
    stock = case.meant.get(visit.well, {})
    if any(stock.get(one) == visit.index for one in stood):
        return False  # poured in, not clinging: what comes to hold it may have it from here
    # On a plate that is pooled nearly all is plainly there, and need not be compared.
    told = all(
        case.is_given(dest, one) for dest in ends for one in stood.difference(case.meant[dest])
    )
    return bool(ends) and told


def made_after(case: RuleContext, well: Well, index: int, further: bool) -> set[Well]:
    """The wells that liquid of ``well`` goes to from now on; ``further``: and on from there."""
    found: set[Well] = set()
    open_ = [well]
    while open_:
        drawn_for = case.destinations.get(open_.pop(), {})
        later = {dest for dest, last in drawn_for.items() if last >= index} - found
        found |= later
        if further:
            open_ += later
    return found


def was_rinsed(case: RuleContext, visit: Visit, origin: Well) -> bool:
    """Whether, since the tip last met a liquid, a shared one was drawn into it and given to the
    waste often enough, or the tip was washed by mixing in one that serves nothing else.
    """
    if visit.tip not in case.once(_washed):
        return False  # asked of every pair of wells that a tip has been in
    rinses, thrown = 0, False
    for other in reversed(visit.tip.visits):
        if other.index >= visit.index:
            continue
        if other.well.ref in case.waste:
            thrown = thrown or other.kind is OperationKind.DISPENSE
        elif other.well is origin or origin in case.meant.get(other.well, ()):
            break
        elif other.kind is OperationKind.ASPIRATE:
            if case.is_one_liquid(other.well):
                rinses += _RINSES if _is_bath(other.well) else thrown
            thrown = False
    return rinses >= _RINSES


def _washed(case: RuleContext) -> set[Tip]:
    """The tips that have been in the waste, or in a bath."""
    visits, waste = case.trace.visits, case.waste
    return {one.tip for one in visits if one.well.ref in waste or _is_bath(one.well)}


def rinsed_with(case: RuleContext, visit: Visit, origin: Well) -> bool:
    """Whether a shared liquid only rinsed the tip: in a bath, or all that it drew was wasted."""
    if not case.is_one_liquid(origin):
        return False
    earlier = (one for one in visit.tip.visits if one.index < visit.index)
    to = [one.well.ref for one in earlier for part in one.brought if part.source is origin]
    return _is_bath(origin) or (bool(to) and all(ref in case.waste for ref in to))


def _is_bath(well: Well) -> bool:
    """Whether it is mixed again and again, and serves nothing else."""
    return len(well.mixes) > 1 and all(one.mixing for one in well.visits)


def was_filled(case: RuleContext, visit: Visit, origin: Well, met: Met) -> bool:
    """Whether the run had put something into the well in which the tip met the liquid."""
    if origin is not met.well:
        return True
    if min(case.meant.get(met.well, {}).values(), default=math.inf) <= met.index:
        return True
    # A sample's tip has been in its destination too; with buffers it matters less.
    return is_own(case, origin) and any(
        case.meant.get(other, {}).get(origin, visit.index) < visit.index
        for other in islice(visit.tip.touched, visit.met)
    )


def is_own(case: RuleContext, origin: Well) -> bool:
    """Whether a well is known to hold what other wells of its role do not."""
    return bool(case.of(origin)) and not case.is_one_liquid(origin)


def is_pooled(case: RuleContext, visit: Visit, origin: Well) -> bool:
    """Whether what is made of the well is meant to hold the liquid too.

    Water and then sample, drawn for one well, spoils no sample for its other uses.
    """
    clean = case.is_one_liquid(origin)
    given = [
        dest is origin or case.is_given(dest, origin)
        for dest in made_after(case, visit.well, visit.index, further=clean)
        # What is washed is kept; what is drawn off to the waste is not.
        if visit.kind is OperationKind.ASPIRATE or dest.ref not in case.waste
    ]
    return any(given) if clean else bool(given) and all(given)


def goes_back(case: RuleContext, visit: Visit, met: Met) -> bool:
    """Whether a tip that drew from what was made, to mix it, goes back into a source of which
    something is left.
    """
    into, draws = visit.well, OperationKind.ASPIRATE
    if visit.kind is not draws or into.empty or met.well not in case.destinations.get(into, ()):
        return False
    earlier = (one for one in visit.tip.visits if one.index < visit.index)
    return any(one.kind is draws and one.well is met.well for one in earlier)


def is_rising(case: RuleContext, origin: Well, well: Well) -> bool:
    """Whether a well, or what it is given, has a greater number beside it than the liquid that is
    carried there, of which no more is known than its number.
    """
    mine = None if origin.ref in case.roles.by_well else case.roles.level(origin.ref)
    levels = [case.roles.level(one.ref) for one in (well, *case.meant.get(well, ()))]
    return mine is not None and any(
        level is not None and mine < level and comparable(mine, level) for level in levels
    )


def on_purpose(stock: Well, origin: Well, visit: Visit) -> bool:
    """Whether liquid was mixed into a stock earlier, straight from its source, by another tip."""
    given = (one.visit for one in stock.received if one.source is origin)
    earlier = [one for one in given if one.index < visit.index]
    if any(one.tip is not visit.tip for one in earlier):
        return True
    return bool(earlier) and not any(
        other.tip is visit.tip and other.kind is OperationKind.ASPIRATE
        for other in stock.visits
        if other.index < earlier[0].index
    )
