"""What a tip brings along by its letter only: accepted practice, which warns."""

from __future__ import annotations

from ...adapters.opentrons.instrumentation import OperationKind
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
