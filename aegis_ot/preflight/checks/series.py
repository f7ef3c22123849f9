"""Finds dilution series: which wells follow one another, and which transfers are steps.

A series is found from transfers between wells of one labware that form a chain, together with
the roles of stock and diluent. Its order is the layout's (a row, a column, or the labware's own
order), running away from the well in which the stock stands.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence, Set
from dataclasses import dataclass, field

from ...vocabulary import WellRef
from ..roles import Roles
from ..trace import Trace, Transfer, Well, chains_of, links_of
from .series_links import along_series, first_from, is_copying
from .series_order import best_order, turned_to_fall


@dataclass
class Series:
    """One dilution series.

    Attributes:
        wells: Its wells, the most concentrated first if that is known.
        position: Place of each well in that order.
        steps: Its dilution steps, in the order in which they are made.
        links: Those of them between two wells of the series.
        directed: Whether the most concentrated end is known.
        entered: Index at which each well first held stock (-1: before the run).
        fillers: Wells that all of its wells are filled from, whatever they are called.
    """

    wells: list[Well]
    position: dict[Well, int]
    steps: list[Transfer]
    links: list[Transfer]
    directed: bool
    entered: dict[Well, int] = field(default_factory=dict)
    fillers: frozenset[Well] = frozenset()


def find_series(
    trace: Trace, roles: Roles, waste: Collection[WellRef] = (), shortest: int = 2
) -> list[Series]:
    """All series with at least ``shortest`` transfers between their wells."""
    spec = roles.family.series
    stock = frozenset(spec.stock) if spec else frozenset()
    diluent = frozenset(spec.diluent) if spec else frozenset()
    links = [
        link
        for link in links_of(trace)
        if not roles.has(link.source.ref, diluent)
        and not roles.has(link.well.ref, diluent)
        and (
            not roles.has(link.source.ref, stock)
            or _is_made(trace, roles, link.source, diluent | stock)
        )
        and link.well.ref not in waste
    ]
    links, fillers = along_series(trace, roles, links, diluent)
    groups = [
        group
        for group in chains_of(links)
        if len({(s.source, s.well) for s in group}) >= shortest and not is_copying(trace, group)
    ]
    linked = {well for group in groups for link in group for well in (link.source, link.well)}
    alike = _given_alike(trace, roles, groups, diluent)
    return [
        _series(trace, roles, group, stock, diluent, linked, fillers, alike) for group in groups
    ]


def _is_made(trace: Trace, roles: Roles, well: Well, made_of: frozenset[str]) -> bool:
    """Whether a well named as a stock was filled in the run: a standard, or the undiluted head."""
    return not well.prefilled and any(
        source is not None
        and source is not well
        and (roles.has(source.ref, made_of) or source.ref.labware == well.ref.labware)
        for visit in trace.deliveries(well)
        for source, _, _, _ in visit.parts
    )


def _series(
    trace: Trace,
    roles: Roles,
    links: list[Transfer],
    stock: frozenset[str],
    diluent: frozenset[str],
    taken: Collection[Well],
    fillers: frozenset[Well],
    alike: Set[Well],
) -> Series:
    linked = list(dict.fromkeys(well for link in links for well in (link.source, link.well)))
    members = _with_neighbours(trace, roles, linked, diluent | stock, taken)
    order = best_order(members, links)
    steps: list[Transfer] = []
    entries: list[Well] = []
    entered: dict[Well, int] = {}
    member_set = set(members)
    linked_set = set(linked)
    fed = _fed_from_outside(trace, members)
    special = _for_the_head(roles, fed, links, diluent)
    for well in members:
        last: dict[int, Transfer] = {}
        held_stock = well.prefilled and well in linked_set and not _feeds_last(well, links)
        if held_stock and not roles.has(well.ref, diluent):
            entries.append(well)
            entered[well] = -1
        for visit in trace.deliveries(well):
            for source, volume, _, line in visit.parts:
                if source is None or source is well or volume <= 0 or source in member_set:
                    continue
                if roles.has(source.ref, diluent) or source in alike:
                    continue
                if (
                    roles.has(source.ref, stock)
                    or (source in special and not alike.isdisjoint(fed))
                    # Unnamed, but it goes into one well only, and that one feeds the others.
                    or (not roles.of(source.ref) and fed[source] == {well} and well in linked_set)
                ):
                    last[id(source)] = Transfer(source, well, visit, line, True)
                    entered.setdefault(well, visit.index)
        for step in last.values():
            entries.append(well)
            steps.append(step)
    directed = turned_to_fall(order, entries, links, roles)
    position = {well: number for number, well in enumerate(order)}
    for link in sorted(links, key=lambda s: s.visit.index):
        if link.source in entered and entered[link.source] < link.visit.index:
            entered.setdefault(link.well, link.visit.index)
    all_steps = sorted([*steps, *links], key=lambda s: s.visit.index)
    fillers |= {well for well in alike if well in fed and _comes_first(trace, well, links)}
    return Series(order, position, all_steps, links, directed, entered, fillers)


def _given_alike(
    trace: Trace, roles: Roles, groups: Sequence[Sequence[Transfer]], diluent: frozenset[str]
) -> set[Well]:
    """Sources that all wells of a chain are given, where its head alone is given another one.

    That other one is what is diluted. What all get alike is no stock, whatever its name: the
    protein that a ligand is titrated into, a dye in every well. Where other chains are filled
    with diluent, what this one is given instead is rather a mistake; and so is the wash buffer,
    where a diluent stands unused, or what has another name, if the undiluted first well gets none.
    """
    alike: dict[bool, set[Well]] = {}
    unused = _stands_unused(trace, roles, diluent)
    wrong = _never_diluent(roles) if unused else frozenset()
    others = roles.named_otherwise() if unused else frozenset()
    for links in groups:
        linked = list(dict.fromkeys(well for link in links for well in (link.source, link.well)))
        fed = _fed_from_outside(trace, linked)
        found = alike.setdefault(any(roles.has(source.ref, diluent) for source in fed), set())
        for_the_head = _for_the_head(roles, fed, links, diluent)
        in_line = any(source.ref.labware == linked[0].ref.labware for source in for_the_head)
        if len(linked) >= _FEWEST_ALIKE and for_the_head:
            found.update(
                source
                for source, wells in fed.items()
                if wells.issuperset(linked)
                and not roles.has(source.ref, wrong)
                and not (in_line and source.ref in others)
            )
    return alike.get(True in alike, set())


def _stands_unused(trace: Trace, roles: Roles, diluent: frozenset[str]) -> bool:
    """Whether a well is named for the diluent, and none of those is ever drawn from."""
    named = {ref for ref, assigned in roles.by_well.items() if assigned.role in diluent}
    return bool(named) and named.isdisjoint(trace.served())


def _never_diluent(roles: Roles) -> frozenset[str]:
    """Roles of liquids that are neither diluted nor diluted with."""
    spec = roles.family.series
    of_series = (*spec.stock, *spec.diluent, *spec.diluent_else) if spec else ()
    diluted = frozenset[str]().union(*map(roles.closure, of_series))
    sources = {name for name, role in roles.family.roles.items() if role.side == "source"}
    return frozenset(sources - diluted)


_FEWEST_ALIKE = 3
"""In a chain of fewer wells it says little that all of them are given the same."""


def _for_the_head(
    roles: Roles,
    fed: Mapping[Well, set[Well]],
    links: Sequence[Transfer],
    diluent: frozenset[str],
) -> set[Well]:
    """Sources other than the diluent that go into the head of a chain and into no later well."""
    later = {link.well for link in links}
    heads = {link.source for link in links} - later
    return {
        source
        for source, wells in fed.items()
        if not roles.has(source.ref, diluent)
        and not wells.isdisjoint(heads)
        and wells.isdisjoint(later)
    }


def _comes_first(trace: Trace, source: Well, links: Sequence[Transfer]) -> bool:
    """Whether a source gives to each well of a chain before the chain reaches it."""
    reached = {link.well for link in links}
    given = {
        well
        for well in reached
        for visit in trace.deliveries(well)
        if any(part[0] is source for part in visit.parts)
    }
    return given == reached and all(
        first_from(trace, source, link.well).index < first_from(trace, link.source, link.well).index
        for link in links
    )


def _fed_from_outside(trace: Trace, members: Sequence[Well]) -> dict[Well, set[Well]]:
    """For each source outside the series the wells of the series that it is given to."""
    inside = set(members)
    fed: dict[Well, set[Well]] = {}
    for well in members:
        for visit in trace.deliveries(well):
            for source, _, _, _ in visit.parts:
                if source is not None and source not in inside:
                    fed.setdefault(source, set()).add(well)
    return fed


def _feeds_last(well: Well, links: Sequence[Transfer]) -> bool:
    """Whether a well only receives from the chain and feeds nothing in it."""
    return all(link.source is not well for link in links)


def _with_neighbours(
    trace: Trace,
    roles: Roles,
    linked: list[Well],
    filling: frozenset[str],
    taken: Collection[Well],
) -> list[Well]:
    """Add wells of the same row or column that were given stock or diluent, but no link.

    Wells of another series (``taken``) in that row are none of this one's.
    """
    rows = {well.order[0] for well in linked}
    columns = {well.order[1] for well in linked}
    if len(rows) != 1 and len(columns) != 1:
        return linked
    first = linked[0]
    members = list(linked)
    for well in trace.wells.values():
        if well in members or well in taken or well.ref.labware != first.ref.labware:
            continue
        if well.generation != first.generation:
            continue
        inside = (len(rows) == 1 and well.order[0] in rows) or (
            len(columns) == 1 and well.order[1] in columns
        )
        if inside and any(
            source is not None and roles.has(source.ref, filling)
            for visit in trace.deliveries(well)
            for source, _, _, _ in visit.parts
        ):
            members.append(well)
    return members
