"""The trace: everything that a rehearsal's tips did to its wells, and how it so uses each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache, cached_property

from ...adapters.opentrons.instrumentation import Event, LabwareInfo, Operation, OperationKind
from ...vocabulary import WellRef
from .model import Above, Tip, Transfer, Visit, Well
from .tips import Retaking

PlaceKey = tuple[str, int, str]
"""Labware key, generation of the plate, well name."""


@dataclass(frozen=True)
class Imbalance:
    """A well that was filled beyond its capacity, or drawn below what it held.

    Attributes:
        visit: What did it.
        overfilled: Which of the two.
        volume: What it would hold, or what was drawn, µL.
        limit: Its capacity, or what it held, µL.
    """

    visit: Visit
    overfilled: bool
    volume: float
    limit: float


@dataclass
class Beside:
    """Tips that stood over no well while others of the same pipette drew or gave.

    Attributes:
        step: When.
        nozzles: Theirs.
        holding: Whether one of them held liquid.
        missed: Whether one that drew air so was to give liquid to a well later.
        perhaps_bare: Whether a pause before asked for tips to be taken out: it may be these.
    """

    step: Operation
    nozzles: tuple[str, ...]
    holding: bool
    missed: bool = False
    perhaps_bare: bool = False


@dataclass
class Usage:
    """How the run uses a well: which came first, and whether it feeds others.

    What is emptied into the waste, a ``drain``, feeds nothing, and a well that is emptied first
    and filled then is none to draw from.
    """

    first_drawn: bool = False
    received: bool = False
    feeds: bool = False
    prefilled: bool = False
    drain: bool = False

    @property
    def ends(self) -> bool:
        """Whether a well is given liquid, passes none on, and is no drain."""
        return self.received and not (self.first_drawn or self.drain or self.feeds)

    @property
    def side(self) -> str:
        """``source``, ``destination`` or ``""``."""
        return "source" if self.first_drawn else "destination" if self.received else ""


@dataclass
class Trace:
    """Everything that checks may ask about one rehearsal.

    Attributes:
        labware: Facts of each labware, by key.
        wells: Every well that was visited or filled, by place.
        tips: Every tip.
        visits: Every visit, in order.
        transfers: Every transfer from well to well, in order.
        imbalances: Volumes that do not add up.
        shaken: Index, labware keys (``None``: any) of each time a plate was shaken.
        descriptions: What the run says of a liquid, by the liquid's name.
        callers: By line of a function that did something, the lines that called the function.
        log: What all this was read from.
        beside: Each time that tips stood over no well, as told.
        above: Draws from above a well's liquid by tips that held none.
        retakings: Pick-ups from places of a rack that the run has emptied before.
        in_pairs: By pipette, the labware over which only every other tip has a well of its own.
        overdrawn: Wells from which more was drawn than they can hold, with the first such draw.
    """

    labware: Mapping[str, LabwareInfo]
    wells: dict[PlaceKey, Well] = field(default_factory=dict)
    tips: list[Tip] = field(default_factory=list)
    visits: list[Visit] = field(default_factory=list)
    transfers: list[Transfer] = field(default_factory=list)
    imbalances: list[Imbalance] = field(default_factory=list)
    shaken: list[tuple[int, frozenset[str] | None]] = field(default_factory=list)
    descriptions: dict[str, str] = field(default_factory=dict)
    groups: dict[WellRef, tuple[WellRef, ...]] = field(default_factory=dict)
    singles: set[WellRef] = field(default_factory=set)
    callers: dict[int, set[int]] = field(default_factory=dict)
    log: Sequence[Operation | Event] = ()
    beside: list[Beside] = field(default_factory=list)
    overdrawn: dict[Well, Visit] = field(default_factory=dict)
    in_pairs: dict[str, set[str]] = field(default_factory=dict)
    retakings: list[Retaking] = field(default_factory=list)
    above: list[Above] = field(default_factory=list)

    @cached_property
    def links(self) -> Sequence[Transfer]:
        """Transfers between two wells of one plate; of repeated ones the last."""
        links: dict[tuple[Well, Well], Transfer] = {}
        for one in self.transfers:
            if not one.visit.mixing and one.source.plate == one.well.plate:
                links[one.source, one.well] = one
        return list(links.values())

    @cached_property
    def usage(self) -> Mapping[WellRef, Usage]:
        """How the run uses each well, generations of a plate taken together; asked once all is
        read.
        """
        usages: dict[WellRef, Usage] = {}
        for well in sorted(self.wells.values(), key=lambda well: well.generation):
            usage = usages.setdefault(well.ref, Usage())
            usage.prefilled = usage.prefilled or well.prefilled
        # A plate that comes back from the cycler is drawn from, and was filled before.
        for visit in reversed(self.visits):
            usages[visit.well.ref].first_drawn = visit.kind is OperationKind.ASPIRATE
        at_first: dict[WellRef, set[WellRef]] = {}
        for one in self.transfers:
            usages[one.well.ref].received = True
            if not usages[one.source.ref].received:
                at_first.setdefault(one.source.ref, set()).add(one.well.ref)
        served, drains = self.served, _drains(usages, self)
        for ref, into in served.items():
            usages[ref].feeds = not into <= drains
        for ref in drains:
            usages[ref].drain = True
        taken = {visit.well.ref for visit in self.visits if not visit.mixing}
        for ref, used in usages.items():
            # Not what is emptied into the trash, and filled then; nor what is only mixed.
            if ref in served or used.received or ref not in taken:
                used.first_drawn = used.first_drawn and used.feeds
            if used.received and at_first.get(ref, set()) <= drains:
                used.first_drawn = False  # emptied, filled again, and harvested in the end
        return usages

    @cached_property
    def sides(self) -> Callable[[WellRef], tuple[str, bool]]:
        """On which side of the run's transfers a well stands: ``source``, ``destination`` or
        ``""``, and whether it passes liquid on as well; asked once all is read, for each family.

        A well that the run never uses stands where the others of its labware stand.
        """
        return cache(self._sides_of)

    def _sides_of(self, ref: WellRef) -> tuple[str, bool]:
        used = self.usage.get(ref) or Usage()
        side = used.side
        if not side:
            others = self._sides.get(ref.labware, set())
            if len(others) == 1:
                side = next(iter(others))
            elif used.prefilled:
                side = "source"
        return side, used.feeds and used.received

    @cached_property
    def _sides(self) -> Mapping[str, Set[str]]:
        found: dict[str, set[str]] = {}
        for ref, used in self.usage.items():
            if used.side:
                found.setdefault(ref.labware, set()).add(used.side)
        return found

    @cached_property
    def served(self) -> Mapping[WellRef, Set[WellRef]]:
        """For each well the wells that liquid drawn from it came into; asked once all is read.

        In the order of the run: a set's own order differs from process to process.
        """
        found: dict[WellRef, dict[WellRef, None]] = {}
        for one in self.transfers:
            found.setdefault(one.source.ref, {})[one.well.ref] = None
        return {source: into.keys() for source, into in found.items()}

    def mixed_since(self, well: Well, index: int, before: float) -> bool:
        """Whether ``well`` was mixed or shaken after ``index`` and before ``before``."""
        if any(index < last and first < before for first, last in well.mixes):
            return True
        # Labware that no tip ever met is another name of what stands there.
        return any(
            index < at < before and (not keys or well.ref.labware in keys or not keys & self._met)
            for at, keys in self.shaken
        )

    @cached_property
    def _met(self) -> Set[str]:
        return {well.ref.labware for well in self.wells.values()}


_FEWEST_EMPTIED = 2
"""One well that is tested before it is filled is not emptied."""


def _drains(usages: Mapping[WellRef, Usage], trace: Trace) -> set[WellRef]:
    """Where old medium goes, and what stands over beads: what several wells are emptied into that
    are filled again, or a trough for what several wells got in the run.
    """
    troughs = {key for key, info in trace.labware.items() if info.centers_channels}
    emptied = Counter(
        well
        for ref, wells in trace.served.items()
        for well in wells
        if usages[ref].received and (usages[ref].first_drawn or well.labware in troughs)
    )
    drawn = {visit.well.ref for visit in trace.visits if visit.kind is OperationKind.ASPIRATE}
    return {ref for ref, count in emptied.items() if count >= _FEWEST_EMPTIED and ref not in drawn}


def chains_of(links: Sequence[Transfer]) -> list[list[Transfer]]:
    """Groups of links that are joined into chains.

    A well that feeds many others, or is fed by many, is a stock or a pool, and joins nothing.
    """
    fed: dict[Well, set[Well]] = {}
    feeds: dict[Well, set[Well]] = {}
    for link in links:
        feeds.setdefault(link.source, set()).add(link.well)
        fed.setdefault(link.well, set()).add(link.source)
    kept = [
        link
        for link in links
        if len(fed[link.well]) <= 2 and (len(feeds[link.source]) <= 2 or not link.source.prefilled)
    ]
    chains: dict[Well, list[Well]] = {}
    for link in kept:
        one, other = (chains.setdefault(well, [well]) for well in (link.source, link.well))
        if one is not other:
            one += other
            chains.update(dict.fromkeys(other, one))
    groups: dict[int, list[Transfer]] = {}
    for link in kept:
        groups.setdefault(id(chains[link.source]), []).append(link)
    return list(groups.values())
