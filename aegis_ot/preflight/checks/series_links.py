"""Which transfers within a labware are made along a dilution series, and which are not."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from ..roles import Roles
from ..trace import Trace, Transfer, Visit, Well, row_column

_MANY = 3
"""A well that is shared out to as many others is no step of the series they may belong to."""

_SAME = 0.05
"""Volumes and shares that differ by no more of the larger one are the same."""


def along_series(
    trace: Trace, roles: Roles, links: Sequence[Transfer], diluent: frozenset[str]
) -> tuple[list[Transfer], frozenset[Well]]:
    """The links that may be steps of a series, and the wells of a plate that fill the others."""
    feeds = _by_source(links)
    fillers = frozenset(well for well, given in feeds.items() if _fills(trace, well, given, links))
    aside = {
        well
        for well, given in feeds.items()
        if well in fillers
        or (well.prefilled and len({link.well for link in given}) >= _MANY)
        or _dilutes_in_parallel(trace, given, feeds)
    }
    links = [link for link in links if link.source not in aside]
    return _dilutions(trace, roles, links, diluent), fillers


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


def _dilutes_in_parallel(
    trace: Trace, given: Sequence[Transfer], feeds: Mapping[Well, Sequence[Transfer]]
) -> bool:
    """Whether a well is diluted by several factors into others that go no further."""
    ends = [link for link in given if link.well not in feeds]
    return len(ends) == len(given) and _factors(trace, given) >= _MANY


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


def _dilutions(
    trace: Trace, roles: Roles, links: Sequence[Transfer], diluent: frozenset[str]
) -> list[Transfer]:
    """Leave out transfers that copy a dilution elsewhere instead of diluting it further.

    A well that is given nothing but the one transfer, off the line along which the others
    of its labware dilute, is a copy; one that is made as the others are, a row or a column
    further, is not, nor one from which the chain goes on.
    """
    by_labware: dict[str, list[Transfer]] = {}
    for link in links:
        by_labware.setdefault(link.well.ref.labware, []).append(link)
    kept = {
        id(link)
        for together in by_labware.values()
        for link in _dilutions_on_one(trace, roles, together, diluent)
    }
    return [link for link in links if id(link) in kept]


def _dilutions_on_one(
    trace: Trace, roles: Roles, links: Sequence[Transfer], diluent: frozenset[str]
) -> Sequence[Transfer]:
    diluted = [
        link
        for link in links
        if any(
            source is not None and roles.has(source.ref, diluent)
            for visit in trace.deliveries(link.well)
            for source, _, _, _ in visit.parts
        )
    ]
    if not diluted:
        return links
    sure = {id(link) for link in diluted}
    along_rows = sum(link.source.order[0] == link.well.order[0] for link in diluted)
    along_columns = sum(link.source.order[1] == link.well.order[1] for link in diluted)
    axis = 0 if along_rows >= along_columns else 1
    lines = {link.source.order[axis] for link in diluted}
    steps = {_across(link, axis) for link in diluted}
    sources = {link.source for link in links}
    return [
        link
        for link in links
        if id(link) in sure
        or (
            link.source.order[axis] == link.well.order[axis]
            and (
                link.well in sources
                or link.well.order[axis] in lines
                or _across(link, axis) in steps
            )
        )
        or (
            _begins_next_line(link, axis)
            and (link.well in sources or _ends_its_line(trace, link.source, axis))
        )
    ]


def _begins_next_line(link: Transfer, axis: int) -> bool:
    """Whether a link goes from the end of a line to the head of the next, as one writes."""
    ahead = link.well.order[axis] - link.source.order[axis]
    return ahead == 1 and link.well.order[1 - axis] == 0 < link.source.order[1 - axis]


def _ends_its_line(trace: Trace, well: Well, axis: int) -> bool:
    """Whether no well of its labware stands further along its row or column."""
    names = trace.labware[well.ref.labware].wells
    return well.order[1 - axis] == max(row_column(name)[1 - axis] for name in names)


def _across(link: Transfer, axis: int) -> tuple[int, int]:
    """Where a link begins and ends on its line, whichever of the parallel lines it is."""
    return (link.source.order[1 - axis], link.well.order[1 - axis])
