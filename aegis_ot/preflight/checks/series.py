"""Finds dilution series: which wells follow one another, and which transfers are steps.

A series is found from transfers between wells of one labware that form a chain, together with
the roles of stock and diluent. Its order is the layout's (a row, a column, or the labware's own
order), running away from the well in which the stock stands.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..trace import Transfer, Visit, Well, chains_of
from .rule_context import RuleContext

_SHORTEST = 2
_MANY = 3
"""A well that is shared out to as many others is no step of the series they may belong to."""

_SAME = 0.05
"""Volumes and shares that differ by no more of the larger one are the same."""


@dataclass(frozen=True)
class Series:
    """One dilution series.

    Attributes:
        position: Its wells with their places, the most concentrated first if that is known.
        steps: Its dilution steps, in the order in which they are made.
        links: Those of them between two wells of the series; the others bring stock.
        directed: Whether the most concentrated end is known.
        entered: Index at which each well first held stock (-1: before the run).
    """

    position: Mapping[Well, int]
    steps: Sequence[Transfer]
    links: Sequence[Transfer]
    directed: bool
    entered: Mapping[Well, int]


class SeriesFinder:
    """Finds the series of a run, in the eyes of one family.

    Attributes:
        found: All series with at least two transfers between their wells.
        fillers: Wells that a whole series is filled from, whatever they are called.
    """

    def __init__(self, case: RuleContext) -> None:
        self._case = case
        self._has = case.has
        self._stock, self._diluent = case.family.series.stock, case.family.series.diluent
        links, self.fillers = along_series(list(filter(self._is_link, case.trace.links)))
        groups = [
            group for group in chains_of(links) if len(group) >= _SHORTEST and not is_copying(group)
        ]
        self._taken = {well for group in groups for well in wells_of(group)}
        self._in_all_of_any = frozenset().union(*map(self._in_all, groups))
        self.found = list(map(self._series, groups))

    def _is_link(self, one: Transfer) -> bool:
        """Whether a transfer within a plate may run along a series: between no reagents."""
        if one.well.ref in self._case.waste:
            return False
        if self._has(one.source, self._diluent) or self._has(one.well, self._diluent):
            return False
        return not self._has(one.source, self._stock) or self._is_made(one.source)

    def _is_made(self, well: Well) -> bool:
        """Whether a well named as a stock was filled in the run: a standard, the undiluted head."""
        made_of = (*self._diluent, *self._stock)
        return not well.prefilled and any(
            self._has(one.source, made_of) or one.source.ref.labware == well.ref.labware
            for one in well.received
        )

    def _series(self, links: Sequence[Transfer]) -> Series:
        linked = wells_of(links)
        members = self._with_neighbours(linked)
        in_all = self._in_all(links)
        feeding = {link.source for link in links}
        steps: list[Transfer] = []
        entries: list[Well] = []
        entered: dict[Well, int] = {}
        for well in members:
            if well.prefilled and well in feeding and not self._has(well, self._diluent):
                entries.append(well)
                entered[well] = -1
            last: dict[Well, Transfer] = {}
            # Beside the chain, what all wells of another chain are given is no stock either.
            shared = in_all if well in linked else self._in_all_of_any
            for one in well.received:
                if one.source not in shared and self._brings_stock(one, members, linked):
                    last[one.source] = one
                    entered.setdefault(well, one.visit.index)
            entries += [well] * len(last)
            steps += last.values()
        order = _best_order(members, links)
        directed = _turned_to_fall(order, entries, links)
        for link in sorted(links, key=lambda s: s.visit.index):
            if link.source in entered and entered[link.source] < link.visit.index:
                entered.setdefault(link.well, link.visit.index)
        all_steps = sorted([*steps, *links], key=lambda s: s.visit.index)
        position = {well: number for number, well in enumerate(order)}
        return Series(position, all_steps, links, directed, entered)

    def _brings_stock(
        self, one: Transfer, members: Sequence[Well], linked: Collection[Well]
    ) -> bool:
        """Whether a transfer into a series brings stock from outside."""
        if one.source in members or self._has(one.source, self._diluent):
            return False
        if self._has(one.source, self._stock):
            return True
        # Unnamed, but it goes into one well only, and that one feeds the others.
        if self._case.of(one.source) or one.well not in linked:
            return False
        served = self._case.trace.served[one.source.ref]
        return served.isdisjoint(well.ref for well in members if well is not one.well)

    def _in_all(self, links: Sequence[Transfer]) -> frozenset[Well]:
        """What every well of a chain is given, by itself or in a mix, while another liquid is
        diluted along it: a component of all reactions (a dye, a label), and neither stock nor step.
        """
        linked = wells_of(links)
        given: list[set[Well]] = []
        for well in linked:
            origins = {
                origin
                for one in well.received
                if one.source not in linked
                for origin in (one.source, *one.liquid)
                if not self._has(origin, self._diluent)
            }
            given.append(origins.difference(linked))
        in_all = frozenset(set.intersection(*given))
        return in_all if any(origins - in_all for origins in given) else frozenset()

    def _with_neighbours(self, linked: list[Well]) -> list[Well]:
        """Add wells of the same row or column that were given stock or diluent, but no link.

        Wells of another series in that row are none of this one's.
        """
        lines = [{well.order[axis] for well in linked} for axis in (0, 1)]
        filling = (*self._diluent, *self._stock)
        return linked + [
            well
            for well in self._case.trace.wells.values()
            if well not in self._taken
            and well.plate == linked[0].plate
            and any(len(lines[axis]) == 1 and well.order[axis] in lines[axis] for axis in (0, 1))
            and any(
                one.source not in self._in_all_of_any and self._has(one.source, filling)
                for one in well.received
            )
        ]


def _best_order(members: Sequence[Well], links: Sequence[Transfer]) -> list[Well]:
    """Row by row, column by column or as the chain was made: what makes most links neighbours."""

    def neighbours(order: list[Well]) -> int:
        position = {well: number for number, well in enumerate(order)}
        return sum(abs(position[s.well] - position[s.source]) == 1 for s in links)

    by_row = sorted(members, key=lambda well: well.order)
    if any(len({well.order[axis] for well in members}) == 1 for axis in (0, 1)):
        return by_row
    by_column = sorted(members, key=lambda well: well.order[::-1])
    as_made = list(dict.fromkeys((*wells_of(links), *members)))
    return max((by_column, by_row, as_made), key=neighbours)


def _turned_to_fall(order: list[Well], entries: Sequence[Well], links: Sequence[Transfer]) -> bool:
    """Turn an order in place, if need be, so that it runs away from the stock, which goes into
    ``entries``; returns whether it is known which end is the most concentrated one.
    """
    if entries:
        # Where stock stands in the diluent's place too, only the well that no other feeds tells.
        linked = set(wells_of(links))
        fed_within = {link.well for link in links}
        unfed = [well for well in entries if well not in fed_within]
        heads = [well for well in unfed if well in linked]
        # Among the wells of the chain, if its head is one; others may stand beside it.
        along = [well for well in order if well in linked] if heads else order
        place = {well: number for number, well in enumerate(along)}
        ends = [place[well] for well in heads or unfed or entries]
        middle = sum(ends) / len(ends)
        if middle > (len(along) - 1) / 2:
            order.reverse()
        return middle != (len(along) - 1) / 2
    position = {well: number for number, well in enumerate(order)}
    if sum(1 if position[s.well] > position[s.source] else -1 for s in links) < 0:
        order.reverse()
    return False


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
