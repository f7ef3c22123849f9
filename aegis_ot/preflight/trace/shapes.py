"""The shapes of the liquid's ways through a run, whatever the wells are called."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from ...instrumentation import LabwareInfo
from ...vocabulary import WellRef
from .chains import Transfer, chains_of, links_of, longest_chain, longest_dilution
from .trace import Trace

SHAPES = ("chain", "chains_alone", "pooling", "reactions", "copying", "culture")
"""What a family's file may name: wells that feed each other in turn; nothing but such wells that
are filled; one well fed by many that feed nothing else; wells given as much each of a common
liquid, and one of their own; wells of one labware that each fill one well of another with nothing
else in it; wells that are given various liquids, and feed none, in a plate of the format in which
cells are grown."""

_CULTURE_FORMATS = (6, 12, 24, 48)
"""How many wells the plates have that are made for cells; those of 96 serve for all things."""

_FEWEST_POOLED = 4
_FEWEST_ALIKE = 3
_MANY = 6
"""From so many wells on, more of them make a shape no clearer."""

Fed = Mapping[WellRef, Mapping[WellRef, float]]
"""For each well the µL that it is given of each well drawn from."""


def shapes_of(trace: Trace) -> dict[str, tuple[float, str]]:
    """The shapes that a run shows: how clearly (1 for three wells, 2 for six) and in words."""
    fed, feeds = _ways(trace)
    found: dict[str, tuple[float, str]] = {}
    chains = chains_of(list(links_of(trace)))
    chain = longest_chain(chains)
    if chain >= 2:
        # Wells filled from one place that then feed each other are a series without a word.
        twice = 2 if longest_dilution(chains) >= _FEWEST_ALIKE else 1
        found["chain"] = (
            twice * _clearness(chain),
            f"a chain of {chain} transfers from well to well",
        )
    if longest_dilution(chains) >= _FEWEST_ALIKE and _is_all(chains, fed):
        said = "no other wells are filled than those that feed each other"
        found["chains_alone"] = (1.0, said)
    pooled = _pooled(fed, feeds)
    if pooled >= _FEWEST_POOLED:
        found["pooling"] = (_clearness(pooled), f"{pooled} wells go into a pool and nowhere else")
    reactions = _reactions(fed, feeds)
    if reactions >= _FEWEST_ALIKE:
        said = f"{reactions} wells are given as much each of a common liquid and one of their own"
        found["reactions"] = (_clearness(reactions), said)
    copies = _copies(fed, feeds)
    if copies >= _FEWEST_ALIKE:
        found["copying"] = (_clearness(copies), f"{copies} wells are each copied into another one")
    grown_in = _culture_plate(trace, fed, feeds)
    if grown_in is not None:
        found["culture"] = (1.0, f"wells of a {grown_in}-well culture plate are treated apart")
    return found


def _is_all(chains: Iterable[Sequence[Transfer]], fed: Fed) -> bool:
    """Whether the run fills the wells of chains alone; the surplus of their ends goes anywhere, and
    what most of them are filled with into blanks as well.
    """
    linked = {
        well.ref
        for chain in chains
        if longest_chain([chain]) >= _FEWEST_ALIKE
        for step in chain
        for well in (step.source, step.well)
    }
    filling = Counter(source for well in linked for source in fed.get(well, ()))
    fillers = {source for source, count in filling.items() if 2 * count > len(linked)}
    beside = [
        given.keys()
        for well, given in fed.items()
        if well not in linked and not given.keys() <= fillers
    ]
    return len(beside) <= 1 and all(given <= linked for given in beside)


def _clearness(wells: int) -> float:
    return min(wells, _MANY) / _FEWEST_ALIKE


def _ways(trace: Trace) -> tuple[dict[WellRef, dict[WellRef, float]], dict[WellRef, set[WellRef]]]:
    """What each well is given of which, and which wells each one feeds."""
    fed: dict[WellRef, dict[WellRef, float]] = {}
    feeds: dict[WellRef, set[WellRef]] = {}
    for visit in trace.visits:
        for source, volume, _, _ in visit.parts:
            if source is not None and source is not visit.well and volume > 0:
                given = fed.setdefault(visit.well.ref, {})
                given[source.ref] = given.get(source.ref, 0.0) + volume
                feeds.setdefault(source.ref, set()).add(visit.well.ref)
    return fed, feeds


def _pooled(fed: Fed, feeds: Mapping[WellRef, set[WellRef]]) -> int:
    """Wells that nothing is put into, and that go into a well together with others like them."""
    pools = Counter(
        well
        for well, given in fed.items()
        for source in given
        if len(feeds[source]) == 1 and source not in fed
    )
    return sum(wells for wells in pools.values() if wells >= _FEWEST_POOLED)


def _reactions(fed: Fed, feeds: Mapping[WellRef, set[WellRef]]) -> int:
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


def _copies(fed: Fed, feeds: Mapping[WellRef, set[WellRef]]) -> int:
    """Wells that are filled from one well of another labware, which fills no other."""
    return sum(
        len(given) == 1
        and all(
            len(feeds[source]) == 1 and source not in fed and source.labware != well.labware
            for source in given
        )
        for well, given in fed.items()
    )


def _culture_plate(trace: Trace, fed: Fed, feeds: Mapping[WellRef, set[WellRef]]) -> int | None:
    """The format of the first culture plate whose wells feed none, and are not all given the same.

    Cells that are all given the same are fed, stained or washed.
    """
    for key, info in trace.labware.items():
        wells = {well for well in fed if well.labware == key}
        various = len({frozenset(fed[well]) for well in wells}) > 1
        if various and wells.isdisjoint(feeds) and _is_for_cells(info):
            return len(info.wells)
    return None


def _is_for_cells(info: LabwareInfo) -> bool:
    """Whether it has the wells of a culture plate: few, round and flat. Tubes are narrower."""
    return len(info.wells) in _CULTURE_FORMATS and all(
        well.diameter is not None and well.diameter > well.depth / 2 for well in info.wells.values()
    )
