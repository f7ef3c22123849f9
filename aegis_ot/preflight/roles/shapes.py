"""The shapes of the liquid's ways through a run, whatever the wells are called.

Wells that feed each other in turn (``chain``); one well fed by many that feed nothing else
(``pooling``); wells given as much each of a common liquid, and one of their own (``reactions``).
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Set

from ...vocabulary import WellRef
from ..rules import Shape
from ..trace import Trace, chains_of

_FEWEST_POOLED = 4
_FEWEST_ALIKE = 3
_MANY = 6
"""From so many wells on, more of them make a shape no clearer."""

Fed = Mapping[WellRef, Mapping[WellRef, float]]
"""For each well the µL that it is given of each well drawn from."""


def shapes_of(trace: Trace) -> dict[Shape, tuple[float, str]]:
    """The shapes that a run shows: how clearly (1 for three wells, 2 for six) and in words."""
    fed, feeds = _fed(trace), trace.served
    found: dict[Shape, tuple[float, str]] = {}
    chain = max(map(len, chains_of(trace.links)), default=0)
    if chain >= 2:
        found["chain"] = (_clearness(chain), f"a chain of {chain} transfers from well to well")
    pooled = _pooled(fed, feeds)
    if pooled >= _FEWEST_POOLED:
        found["pooling"] = (_clearness(pooled), f"{pooled} wells go into a pool and nowhere else")
    reactions = _reactions(fed, feeds)
    if reactions >= _FEWEST_ALIKE:
        said = f"{reactions} wells are given as much each of a common liquid and one of their own"
        found["reactions"] = (_clearness(reactions), said)
    return found


def _clearness(wells: int) -> float:
    return min(wells, _MANY) / _FEWEST_ALIKE


def _fed(trace: Trace) -> Fed:
    fed: dict[WellRef, dict[WellRef, float]] = defaultdict(lambda: defaultdict(float))
    for one in trace.transfers:
        fed[one.well.ref][one.source.ref] += one.volume
    return fed


def _pooled(fed: Fed, feeds: Mapping[WellRef, Set[WellRef]]) -> int:
    """Wells that nothing is put into, and that go into a well together with others like them."""
    pools = Counter(
        well
        for well, given in fed.items()
        for source in given
        if len(feeds[source]) == 1 and source not in fed
    )
    return sum(wells for wells in pools.values() if wells >= _FEWEST_POOLED)


def _reactions(fed: Fed, feeds: Mapping[WellRef, Set[WellRef]]) -> int:
    """Wells that go nowhere, with as much of a common liquid as others, and something else.

    The something else goes into fewer wells than the common liquid does. What is brought to one
    concentration with water gets more of it or less from well to well, and is no reaction.
    """
    ends = {well: given for well, given in fed.items() if well not in feeds}
    alike = Counter(
        (source, f"{volume:.3g}") for given in ends.values() for source, volume in given.items()
    )
    return sum(
        any(
            alike[source, f"{volume:.3g}"] >= _FEWEST_ALIKE
            and any(len(feeds[other]) < len(feeds[source]) for other in given)
            for source, volume in given.items()
        )
        for given in ends.values()
    )
