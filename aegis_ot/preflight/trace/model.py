"""What a trace is made of: wells, tips, and what each tip did at each well."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from ...adapters.opentrons.instrumentation import Operation, OperationKind, expel
from ...vocabulary import WellRef
from .geometry import CLEARANCE_MM, Contact, Geometry, row_column

Composition = Mapping["Well", float]
"""Shares of a liquid by the well each part stood in before the run; they sum to 1."""


class Layer(NamedTuple):
    """Liquid in a tip: well it was drawn from (``None``: air), µL, what it is, source line."""

    source: Well | None
    volume: float
    liquid: Composition
    line: int | None


EMPTY_UL = 1e-6


@dataclass(eq=False, slots=True, repr=False)
class Well:
    """One well of one physical plate, followed through a run.

    Attributes:
        ref: Labware and name.
        generation: Counts the plates that stood for this labware (replaced in a pause).
        order: Row and column, from 0.
        geometry: Its inside; ``None`` if the definition tells nothing.
        capacity: Nominal, µL; ``inf`` if unknown.
        volume: µL that the run knows to be in it.
        known: Whether ``volume`` is exact.
        declared: Volume declared for it before the run, µL.
        contents: µL by the well in which that liquid stood before the run (itself included).
        residue: Whose liquid was drawn off to the last, and by which step first: a tip meets it.
        liquids: Names of liquids loaded into it.
        visits: Everything tips did here, in order.
        received: What came into it from other wells, in order.
        mixes: First and last index of each time it was mixed.
        prefilled: Whether it held liquid before the run.
        fed: Whether the run has put liquid into it.
        most: What it holds at most while that is unknown, µL: a full well less what was taken.
        unsure: µL of ``volume`` that may not be there: air drawn beyond what a source held, or
            what was there before somebody may have changed it by hand.
        runs_through: Whether it is a filter or a column: what is given to it runs on.
        fallen: µL let go so high over it that they may land elsewhere.
        full: What it holds at most by its shape, µL: a brimful of liquid less what was taken.
        assumed: Whether nothing but a draw says that it held liquid before the run.
        supposed: Whether nothing but a variable's name says so.
    """

    ref: WellRef
    generation: int = 0
    capacity: float = math.inf
    geometry: Geometry | None = None
    volume: float = 0.0
    known: bool = True
    declared: float | None = None
    contents: dict[Well, float] = field(default_factory=dict)
    residue: dict[Well, int] = field(default_factory=dict)
    liquids: list[str] = field(default_factory=list)
    visits: list[Visit] = field(default_factory=list)
    received: list[Transfer] = field(default_factory=list)
    mixes: list[tuple[int, int]] = field(default_factory=list)
    prefilled: bool = False
    fed: bool = False
    most: float = math.inf
    unsure: float = 0.0
    fallen: float = 0.0
    runs_through: bool = False
    full: float = field(init=False)
    assumed: bool = False
    supposed: bool = False
    order: tuple[int, int] = field(init=False)
    last: Composition = field(init=False)

    def __post_init__(self) -> None:
        self.most = self.capacity
        self.full = self.brim
        self.order = row_column(self.ref.name)
        self.last = {self: 1.0}

    @property
    def plate(self) -> tuple[str, int]:
        """The physical labware that it is a well of."""
        return self.ref.labware, self.generation

    @property
    def empty(self) -> bool:
        """Whether it surely holds nothing now."""
        return self.known and self.volume <= EMPTY_UL

    @property
    def least(self) -> float:
        """µL that it surely holds."""
        return self.volume - self.unsure

    @property
    def brim(self) -> float:
        """µL that it holds filled to the rim."""
        return self.geometry.brim if self.geometry else self.capacity

    def fill_before_run(self, volume: float | None) -> None:
        """It held liquid of its own before the run, of a declared or an unknown volume."""
        if volume is not None and volume <= 0:
            return
        self.prefilled = True
        if volume is None:
            self.known = False
            # A volume to reckon shares with; no rule compares it.
            held = self.capacity / 2 if math.isfinite(self.capacity) else 1000.0
        else:
            held = volume
            self.declared = (self.declared or 0.0) + volume
            self.volume += volume
        self.contents[self] = self.contents.get(self, 0.0) + held

    def liquid(self) -> Composition:
        """What a tip would draw now."""
        total = sum(self.contents.values())
        if total <= 0:
            return self.last
        return {origin: volume / total for origin, volume in self.contents.items()}

    def draw(self, volume: float) -> float:
        """Take liquid out; returns how much of it the well did not hold (0 if unknown)."""
        self.most = max(self.most - volume, 0.0)
        self.full = max(self.full - volume, 0.0)
        missing = volume - self.volume if self.known and volume > self.volume else 0.0
        least = max(self.least - volume, 0.0)
        self.volume = max(self.volume - volume, 0.0)
        self.unsure = self.volume - least
        if self.known and self.volume <= EMPTY_UL:
            self.volume = 0.0
            self.last = self.liquid()
            self.residue = dict.fromkeys(self.contents, self.visits[-1].index) | self.residue
            self.contents.clear()
        elif len(self.contents) > 1 or self.known:
            total = sum(self.contents.values())
            if total > 0:
                factor = max(total - volume, total * 0.01) / total
                for origin in self.contents:
                    self.contents[origin] *= factor
        return missing

    def add(self, volume: float, liquid: Composition, unsure: float = 0.0) -> None:
        """Put liquid in; ``unsure`` µL of it may be air."""
        if self.runs_through:
            return
        self.volume += volume
        self.most = min(self.most + volume, self.capacity)
        self.full = min(self.full + volume, self.brim)
        self.unsure += unsure
        self.fed = self.fed or volume > 0
        for origin, share in liquid.items() if volume > EMPTY_UL else ():
            self.contents[origin] = self.contents.get(origin, 0.0) + volume * share

    def contact(
        self,
        from_top: float | None,
        from_bottom: float | None,
        from_liquid: float | None = None,
        empty: bool = False,
    ) -> Contact:
        """How surely a tip with its end at this height meets the liquid that stands here now.

        Args:
            from_top: Height of the tip's end over the well's top, mm; ``None`` if unknown.
            from_bottom: The same over its bottom, mm.
            from_liquid: The same over the liquid, mm, where the protocol aims by the meniscus.
            empty: It gives into an empty well: how surely all that it carries comes along.
        """
        if from_top is not None and from_top >= 0:
            return Contact.CLEAR
        geometry = self.geometry
        if empty:
            high = geometry and from_bottom is not None and geometry.is_high(from_bottom)
            return Contact.NEAR if high else Contact.WET
        if from_liquid is not None:
            near = from_liquid < CLEARANCE_MM
            return Contact.WET if from_liquid <= 0 else Contact.NEAR if near else Contact.CLEAR
        if from_bottom is None or geometry is None:
            return Contact.WET
        if geometry.volume_below(from_bottom) <= self.least:
            return Contact.WET
        below = geometry.volume_below(from_bottom - CLEARANCE_MM)
        most = self.volume if self.known else self.most
        if self.volume <= below and (most <= below or geometry.is_high(from_bottom)):
            return Contact.CLEAR
        return Contact.UNSURE if self.supposed and self.least < below else Contact.NEAR


@dataclass(eq=False, slots=True)
class Met:
    """First contact of a tip with one liquid or one well; ``firsts``: its index by degree."""

    well: Well
    line: int | None
    caller: int | None
    index: int
    firsts: dict[Contact, int]

    def contact(self, index: float = math.inf) -> Contact:
        """How surely the tip had met it by this index."""
        return max(degree for degree, first in self.firsts.items() if first <= index)


@dataclass(eq=False, slots=True)
class Tip:
    """One tip from its first pick-up on; a returned tip goes on with the same history.

    Attributes:
        number: Counts the tips of a run.
        session: Counts this tip's pick-ups.
        layers: Liquid and air in it, drawn last stands last.
        origins: Each liquid it has met, with the first contact, in that order.
        touched: Each well it has touched, with the first contact, in that order.
        visits: Everything it did, in order.
        unsure: µL of its liquid that may be air: drawn from a well beyond what that held.
    """

    number: int
    session: int = 0
    layers: list[Layer] = field(default_factory=list)
    origins: dict[Well, Met] = field(default_factory=dict)
    touched: dict[Well, Met] = field(default_factory=dict)
    visits: list[Visit] = field(default_factory=list)
    unsure: float = 0.0

    def touch(self, visit: Visit, contact: Contact = Contact.WET) -> None:
        """The tip's outside met the well: it now carries all that the well holds."""
        well, index = visit.well, visit.index
        held = (*well.contents, *well.residue)
        for known, keys in ((self.touched, (well,)), (self.origins, held)):
            for key in keys:
                if met := known.get(key):
                    met.firsts.setdefault(contact, index)
                else:
                    known[key] = Met(well, visit.line, visit.caller, index, {contact: index})

    def pop(self, volume: float = math.inf) -> list[Layer]:
        """Give off ``volume`` µL, air included; the air is not listed."""
        return [one for one in expel(self.layers, volume) if one.source is not None]


@dataclass(eq=False, slots=True, repr=False)
class Visit:
    """One thing that one tip did at one well.

    Attributes:
        kind: ``aspirate``, ``dispense``, ``blow_out`` or ``touch_tip``.
        tip: The tip.
        session: Which of the tip's sessions this was.
        well: The well.
        index: Position in the run; channels that act together share it.
        line: Source line.
        caller: Of a function of the protocol, the line that called it.
        volume: µL of liquid drawn or given, air left out.
        brought: What was given of other wells' liquid.
        air: µL of what was drawn that a declared volume left no liquid for, and not given back.
        contact: How surely the tip met the well's liquid, and so left there what it carries. In
            a well that was empty: how surely what it gives carries along what the tip met before.
        empty_before: Whether the well held nothing just before; then the tip took nothing along.
        mixing: Whether it is part of a mix.
        carried: How many liquids the tip had met before (a prefix of ``tip.origins``).
        met: How many wells the tip had touched before (a prefix of ``tip.touched``).
        step: The operation that it is a part of.
    """

    kind: OperationKind
    tip: Tip
    well: Well
    index: int
    line: int | None = None
    mixing: bool = False
    caller: int | None = None
    volume: float = 0.0
    contact: Contact = Contact.CLEAR
    brought: list[Transfer] = field(default_factory=list)
    air: float = 0.0
    step: Operation | None = None
    session: int = field(init=False)
    empty_before: bool = field(init=False)
    carried: int = field(init=False)
    met: int = field(init=False)

    def __post_init__(self) -> None:
        self.session = self.tip.session
        self.empty_before = self.well.empty
        self.carried = len(self.tip.origins)
        self.met = len(self.tip.touched)

    @property
    def touches(self) -> bool:
        """Whether the tip met liquid that stood there before, surely or perhaps."""
        return self.contact is not Contact.CLEAR and not self.empty_before


class Transfer(NamedTuple):
    """Liquid that one delivery brought from one well into another.

    Attributes:
        source: Well that it was drawn from.
        well: Well that it came into.
        visit: The delivery.
        volume: µL.
        liquid: What it is.
        drawn: Source line of the draw.
    """

    source: Well
    well: Well
    visit: Visit
    volume: float
    liquid: Composition
    drawn: int | None


class Above(NamedTuple):
    """A draw from above the liquid.

    Attributes:
        visit: The draw.
        height: Of the tip's end over the well's bottom, mm.
        level: Of the liquid, mm.
        held: What the well held, µL.
    """

    visit: Visit
    height: float
    level: float
    held: float
