"""Finds wells by the labware's slot, label or variable, and by well names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from ...adapters.opentrons.instrumentation import LabwareInfo, NameBinding
from ...vocabulary import WellRef
from ..source import tokens
from ..trace import Trace, row_column
from .well_names import plain_name, wells_in

_LEFT_OUT = 2
"""As many wells of those that a name holds may have been left out by mistake."""


class DeckNames:
    """What stands on the deck, under all its names.

    Attributes:
        trace: A reading of the run.
        by_name: Keys of the labware that each variable held.
    """

    def __init__(self, trace: Trace, names: Sequence[NameBinding]) -> None:
        self.trace = trace
        self._used: dict[WellRef, WellRef] = {}
        for well in trace.wells.values():
            self._used.setdefault(well.ref, well.ref)
        self.by_name: dict[str, set[str]] = {}
        for binding in names:
            if binding.labware and not binding.wells:
                for name in {binding.name, binding.name.rpartition(".")[2]}:
                    self.by_name.setdefault(name, set()).update(binding.labware)

    def ref(self, labware: str, name: str) -> WellRef:
        """The reference of a well: as the run first met it, and as it was loaded otherwise."""
        info = self.trace.labware[labware]
        loaded = WellRef(labware, name, info.label or info.display_name, info.slot)
        return self._used.get(loaded, loaded)

    def refs(self, labware: str, names: Iterable[str]) -> tuple[WellRef, ...]:
        """The wells of these names that a labware has."""
        wells = self.trace.labware[labware].wells
        return tuple(self.ref(labware, name) for name in map(plain_name, names) if name in wells)

    def used_wells(self, labware: Iterable[str]) -> tuple[WellRef, ...]:
        """The wells of these labware that the run uses."""
        keys = set(labware)
        return tuple(ref for ref in self._used if ref.labware in keys)

    def is_used(self, ref: WellRef) -> bool:
        """Whether the run uses a well."""
        return ref in self._used

    def meant(self, wells: tuple[WellRef, ...]) -> tuple[WellRef, ...]:
        """The wells of a name, without those of whole columns or rows that are not used this time.

        A few that the run leaves out may be a mistake, and so may all of them.
        """
        left_out: set[WellRef] = set()
        for key in {ref.labware for ref in wells}:
            here = [ref for ref in wells if ref.labware == key]
            unused = [ref for ref in here if not self.is_used(ref)]
            used = len(here) - len(unused)
            if used and len(unused) > max(_LEFT_OUT, used // 3) and self._are_lines(key, here):
                left_out.update(unused)
        return tuple(ref for ref in wells if ref not in left_out)

    def _are_lines(self, labware: str, wells: Sequence[WellRef]) -> bool:
        """Whether these are all wells of some columns, or of some rows, of a labware."""
        names = {ref.name for ref in wells}
        every = self.trace.labware[labware].wells
        for axis in (0, 1):
            lines = {row_column(name)[axis] for name in names}
            if names == {name for name in every if row_column(name)[axis] in lines}:
                return True
        return False

    def plates(self) -> list[LabwareInfo]:
        """Labware that holds liquid."""
        return [info for info in self.trace.labware.values() if info.holds_liquid]

    def called(self, words: str) -> list[str]:
        """Keys of labware by slot (``"4"``, ``"slot 4"``), label, load name or variable."""
        wanted = tokens(without_slot(words))
        found = [
            info.key
            for info in self.plates()
            if wanted and wanted in map(tokens, (info.slot, info.label, info.key, info.load_name))
        ]
        return found or sorted(self.by_name.get(words.strip(), ()))

    def at(self, place: str) -> tuple[WellRef, ...]:
        """The wells of a place: ``"4:H12"``, ``"PCR plate:A1-A8"``, ``"plate:*"``."""
        labware, spec, _ = parts_of_place(place)
        return tuple(
            self.ref(key, name)
            for key in self.called(labware)
            for name in wells_in(spec, self.trace.labware[key].wells)
        )


def without_slot(words: str) -> str:
    """``"4"`` for ``"slot 4"``; a label that only begins so stays as it is."""
    return re.sub(r"^\s*slot\s+(\w{1,2})\s*$", r"\1", words, flags=re.IGNORECASE)


def parts_of_place(place: str) -> tuple[str, str, str]:
    """Labware, wells and level of a place; the level is ``""`` where none is given.

    >>> parts_of_place("standards:A1 = 2 mg/mL")
    ('standards', 'A1', '2 mg/mL')
    """
    wells, _, level = place.partition("=")
    labware, _, spec = wells.rpartition(":")
    return labware, spec.strip(), level.strip()
