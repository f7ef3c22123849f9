"""Tips and their histories: which tip is on which nozzle, and what it has met so far."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...vocabulary import WellRef
from .wells import Composition, Well

Layer = tuple[Well | None, float, Composition, int | None]
"""Liquid in a tip: well it was drawn from (``None``: air), µL, what it is, source line."""


class Met:
    """First contact of a tip with one liquid or one well.

    ``sure``: whether the tip met it surely, and not only as far as anyone knows.
    """

    __slots__ = ("index", "line", "sure", "well")

    def __init__(self, well: Well, line: int | None, index: int, sure: bool) -> None:
        self.well = well
        self.line = line
        self.index = index
        self.sure = sure


class Tip:
    """One tip from its first pick-up on; a returned tip goes on with the same history.

    Attributes:
        number: Counts the tips of a run.
        home: Tip rack well it came from, if known.
        picked_up: Line of the latest pick-up.
        session: Counts this tip's pick-ups.
        layers: Liquid and air in it, drawn last stands last.
        origins: Each liquid it has met, with the first contact, in that order.
        touched: Each well it has touched, with the first contact, in that order.
        unsure: µL of its liquid that may be air: drawn from a well beyond what that held.
    """

    __slots__ = ("home", "layers", "number", "origins", "picked_up", "session", "touched", "unsure")

    def __init__(self, number: int, home: WellRef | None, line: int | None) -> None:
        self.number = number
        self.home = home
        self.picked_up = line
        self.session = 0
        self.unsure = 0.0
        self.layers: list[Layer] = []
        self.origins: dict[Well, Met] = {}
        self.touched: dict[Well, Met] = {}

    def touch(self, well: Well, line: int | None, index: int, sure: bool = True) -> None:
        """The tip's outside met ``well``: it now carries all that the well holds."""
        met = self.touched.get(well)
        if met is None:
            met = self.touched[well] = Met(well, line, index, sure)
        elif (
            met.sure >= sure
            and len(well.contents) <= 1
            and next(iter(well.contents), None) in self.origins
        ):
            return
        met.sure |= sure
        for origin in well.contents:
            known = self.origins.get(origin)
            if known is None:
                self.origins[origin] = Met(well, line, index, sure)
            elif known.well is well:
                known.sure |= sure

    def push(
        self, source: Well | None, volume: float, liquid: Composition, line: int | None
    ) -> None:
        """Draw liquid (or air, without a source)."""
        self.layers.append((source, volume, liquid, line))

    def pop(self, volume: float) -> list[Layer]:
        """Give off ``volume`` µL: what was drawn last leaves first; air is given off unlisted.

        The volume that a protocol commands includes the air it drew.
        """
        given: list[Layer] = []
        layers = self.layers
        while layers and volume > 1e-6:
            source, held, liquid, line = layers.pop()
            out = held if held <= volume + 1e-6 else volume
            if held - out > 1e-6:
                layers.append((source, held - out, liquid, line))
            if source is not None:
                given.append((source, out, liquid, line))
            volume -= out
        return given

    def pop_all(self) -> list[Layer]:
        """Blow out: everything leaves."""
        given = [layer for layer in reversed(self.layers) if layer[0] is not None]
        self.layers.clear()
        return given


class TipBox:
    """Knows every tip of a run by the rack well in which it stands or stood."""

    def __init__(self) -> None:
        self._returned: dict[WellRef, Tip] = {}
        self._on: dict[tuple[str, str], Tip] = {}
        self._taken: set[WellRef] = set()
        self._seen: set[str] = set()
        self.tips: list[Tip] = []

    def pick_up(
        self,
        pipette: str,
        nozzles: Iterable[str],
        racks: Iterable[WellRef | None],
        line: int | None,
    ) -> None:
        """Put a tip on each nozzle: the returned one if one stands there, else a new one.

        Nozzles beside the rack, or over places whose tips are gone, stay bare: that is how a
        multi-channel pipette is used with one tip.
        """
        racks = list(racks)
        self._seen.add(pipette)
        lead = next((home for home in racks if home is not None), None)
        for nozzle, home in zip(nozzles, racks, strict=False):
            tip = self._returned.pop(home, None) if home is not None else None
            bare = lead is not None and (home is None or (home in self._taken and home != lead))
            if tip is None and bare:
                self._on.pop((pipette, nozzle), None)
                continue
            if home is not None:
                self._taken.add(home)
            if tip is None:
                tip = self._new(home, line)
            tip.picked_up = line
            tip.session += 1
            self._on[(pipette, nozzle)] = tip

    def drop(self, pipette: str, nozzles: Iterable[str], racks: Iterable[WellRef | None]) -> None:
        """Take the tips off; those put back into a rack keep their history there."""
        for nozzle, home in zip(nozzles, racks, strict=False):
            tip = self._on.pop((pipette, nozzle), None)
            if tip is not None and home is not None:
                self._returned[home] = tip  # with what is in it: tips are parked full, too
                self._taken.discard(home)
        for key in [key for key in self._on if key[0] == pipette]:
            del self._on[key]

    def on(self, pipette: str, nozzle: str, line: int | None) -> Tip | None:
        """The tip on a nozzle, ``None`` on a bare one.

        One that nobody saw being picked up counts as new.
        """
        tip = self._on.get((pipette, nozzle))
        if tip is None and pipette not in self._seen:
            tip = self._on[(pipette, nozzle)] = self._new(None, line)
        return tip

    def replace_rack(self, labware: str) -> None:
        """Someone put a fresh rack in this one's place."""
        for home in [home for home in self._returned if home.labware == labware]:
            del self._returned[home]
        self.refill_rack(labware)

    def refill_rack(self, labware: str) -> None:
        """The empty places of a rack hold new tips; returned ones stay what they are."""
        self._taken = {home for home in self._taken if home.labware != labware}

    def replace_all_racks(self) -> None:
        """Someone put fresh racks everywhere."""
        self._returned.clear()
        self._taken.clear()

    def _new(self, home: WellRef | None, line: int | None) -> Tip:
        tip = Tip(len(self.tips), home, line)
        self.tips.append(tip)
        return tip


def volumes(layers: Iterable[Layer]) -> Mapping[Well, float]:
    """µL per well drawn from, air left out."""
    total: dict[Well, float] = {}
    for source, volume, _, _ in layers:
        if source is not None:
            total[source] = total.get(source, 0.0) + volume
    return total
