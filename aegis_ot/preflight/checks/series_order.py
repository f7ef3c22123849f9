"""The order of the wells in a dilution series."""

from __future__ import annotations

from collections.abc import Sequence

from ..trace import Transfer, Well


def best_order(members: list[Well], links: Sequence[Transfer]) -> list[Well]:
    """Row by row or column by column, whichever makes more links neighbours."""

    def neighbours(order: list[Well]) -> int:
        position = {well: number for number, well in enumerate(order)}
        return sum(abs(position[s.well] - position[s.source]) == 1 for s in links)

    by_row = sorted(members, key=lambda well: well.order)
    by_column = sorted(members, key=lambda well: (well.order[1], well.order[0]))
    as_made = _as_made(members, links)
    return (
        max((by_column, by_row, as_made), key=neighbours)
        if len({well.order[0] for well in members}) > 1
        and len({well.order[1] for well in members}) > 1
        else by_row
    )


def _as_made(members: list[Well], links: Sequence[Transfer]) -> list[Well]:
    """The order in which the chain was made."""
    order: list[Well] = []
    for link in links:
        for well in (link.source, link.well):
            if well not in order:
                order.append(well)
    return order + [well for well in members if well not in order]
