"""Finds dilution series: which wells follow one another, and which transfers are steps.

A series is found from transfers between wells of one labware that form a chain, together with
the roles of stock and diluent. Its order is the layout's (a row, a column, or the labware's own
order), running away from the well in which the stock stands.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from ...vocabulary import WellRef
from ..roles import Roles
from ..trace import Trace, Transfer, Well, chains_of, links_of
from .series_links import along_series, is_copying
from .series_order import best_order, turned_to_fall

_SHORTEST = 2


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


def find_series(trace: Trace, roles: Roles, waste: Collection[WellRef]) -> list[Series]:
    """All series with at least two transfers between their wells."""
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
    links, fillers = along_series(trace, links)
    groups = [
        group
        for group in chains_of(links)
        if len({(s.source, s.well) for s in group}) >= _SHORTEST and not is_copying(trace, group)
    ]
    linked = {well for group in groups for link in group for well in (link.source, link.well)}
    in_all = [_in_all(trace, roles, group, diluent) for group in groups]
    anywhere = frozenset().union(*in_all)
    found = []
    for group, here in zip(groups, in_all, strict=True):
        own = _wells_of(group)
        members = _with_neighbours(trace, roles, own, diluent | stock, linked, anywhere)
        # Beside the chain, what all wells of another chain are given is no stock either.
        shared = {well: here if well in own else anywhere for well in members}
        found.append(_series(trace, roles, group, members, stock, diluent, fillers, shared))
    return found


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
    members: list[Well],
    stock: frozenset[str],
    diluent: frozenset[str],
    fillers: frozenset[Well],
    shared: Mapping[Well, frozenset[Well]],
) -> Series:
    linked = set(_wells_of(links))
    order = best_order(members, links)
    steps: list[Transfer] = []
    entries: list[Well] = []
    entered: dict[Well, int] = {}
    member_set = set(members)
    fed = _fed_from_outside(trace, members)
    for well in members:
        last: dict[int, Transfer] = {}
        held_stock = well.prefilled and well in linked and not _feeds_last(well, links)
        if held_stock and not roles.has(well.ref, diluent):
            entries.append(well)
            entered[well] = -1
        for visit in trace.deliveries(well):
            for source, volume, _, line in visit.parts:
                if source is None or source is well or volume <= 0 or source in member_set:
                    continue
                if roles.has(source.ref, diluent) or source in shared[well]:
                    continue
                if (
                    roles.has(source.ref, stock)
                    # Unnamed, but it goes into one well only, and that one feeds the others.
                    or (not roles.of(source.ref) and fed[source] == {well} and well in linked)
                ):
                    last[id(source)] = Transfer(source, well, visit, line, True)
                    entered.setdefault(well, visit.index)
        for step in last.values():
            entries.append(well)
            steps.append(step)
    directed = turned_to_fall(order, entries, links)
    position = {well: number for number, well in enumerate(order)}
    for link in sorted(links, key=lambda s: s.visit.index):
        if link.source in entered and entered[link.source] < link.visit.index:
            entered.setdefault(link.well, link.visit.index)
    all_steps = sorted([*steps, *links], key=lambda s: s.visit.index)
    return Series(order, position, all_steps, links, directed, entered, fillers)


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


def _wells_of(links: Sequence[Transfer]) -> list[Well]:
    return list(dict.fromkeys(well for link in links for well in (link.source, link.well)))


def _in_all(
    trace: Trace, roles: Roles, links: Sequence[Transfer], diluent: frozenset[str]
) -> frozenset[Well]:
    """What every well of a chain is given, by itself or in a mix, while another liquid is diluted
    along it: a component of all reactions (a dye, a label), and neither stock nor a step.
    """
    linked = _wells_of(links)
    given: list[set[Well]] = []
    for well in linked:
        origins = {
            origin
            for visit in trace.deliveries(well)
            for source, _, liquid, _ in visit.parts
            if source is not None and source not in linked
            for origin in (source, *liquid)
            if not roles.has(origin.ref, diluent)
        }
        given.append(origins.difference(linked))
    in_all = frozenset(set.intersection(*given))
    return in_all if any(origins - in_all for origins in given) else frozenset()


def _feeds_last(well: Well, links: Sequence[Transfer]) -> bool:
    """Whether a well only receives from the chain and feeds nothing in it."""
    return all(link.source is not well for link in links)


def _with_neighbours(
    trace: Trace,
    roles: Roles,
    linked: list[Well],
    filling: frozenset[str],
    taken: Collection[Well],
    in_all: Collection[Well],
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
            source is not None and source not in in_all and roles.has(source.ref, filling)
            for visit in trace.deliveries(well)
            for source, _, _, _ in visit.parts
        ):
            members.append(well)
    return members
