"""Finds wells by the labware's name, label or slot and by well names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence, Set
from functools import cached_property

from ...instrumentation import LabwareInfo, NameBinding
from ...vocabulary import WellRef
from ..text import SourceFacts, tokens
from ..trace import Trace, row_column

_ITEM = re.compile(r"(\w+)\[([^\[\]]+)\]")

MOST_TUBES = 24
"""Labware of no more wells is a rack of tubes, in which various things stand."""

LEFT_OUT = 2
"""As many wells of those that a layout names may have been left out by mistake."""

_OTHERS = 2
"""In so many other columns or rows the run fills what it leaves out in one."""


class Deck:
    """Finds wells by the labware's name, label or slot and by well names.

    Attributes:
        described: What texts call labware, with its key: the "dose plate" in slot 3.
    """

    def __init__(self, trace: Trace, names: Sequence[NameBinding], facts: SourceFacts) -> None:
        self.trace = trace
        self.refs: dict[tuple[str, str], WellRef] = {}
        for well in trace.wells.values():
            self.refs.setdefault((well.ref.labware, well.ref.name), well.ref)
        self.by_name: dict[str, set[str]] = {}
        self.of_wells: dict[str, set[str]] = {}
        for binding in names:
            if binding.labware and not binding.wells:
                self.by_name.setdefault(binding.name, set()).update(binding.labware)
            for ref in binding.wells:
                self.of_wells.setdefault(binding.name, set()).add(ref.labware)
        for name in [name for name in self.by_name if "." in name]:
            self.by_name.setdefault(name.rpartition(".")[2], set()).update(self.by_name[name])
        self.lists: dict[str, set[str]] = {}
        for name, keys in self.by_name.items():
            self.lists.setdefault(name.split("[", 1)[0], set()).update(keys)
        self.in_turn = self._taken_in_turn(facts)
        self.keyed = self._by_key()
        self.by_label: dict[str, set[str]] = {}
        for info in self.plates():
            if info.label:
                self.by_label.setdefault(info.label, set()).add(info.key)
        self.described: list[tuple[str, str]] = []
        self.received = {
            (well.ref.labware, well.ref.name)
            for well in trace.wells.values()
            if any(True for _ in trace.deliveries(well))
        }
        self.filled = frozenset(key for key, _ in self.received)

    @cached_property
    def served(self) -> Mapping[WellRef, set[WellRef]]:
        """For each well that is drawn from, those that its liquid came into."""
        return self.trace.served()

    def _by_key(self) -> dict[str, dict[str, str]]:
        """For each dict of several labware: its keys, as text, with what each holds."""
        found: dict[str, dict[str, str]] = {}
        for name, keys in self.by_name.items():
            match = _ITEM.fullmatch(name)
            if match and len(keys) == 1:
                found.setdefault(match[1], {})[match[2].strip("'\"")] = next(iter(keys))
        return {name: held for name, held in found.items() if len(held) > 1}

    def _taken_in_turn(self, facts: SourceFacts) -> set[str]:
        """Loop variables over several plates: each was all of them, not the last one only."""
        lists = self.lists
        found: set[str] = set()
        for _, name in facts.loops:
            if name in facts.assigned:
                continue  # it is something else as well, at another time
            for source, _, _ in facts.comes_from.get(name, ()):
                if name in self.by_name and len(lists.get(source, ())) > 1:
                    self.by_name[name].update(lists[source])
                    found.add(name)
        return found

    def ref(self, labware: str, name: str) -> WellRef:
        """The reference of a well, made up where the run never used it."""
        known = self.refs.get((labware, name))
        if known is not None:
            return known
        info = self.trace.labware[labware]
        return WellRef(labware, name, info.label or info.display_name, info.slot)

    def used_wells(self, labware: Sequence[str]) -> tuple[WellRef, ...]:
        """The wells of these labware that the run uses."""
        return tuple(ref for (key, _), ref in self.refs.items() if key in labware)

    def where_filled(self, labware: str, names: Sequence[str], axis: int) -> Sequence[str]:
        """Those of some columns' wells that stand in rows which the run fills, if it fills any.

        Cells may be loaded in rows of the edge for which there is nothing.

        Args:
            labware: Key of the labware.
            names: Wells of some of its columns, or of some of its rows.
            axis: 1 for columns, 0 for rows.
        """
        across = {row_column(name)[1 - axis] for key, name in self.received if key == labware}
        kept = [name for name in names if row_column(name)[1 - axis] in across]
        few = len(names) - len(kept) <= min(LEFT_OUT, len(names) // 3)  # left out by mistake
        return names if few or not kept else kept

    def passed_over(self, labware: str, names: Collection[str], axis: int) -> list[str]:
        """Wells that the run does not fill, though it fills these places in all other columns.

        A few of these ``names`` at most, one of two columns, one between others, or the only one
        of the plate: of more, the layout speaks of wells for which there is nothing this time.
        Those that the other columns leave out as well are no part of it.

        Args:
            labware: Key of the labware.
            names: All wells of some of its columns, or of some of its rows.
            axis: 1 for columns, 0 for rows.
        """
        filled = {row_column(name) for key, name in self.received if key == labware}
        others = {at[axis] for at in filled} - {row_column(name)[axis] for name in names}
        empty = [name for name in names if (labware, name) not in self.received]
        missing = [
            name
            for name in empty
            if filled.issuperset(
                _place(axis, other, row_column(name)[1 - axis]) for other in others
            )
        ]
        few = len(missing) <= min(LEFT_OUT, (len(names) - len(empty)) // 3)
        lines, gap = ({row_column(name)[axis] for name in some} for some in (names, missing))
        # One of two columns, whole: the other one got what both were to get.
        one_of_two = len(lines) == 2 and len(missing) == len(empty) == len(names) // 2
        whole = one_of_two and len(gap) == 1
        # One between those that are filled: the next one got what it was to get.
        between = (
            missing == list(names)
            and len(lines) == 1
            and any(line - 1 in others and line + 1 in others for line in lines)
        )
        # All else of the plate is filled: a loop ended too early.
        every = map(row_column, self.trace.labware[labware].wells)
        ended = len(gap) == 1 and filled == {at for at in every if at[axis] not in gap}
        return missing if (few or whole or between or ended) and len(others) > 1 else []

    def are_left_out(self, labware: str, missing: Sequence[str], used: Sequence[str]) -> bool:
        """Whether a few of a range's wells may have been left out by mistake: one of three, or
        less than half of them where the run fills these places of two more columns or rows, or so
        few in each column or row of it.
        """
        if not missing:
            return False
        filled = {row_column(name) for key, name in self.received if key == labware}
        places = [row_column(name) for name in missing]
        beside = [len(_lines_filled_alike(filled, places, axis)) for axis in (0, 1)]
        if len(missing) > min(LEFT_OUT, len(used) - 1):
            return any(beside[at] >= _OTHERS and _are_few(missing, used, at) for at in (0, 1))
        return max(beside) >= _OTHERS or len(missing) <= len(used) // 3

    def are_whole_lines(self, wells: Collection[WellRef]) -> bool:
        """Whether these are all wells of some columns, or of some rows, of one labware."""
        keys = {ref.labware for ref in wells}
        if len(keys) != 1:
            return False
        names = {ref.name for ref in wells}
        every = self.trace.labware[next(iter(keys))].wells
        return any(
            names == {name for name in every if row_column(name)[axis] in lines}
            for axis in (0, 1)
            for lines in [{row_column(name)[axis] for name in names}]
        )

    def are_alike(self, keys: Collection[str]) -> bool:
        """Whether these labware are all of one kind."""
        return len({self.trace.labware[key].load_name for key in keys}) == 1

    def used_at(self, line: int) -> set[WellRef]:
        """The wells that the statement at a line uses, itself or through what it calls."""
        return {visit.well.ref for visit in self.trace.visits if line in visit.lines}

    def plates(self) -> list[LabwareInfo]:
        """Labware that holds liquid."""
        return [
            info
            for info in self.trace.labware.values()
            if not info.is_tip_rack and not info.is_trash and info.wells
        ]

    def labware_called(self, words: str) -> list[str]:
        """Keys of labware by slot, label or the name of a variable."""
        wanted = tokens(words)
        found = []
        for info in self.plates():
            if wanted and (
                wanted == tokens(info.slot)
                or wanted == tokens(info.label)
                or wanted == tokens(info.key)
                or wanted == tokens(info.load_name)
            ):
                found.append(info.key)
        return found or sorted(self.by_name.get(words, ()))

    def most_likely(self, names: Iterable[str]) -> str:
        """The one labware in which all these wells were used, or ``""``."""
        names = list(names)
        used = [
            info.key
            for info in self.plates()
            if all(name in info.wells for name in names)
            and any((info.key, name) in self.refs for name in names)
        ]
        full = [key for key in used if all((key, name) in self.refs for name in names)] or used
        if len(full) > 1:
            full = [
                key for key in full if any((key, name) in self.received for name in names)
            ] or full
        return full[0] if len(full) == 1 else ""


def _lines_filled_alike(
    filled: Set[tuple[int, int]], places: Sequence[tuple[int, int]], axis: int
) -> set[int]:
    """The other columns (``axis`` 1) or rows (0) in which the same places are filled."""
    own = {place[axis] for place in places}
    return {
        line
        for line in {at[axis] for at in filled} - own
        if all(_place(axis, line, place[1 - axis]) in filled for place in places)
    }


def _are_few(missing: Collection[str], used: Collection[str], axis: int) -> bool:
    """Whether each column (``axis`` 1) or row (0) lacks a few wells at most, one of four: a helper
    that is called for two columns may leave out the same rows in both.
    """
    lacking, having = (Counter(row_column(name)[axis] for name in some) for some in (missing, used))
    return all(count <= min(LEFT_OUT, having[at] // 3) for at, count in lacking.items())


def _place(axis: int, along: int, across: int) -> tuple[int, int]:
    """Row and column of a place in a column (axis 1) or in a row (axis 0)."""
    return (across, along) if axis == 1 else (along, across)
