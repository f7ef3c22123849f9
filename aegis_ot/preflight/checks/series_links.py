"""Which transfers within a labware are made along a dilution series, and which are not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from ..trace import Trace, Transfer, Visit, Well

_MANY = 3
"""A well that is shared out to as many others is no step of the series they may belong to."""

_SAME = 0.05
"""Volumes and shares that differ by no more of the larger one are the same."""


def along_series(trace: Trace, links: Sequence[Transfer]) -> tuple[list[Transfer], frozenset[Well]]:
    """The links that may be steps of a series, and the wells of a plate that fill the others."""
    feeds = _by_source(links)
    fillers = frozenset(well for well, given in feeds.items() if _fills(trace, well, given, links))
    aside = {
        well
        for well, given in feeds.items()
        if well in fillers or (well.prefilled and len({link.well for link in given}) >= _MANY)
    }
    links = [link for link in links if link.source not in aside]
    return links, fillers


def is_copying(trace: Trace, links: Sequence[Transfer]) -> bool:
    """Whether wells are only shared out to others that feed none.

    What these hold besides may not have been there before.
    """
    sources = {link.source for link in links}
    return all(
        link.well not in sources and first_from(trace, link.source, link.well).empty_before
        for link in links
    ) or all(
        link.well not in sources
        and all(
            part[0] in (link.source, link.well)
            for visit in trace.deliveries(link.well)
            for part in visit.parts
        )
        for link in links
    )


def branching(trace: Trace, links: Iterable[Transfer]) -> set[Well]:
    """Wells that are diluted by different factors into others: no line, but a tree."""
    return {well for well, given in _by_source(links).items() if _factors(trace, given) > 1}


def _by_source(links: Iterable[Transfer]) -> dict[Well, list[Transfer]]:
    found: dict[Well, list[Transfer]] = {}
    for link in links:
        found.setdefault(link.source, []).append(link)
    return found


def first_from(trace: Trace, source: Well, well: Well) -> Visit:
    """The first visit that brought liquid from one well to another."""
    return next(
        visit for visit in trace.deliveries(well) if any(p[0] is source for p in visit.parts)
    )


def _fills(trace: Trace, well: Well, given: Sequence[Transfer], links: Sequence[Transfer]) -> bool:
    """Whether a well is shared out to empty ones that then feed each other: it fills them."""
    filled = {link.well for link in given}
    if len(filled) < _MANY:
        return False
    fed_else = {link.well for link in links if link.source is not well}
    return len(filled - fed_else) <= 1 and all(
        first_from(trace, well, link.well).empty_before for link in given
    )


def _factors(trace: Trace, links: Sequence[Transfer]) -> int:
    """How many dilution factors, or transferred volumes, these links have."""
    brought = [_brought(trace, link) for link in links]
    return max(
        _distinct([volume for volume, _ in brought]), _distinct([share for _, share in brought])
    )


def _distinct(values: Sequence[float]) -> int:
    return 1 + sum(b - a > _SAME * b for a, b in pairwise(sorted(values)))


def _brought(trace: Trace, link: Transfer) -> tuple[float, float]:
    """What a link brings, µL, and its share in all that the well has been given by then."""
    brought = total = 0.0
    for visit in trace.deliveries(link.well):
        if visit.index > link.visit.index:
            break
        for source, volume, _, _ in visit.parts:
            if source is link.well:
                continue
            total += volume
            if source is link.source:
                brought += volume
    return brought, brought / total if total > 0 else 0.0
