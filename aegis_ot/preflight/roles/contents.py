"""What roles imply of contents: which wells were full before the run, which buffer dilutes."""

from __future__ import annotations

from ...vocabulary import WellRef
from ..evidence import Strength
from ..trace import Trace, Well, chains_of, links_of
from .roles import Roles


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
    own = _own_stocks(roles, trace) if found else frozenset()
    for source, well, _ in trace.feedings() if found else ():
        if well.ref in found:
            theirs = roles.of(source.ref)
            if not theirs or source.ref in own or not found[well.ref].isdisjoint(theirs):
                del found[well.ref]
    return set(found) | (_only_topped_up(roles, trace) if roles.family.default else set())


_FEWEST_OWN = 3
"""As many wells of one labware that each serve one well of their own hold each its own thing."""


def _own_stocks(roles: Roles, trace: Trace) -> frozenset[WellRef]:
    """Wells that only their labware's name calls stock, and that each serve one well: "DNA stocks"
    are samples.
    """
    by_labware: dict[str, set[WellRef]] = {}
    for ref, wells in trace.served().items():
        assigned = roles.by_well.get(ref)
        if len(wells) == 1 and assigned is not None and assigned.whole:
            by_labware.setdefault(ref.labware, set()).add(ref)
    return frozenset(
        ref for refs in by_labware.values() if len(refs) >= _FEWEST_OWN for ref in refs
    )


def _only_topped_up(roles: Roles, trace: Trace) -> set[WellRef]:
    """Wells named as sources that get nothing but a buffer and are given on: they held their own.

    A protein that is diluted where it stands, a dried compound that is dissolved.
    """
    specs = roles.family.roles
    named = {
        ref
        for ref, assigned in roles.by_well.items()
        if specs[assigned.role].side == "source"
        and not specs[assigned.role].one_liquid
        and assigned.strength >= Strength.NAME
    }
    topped_up: set[WellRef] = set()
    given_on: set[WellRef] = set()
    for source, well, _ in trace.feedings() if named else ():
        if source.ref.labware != well.ref.labware:
            given_on.add(source.ref)
        topped_up.add(well.ref)
        assigned = roles.by_well.get(source.ref)
        if assigned is None or not specs[assigned.role].one_liquid:
            named.discard(well.ref)
    return named & topped_up & given_on


def settle_diluent(roles: Roles, trace: Trace) -> None:
    """Where nothing is called the diluent, find it among the buffers.

    It is the one that most wells are filled from, together with others that fill at least
    three in ten (two series may have a diluent each). A buffer that fills one well of many is
    rather a mistake than a second diluent.
    """
    spec = roles.family.series
    if spec is None or not spec.diluent:
        return
    if spec.wells:
        fillings = frozenset(spec.diluent) | frozenset(spec.diluent_else)
        _rename_filled(roles, trace, fillings, spec.wells[0])
    if any(roles.known(role) for role in spec.diluent):
        return
    otherwise = frozenset(spec.diluent_else)
    filled: dict[str, set[WellRef]] = {}
    sources: dict[str, set[WellRef]] = {}
    for source, well, _ in trace.feedings():
        if roles.has(source.ref, otherwise):
            text = _base(roles.by_well[source.ref].text)
            filled.setdefault(text, set()).add(well.ref)
            sources.setdefault(text, set()).add(source.ref)
    if not filled:  # named, and never used: then something else is used in its place
        for ref, assigned in roles.by_well.items():
            if assigned.role in otherwise:
                sources.setdefault(_base(assigned.text), set()).add(ref)
        filled = {text: set() for text in sources} if len(sources) == 1 else {}
    if not filled:
        _settle_by_use(roles, trace, spec.diluent[0])
        return
    total = len(set().union(*filled.values())) if filled else 0
    for text, wells in filled.items():
        if len(wells) >= 0.3 * total:
            for ref in sources[text]:
                roles.by_well[ref].role = spec.diluent[0]


_MANY_FED = 3
"""A well that feeds as many others of its labware holds something for all of them."""


def _rename_filled(roles: Roles, trace: Trace, fillings: frozenset[str], series: str) -> None:
    """Wells called after what they are filled with: ``diluent_destinations`` are a series.

    They get diluent from where it stands, and then stand in a chain with their neighbours.
    """
    filled: set[Well] = set()
    linked: set[Well] = set()
    fed: dict[Well, set[Well]] = {}
    for source, well, _ in trace.feedings():
        if well.ref.labware == source.ref.labware:
            linked |= {source, well}
            fed.setdefault(source, set()).add(well)
        elif roles.has(source.ref, fillings) and not well.prefilled:
            filled.add(well)
    for well in filled & linked:
        assigned = roles.by_well.get(well.ref)
        if assigned is None or len(fed.get(well, ())) >= _MANY_FED:
            continue
        if not fillings.isdisjoint(roles.closure(assigned.role)):
            assigned.role = series


def _base(text: str) -> str:
    """A name without the number that tells it from others of its kind."""
    return text.rstrip("0123456789_ ") or text


_FEWEST_FILLED = 3


def _settle_by_use(roles: Roles, trace: Trace, diluent: str) -> None:
    """Where no name says so, the diluent is the one source that most of a chain is filled from.

    It goes into the wells before they are linked, all but the first and perhaps a few others.
    """
    links = [link for group in chains_of(list(links_of(trace))) for link in group]
    targets, sources = {link.well for link in links}, {link.source for link in links}
    filled: dict[WellRef, set[WellRef]] = {}
    for source, well, visit in trace.feedings():
        if well in targets and source not in sources | targets and visit.empty_before:
            filled.setdefault(source.ref, set()).add(well.ref)
    best = [ref for ref, wells in filled.items() if 2 * len(wells) > len(targets)]
    if len(best) == 1 and len(filled[best[0]]) >= _FEWEST_FILLED and not roles.of(best[0]):
        roles.derived.setdefault(best[0], set()).update(roles.closure(diluent))
