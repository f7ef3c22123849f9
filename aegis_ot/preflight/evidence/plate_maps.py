"""Plate maps in code: ``{"H12": "NTC"}``, ``NTC_WELLS = ["H11", "H12"]``, rows of a CSV file.

They count for the labware that the run indexes with them. A map of sources that names "NTC"
says nothing of the wells that it is zipped with.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...instrumentation import NameBinding, Row, is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..source import Index, SourceFacts, level_in, lexicon_of
from .deck import Deck
from .evidence import Evidence, Kind
from .names import NUMBERED, levels_of_keys


def plate_maps(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Evidence]:
    """What maps and lists of well names, and rows beside wells, say of these wells."""
    amounts = lexicon_of({"amount": common.amounts})
    keyed = levels_of_keys(names)
    for binding in names:
        base = binding.name.split("[", 1)[0]
        if (binding.function, base) in facts.varying or binding.name == "metadata":
            continue
        line = facts.assigned.get(base.rpartition(".")[2], binding.line)
        uses = facts.flow.indexed_with(base.rpartition(".")[2])
        if binding.spots and uses:
            wells = _wells_of_list(deck, _labware(deck, facts, uses), binding.spots)
            if _are_plausible(deck, wells):
                citation = f"plate map `{binding.name}` at line {line}"
                level = keyed.get(binding.name)
                levels = () if level is None else (level,) * len(wells)
                # A running number tells none of its wells from the others.
                counted = level is None and NUMBERED.fullmatch(binding.name) is not None
                yield Evidence(
                    Kind.NAME, binding.name, wells, citation, line, whole=counted, levels=levels
                )
        for row in binding.rows:
            wells = row.wells or _wells_of_row(deck, facts, row, uses)
            if wells and _are_plausible(deck, wells):
                of_amounts = bool(amounts.find(binding.name))
                yield from _of_row(binding.name, row, wells, line, common, of_amounts)


def _labware(deck: Deck, facts: SourceFacts, uses: Iterable[Index]) -> tuple[str, ...]:
    """Keys of the labware that the run indexes there."""
    found: set[str] = set()
    for use in uses:
        for origin in (use.held, *facts.flow.comes_from.get(use.held, ())):
            found |= deck.by_name.get(origin, set())
    return tuple(key for key in deck.trace.labware if key in found)


def _wells_of_list(deck: Deck, labware: Sequence[str], spots: Sequence[str]) -> tuple[WellRef, ...]:
    """The wells of a list of names. Where several labware are indexed with them, those in which
    all are used: ``("D6", "H12")`` may be a tube and a well.
    """
    in_each = [deck.refs((key,), spots) for key in labware]
    if len(in_each) > 1:
        whole = [wells for wells in in_each if len(wells) == len(spots)]
        in_each = [wells for wells in whole if all(map(deck.is_used, wells))]
    return tuple(ref for wells in in_each for ref in wells)


def _wells_of_row(
    deck: Deck, facts: SourceFacts, row: Row, uses: Sequence[Index]
) -> tuple[WellRef, ...]:
    """The wells that a row names. Where it names a tube and a well, each column's own labware."""
    found: list[WellRef] = []
    for column, cell in row.cells:
        if not (isinstance(cell, str) and is_spot(cell)):
            continue
        asked = [use for use in uses if column and column in use.fields]
        if len(row.spots) > 1 and not asked:
            return ()
        found += deck.refs(_labware(deck, facts, asked or uses), (cell,))
    return tuple(found)


def _are_plausible(deck: Deck, wells: Sequence[WellRef]) -> bool:
    """Whether the run uses most of these wells: a map of 96 places may serve another run."""
    return 2 * sum(map(deck.is_used, wells)) >= len(wells)


def _of_row(
    name: str,
    row: Row,
    wells: tuple[WellRef, ...],
    line: int,
    common: Common,
    of_amounts: bool,
) -> Iterator[Evidence]:
    amounts = lexicon_of({"amount": common.amounts})
    texts = [said for _, said in row.said if isinstance(said, str)]
    numbers = [
        float(said)
        for column, said in row.said
        if not isinstance(said, str) and (of_amounts or amounts.find(column))
    ]
    level = numbers[0] if len(numbers) == 1 else None
    for text in texts or ([name] if level is not None else []):
        own = level if level is not None else level_in(text, common.levels)
        yield Evidence(
            Kind.NAME,
            text,
            wells,
            f"'{text}' beside it in `{name}` at line {line}",
            line,
            levels=() if own is None else (own,) * len(wells),
        )
