"""Chains of wells that each feed the next, whatever they are for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from .model import Visit, Well
from .trace import Trace


@dataclass(frozen=True)
class Transfer:
    """One transfer into a well of the series.

    Attributes:
        source: Well drawn from.
        well: Well that is diluted into.
        visit: The last delivery of this transfer.
        drawn: Line of the draw.
        from_stock: Whether it brings stock rather than the well before.
    """

    source: Well
    well: Well
    visit: Visit
    drawn: int | None
    from_stock: bool


def links_of(trace: Trace) -> Iterable[Transfer]:
    """Transfers between two wells of one labware, repeated ones joined."""
    open_: dict[tuple[int, int], Transfer] = {}
    for visit in trace.visits:
        if visit.mixing:
            continue
        for source, volume, _, line in visit.parts:
            if source is None or source is visit.well or volume <= 0:
                continue
            if (
                source.ref.labware != visit.well.ref.labware
                or source.generation != visit.well.generation
            ):
                continue
            open_[id(source), id(visit.well)] = Transfer(source, visit.well, visit, line, False)
    return list(open_.values())


def chains_of(links: Sequence[Transfer]) -> list[list[Transfer]]:
    """Groups of links that are joined into chains.

    A well that feeds many others, or is fed by many, is a stock or a pool, and joins nothing.
    """
    fed: dict[Well, set[Well]] = {}
    feeds: dict[Well, set[Well]] = {}
    for link in links:
        feeds.setdefault(link.source, set()).add(link.well)
        fed.setdefault(link.well, set()).add(link.source)
    parent: dict[Well, Well] = {}

    def root(well: Well) -> Well:
        parent.setdefault(well, well)
        while parent[well] is not well:
            parent[well] = parent[parent[well]]
            well = parent[well]
        return well

    kept = [
        link
        for link in links
        if len(fed[link.well]) <= 2 and (len(feeds[link.source]) <= 2 or not link.source.prefilled)
    ]
    for link in kept:
        parent[root(link.source)] = root(link.well)
    groups: dict[Well, list[Transfer]] = {}
    for link in kept:
        groups.setdefault(root(link.source), []).append(link)
    return list(groups.values())
