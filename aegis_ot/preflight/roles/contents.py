"""What roles imply of contents: which wells were full before the run, which buffer dilutes."""

from __future__ import annotations

from ...vocabulary import WellRef
from ..trace import Trace, chains_of
from .roles import Roles

_FEWEST_FILLED = 3
_SHARE = 0.3
"""Two series may have a diluent each; a buffer that fills one well of many is rather a mistake."""


def implied_contents(roles: Roles, trace: Trace) -> set[WellRef]:
    """Wells whose role says that they held liquid before the run.

    Not those that are given in the run what such a well is made of, or something unknown.
    """
    specs = roles.family.roles
    found = {
        ref: frozenset(specs[assigned.role].filled_by)
        for ref, assigned in roles.by_well.items()
        if specs[assigned.role].implies_contents
    }
    for one in trace.transfers if found else ():
        if one.well.ref in found:
            theirs = roles.of(one.source.ref)
            if not theirs or not found[one.well.ref].isdisjoint(theirs):
                del found[one.well.ref]
    return set(found)


def settle_diluent(roles: Roles, trace: Trace) -> None:
    """Where nothing is called the diluent, find it among the buffers, or by its use."""
    spec = roles.family.series
    if spec is None or not spec.diluent or any(roles.known(role) for role in spec.diluent):
        return
    otherwise = frozenset(spec.diluent_else)
    filled: dict[str, set[WellRef]] = {}
    sources: dict[str, set[WellRef]] = {}
    for source, wells in trace.served().items():
        assigned = roles.by_well.get(source)
        if assigned is not None and roles.has(source, otherwise):
            text = _without_number(assigned.text)
            filled.setdefault(text, set()).update(wells)
            sources.setdefault(text, set()).add(source)
    if not filled:  # named, and never used: then something else is used in its place
        for ref, assigned in roles.by_well.items():
            if assigned.role in otherwise:
                sources.setdefault(_without_number(assigned.text), set()).add(ref)
        filled = {text: set() for text in sources} if len(sources) == 1 else {}
    if not filled:
        _settle_by_use(roles, trace, spec.diluent[0])
        return
    roles.diluent_guessed = len(filled) > 1
    total = len(set().union(*filled.values()))
    for text, wells in filled.items():
        if len(wells) >= _SHARE * total:
            for ref in sources[text]:
                roles.by_well[ref].role = spec.diluent[0]


def _without_number(text: str) -> str:
    """A name without the number that tells it from others of its kind."""
    return text.rstrip("0123456789_ ") or text


def _settle_by_use(roles: Roles, trace: Trace, diluent: str) -> None:
    """Where no name says so, the diluent is the one source that most of a chain is filled from.

    It goes into the wells before they are linked, all but the first and perhaps a few others.
    """
    links = [link for group in chains_of(trace.links) for link in group]
    targets, sources = {link.well for link in links}, {link.source for link in links}
    filled: dict[WellRef, set[WellRef]] = {}
    for one in trace.transfers:
        beside = one.source not in sources | targets
        if one.well in targets and beside and one.visit.empty_before:
            filled.setdefault(one.source.ref, set()).add(one.well.ref)
    best = [ref for ref, wells in filled.items() if 2 * len(wells) > len(targets)]
    if len(best) == 1 and len(filled[best[0]]) >= _FEWEST_FILLED and not roles.of(best[0]):
        roles.derive(best[0], diluent)
