"""Which wells get pictures where there are too many."""

from __future__ import annotations

from collections.abc import Sequence


def pictured(wells: Sequence[tuple[bool, bool]], most: int) -> list[bool]:
    """Whether each well gets pictures.

    Args:
        wells: For each, whether it was flagged and whether it was judged wrongly.
        most: How many may.

    Returns:
        Wrongly judged and flagged wells first, then the others in order.
    """
    ranked = sorted(
        range(len(wells)), key=lambda place: (not wells[place][1], not wells[place][0], place)
    )
    chosen = set(ranked[: max(most, 0)])
    return [place in chosen for place in range(len(wells))]
