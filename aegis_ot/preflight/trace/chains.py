"""Chains of wells that each feed the next, whatever they are for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...instrumentation import OperationKind
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


def longest_chain(chains: Iterable[Sequence[Transfer]]) -> int:
    """Number of transfers in the longest chain of wells that each feed the next."""
    return max((len({(s.source, s.well) for s in group}) for group in chains), default=0)


def longest_dilution(chains: Iterable[Sequence[Transfer]]) -> int:
    """Number of transfers in the longest chain from neighbour to neighbour that dilutes.

    Most of its wells were filled from one and the same place before the chain reached them.
    """
    best = 0
    for group in chains:
        steps = {(s.source, s.well): s for s in group if _neighbours(s.source, s.well)}
        filled: dict[Well, int] = {}
        for step in steps.values():
            for source in _filled_before(step):
                filled[source] = filled.get(source, 0) + 1
        best = max(best, max(filled.values(), default=0))
    return best


def _neighbours(one: Well, other: Well) -> bool:
    rows, columns = (abs(a - b) for a, b in zip(one.order, other.order, strict=True))
    return rows + columns == 1


def _filled_before(step: Transfer) -> set[Well]:
    """Wells that gave to the well of a step before the step did: of other labware, or, as a tube
    of diluent beside those of the series, filled by nothing themselves.

    What was drawn off again before the step, a wash, fills nothing; and a well that is passed
    through several times is rinsed.
    """
    found: set[Well] = set()
    first = next(v for v in step.well.visits if any(p[0] is step.source for p in v.parts))
    if any(
        visit.kind is OperationKind.ASPIRATE and not visit.mixing
        for visit in step.well.visits
        if first.index < visit.index < step.visit.index
    ):
        return found
    for visit in step.well.visits:
        if visit.kind is OperationKind.ASPIRATE and not visit.mixing:
            found.clear()
        given = {part[0] for part in visit.parts if part[0] is not None}
        if step.source in given:
            break
        found |= {
            source
            for source in given
            if source.ref.labware != step.well.ref.labware or not _is_filled(source)
        }
    return found


def _is_filled(well: Well) -> bool:
    return any(part[0] not in (None, well) for visit in well.visits for part in visit.parts)


def links_of(trace: Trace) -> Iterable[Transfer]:
    """Transfers between two wells of one labware, repeated ones joined."""
    open_: dict[tuple[int, int], Transfer] = {}
    order: list[tuple[int, int]] = []
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
            key = (id(source), id(visit.well))
            if key not in open_:
                order.append(key)
            open_[key] = Transfer(source, visit.well, visit, line, False)
    return [open_[key] for key in order]


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
