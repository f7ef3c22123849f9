"""Plate maps in code: ``{"H12": "NTC"}``, ``NTC_WELLS = ["H11", "H12"]``, rows of a CSV file.

They count for the labware that the run indexes with them. A map of sources that names "NTC"
says nothing of the wells that it is zipped with.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...adapters.opentrons.instrumentation import NameBinding, PlateMapRow, is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..source import Index, SourceFacts, level_in, lexicon_of
from .deck import DeckNames
from .evidence import Evidence, Kind
from .names import NUMBERED, base_of, levels_of_keys, line_of


def plate_maps(
    deck: DeckNames, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Evidence]:
    """What maps and lists of well names, and rows beside wells, say of these wells."""
    keyed = levels_of_keys(names)
    by_map: dict[str, list[Evidence]] = {}
    for binding in names:
        if not (binding.spots or binding.rows):
            continue
        base = base_of(binding)
        if (binding.function, base) in facts.varying or binding.name == "metadata":
            continue
        line = line_of(binding, facts)
        uses = facts.flow.indexed_with.get(base.rpartition(".")[2], [])
        found = by_map.setdefault(base, [])
        if binding.spots and uses:
            wells = _indexed(deck, facts, uses, binding.spots)
            level = keyed.get(binding.name)
            # A running number tells none of its wells from the others.
            counted = level is None and NUMBERED.fullmatch(binding.name) is not None
            citation = f"plate map `{binding.name}` at line {line}"
            levels = () if level is None else (level,) * len(wells)
            found.append(
                Evidence(Kind.NAME, binding.name, wells, citation, whole=counted, levels=levels)
            )
        for row in binding.rows:
            wells = row.wells or _wells_of_row(deck, facts, row, uses)
            found += _of_row(binding.name, row, wells, line, common)
    for found in by_map.values():
        # A map of 96 places of which few are used may serve another run.
        spoken_of = {ref for one in found for ref in one.wells}
        if 2 * sum(map(deck.is_used, spoken_of)) >= len(spoken_of):
            yield from found


def _indexed(
    deck: DeckNames, facts: SourceFacts, uses: Iterable[Index], spots: Sequence[str]
) -> tuple[WellRef, ...]:
    """The wells of these names in the labware that the run indexes there. Where several labware
    are indexed with them, those in which all are used: ``("D6", "H12")`` may be a tube and a well.
    """
    keys: set[str] = set()
    for use in uses:
        for origin in (use.indexed, *facts.flow.comes_from.get(use.indexed, ())):
            keys |= deck.by_name.get(origin, set())
    in_each = [deck.refs(key, spots) for key in deck.trace.labware if key in keys]
    if len(in_each) > 1:
        whole = [wells for wells in in_each if len(wells) == len(spots)]
        in_each = [wells for wells in whole if all(map(deck.is_used, wells))]
    return tuple(ref for wells in in_each for ref in wells)


def _wells_of_row(
    deck: DeckNames, facts: SourceFacts, row: PlateMapRow, uses: Sequence[Index]
) -> tuple[WellRef, ...]:
    """The wells that a row names. Where it names a tube and a well, each column's own labware."""
    found: list[WellRef] = []
    for column, cell in row.cells:
        if not (isinstance(cell, str) and is_spot(cell)):
            continue
        asked = [use for use in uses if column and column in use.fields]
        if len(row.spots) > 1 and not asked:
            return ()
        found += _indexed(deck, facts, asked or uses, (cell,))
    return tuple(found)


def _of_row(
    name: str, row: PlateMapRow, wells: tuple[WellRef, ...], line: int, common: Common
) -> Iterator[Evidence]:
    amounts = lexicon_of({"amount": common.amounts})
    of_amounts = bool(amounts.find(name))
    texts = [said for _, said in row.said if isinstance(said, str)]
    numbers = [
        float(said)
        for column, said in row.said
        if not isinstance(said, str) and (of_amounts or amounts.find(column))
    ]
    level = numbers[0] if len(numbers) == 1 else None
    for text in texts or ([name] if level is not None else []):
        own = level if level is not None else level_in(text, common.levels)
        levels = () if own is None else (own,) * len(wells)
        citation = f"'{text}' beside it in `{name}` at line {line}"
        yield Evidence(Kind.NAME, text, wells, citation, levels=levels)
