"""The order of the wells in a dilution series."""

from __future__ import annotations

from collections.abc import Sequence

from ..trace import Transfer, Well


def best_order(members: Sequence[Well], links: Sequence[Transfer]) -> list[Well]:
    """Row by row, column by column or as the chain was made: what makes most links neighbours."""

    def neighbours(order: list[Well]) -> int:
        position = {well: number for number, well in enumerate(order)}
        return sum(abs(position[s.well] - position[s.source]) == 1 for s in links)

    by_row = sorted(members, key=lambda well: well.order)
    if any(len({well.order[axis] for well in members}) == 1 for axis in (0, 1)):
        return by_row
    by_column = sorted(members, key=lambda well: well.order[::-1])
    made = (well for link in links for well in (link.source, link.well))
    as_made = list(dict.fromkeys((*made, *members)))
    return max((by_column, by_row, as_made), key=neighbours)


def turned_to_fall(
    order: list[Well],
    entries: Sequence[Well],
    links: Sequence[Transfer],
) -> bool:
    """Turn an order in place, if need be, so that it runs away from the stock.

    Args:
        order: The wells of a series, in the order of its labware.
        entries: Those that stock goes into.
        links: The transfers between them.

    Returns:
        Whether it is known which end is the most concentrated one.
    """
    if entries:
        # Where stock stands in the diluent's place too, only the well that no other feeds tells.
        linked = {well for link in links for well in (link.source, link.well)}
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
