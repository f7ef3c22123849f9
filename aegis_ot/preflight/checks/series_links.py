"""Which transfers within a labware are made along a dilution series, and which are not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from ..trace import Transfer, Visit, Well

_MANY = 3
"""A well that is shared out to as many others is no step of the series they may belong to."""

_SAME = 0.05
"""Volumes and shares that differ by no more of the larger one are the same."""


def wells_of(links: Iterable[Transfer]) -> list[Well]:
    """The wells that links join, each once, in order of the links."""
    return list(dict.fromkeys(well for link in links for well in (link.source, link.well)))


def along_series(links: Sequence[Transfer]) -> tuple[list[Transfer], frozenset[Well]]:
    """The links that may be steps of a series, and the wells of a plate that fill the others."""
    feeds = _by_source(links)
    fillers = frozenset(well for well, given in feeds.items() if _fills(well, given, links))
    aside = {
        well
        for well, given in feeds.items()
        if well in fillers or (well.prefilled and len({link.well for link in given}) >= _MANY)
    }
    return [link for link in links if link.source not in aside], fillers


def is_copying(links: Sequence[Transfer]) -> bool:
    """Whether wells are only shared out to others that feed none.

    What these hold besides may not have been there before.
    """
    sources = {link.source for link in links}
    if any(link.well in sources for link in links):
        return False
    return all(first_of(link).empty_before for link in links) or all(
        one.source is link.source for link in links for one in link.well.received
    )


def branching(links: Iterable[Transfer]) -> set[Well]:
    """Wells that are diluted by different factors into others: no line, but a tree."""
    return {
        well
        for well, given in _by_source(links).items()
        if any(map(_differ, zip(*map(_brought, given), strict=True)))
    }


def first_of(link: Transfer) -> Visit:
    """The first delivery of a link that took several."""
    return next(one.visit for one in link.well.received if one.source is link.source)


def _by_source(links: Iterable[Transfer]) -> dict[Well, list[Transfer]]:
    found: dict[Well, list[Transfer]] = {}
    for link in links:
        found.setdefault(link.source, []).append(link)
    return found


def _fills(well: Well, given: Sequence[Transfer], links: Sequence[Transfer]) -> bool:
    """Whether a well is shared out to empty ones that then feed each other: it fills them."""
    filled = {link.well for link in given}
    if len(filled) < _MANY:
        return False
    fed_else = {link.well for link in links if link.source is not well}
    return len(filled - fed_else) <= 1 and all(first_of(link).empty_before for link in given)


def _differ(values: Iterable[float]) -> bool:
    return any(b - a > _SAME * b for a, b in pairwise(sorted(values)))


def _brought(link: Transfer) -> tuple[float, float]:
    """What a link brings, µL, and its share in all that the well has been given by then."""
    given = [one for one in link.well.received if one.visit.index <= link.visit.index]
    brought = sum(one.volume for one in given if one.source is link.source)
    total = sum(one.volume for one in given)
    return brought, brought / total if total > 0 else 0.0
