"""Amounts beside wells: two lists written one below the other, a dict that the run makes, or a list
with a comment on where its amounts stand.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from ...instrumentation import NameBinding, is_spot
from ..layouts import Deck, LabwareNouns, labware_of_map, refs_of, well_names, wells_between
from ..rules import Common
from ..text import SourceFacts
from .clues import Clue, Strength
from .levels import (
    are_amounts,
    as_one_of_amounts,
    far_apart,
    is_number,
    names_amounts,
    names_counts,
)

_VOLUMES = re.compile(r"(?<![/\w])(?<!per )[uµμm]l\b", re.IGNORECASE)
_FEWEST = 3
_NEAR = 2
"""Lists that belong together stand so many lines apart at most."""


class _Pair(NamedTuple):
    name: str
    spots: tuple[str, ...]
    amounts: tuple[float, ...]
    line: int | None
    note: str = ""


def amounts_beside(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """Levels of ``TUBES = ["A1", "B1", "C1"]`` above ``UG_PER_ML = [1500, 500, 0]``, of
    ``dict(zip(TUBES, UG_PER_ML))``, or of a list below "ug/mL in tubes A1-A6".
    """
    written = _written(facts, common), _made(names, facts, common), _noted(facts, common)
    for pair in chain.from_iterable(written):
        labware = _called(deck, pair.note, common)
        labware = labware or labware_of_map(deck, facts, pair.name, pair.spots, common)
        wells = tuple(refs_of(deck, labware, pair.spots))
        if len(wells) != len(pair.spots):
            continue
        said = f"numbers beside `{pair.name}` at line {pair.line}"
        yield Clue(Strength.NAME, "", wells, pair.line, said, levels=pair.amounts)
        drawn = not any((ref.labware, ref.name) in deck.received for ref in wells)
        if drawn and far_apart(pair.amounts):
            yield as_one_of_amounts(wells, pair.line, said, pair.amounts)


def _called(deck: Deck, note: str, common: Common) -> tuple[str, ...]:
    """The labware that a comment speaks of, if there is one."""
    nouns = LabwareNouns(deck, common) if note else None
    return tuple(nouns.named(note) or nouns.kind_in(note)) if nouns else ()


def _written(facts: SourceFacts, common: Common) -> Iterator[_Pair]:
    amounts = {
        name: tuple(map(float, value))
        for name, value in facts.constants.items()
        if isinstance(value, (list, tuple)) and all(map(is_number, value))
    }
    for name, value in facts.constants.items():
        line = facts.assigned.get(name)
        if not isinstance(value, (list, tuple)) or len(value) < _FEWEST or line is None:
            continue
        if not all(map(is_spot, value)):
            continue
        beside = [
            numbers
            for other, numbers in amounts.items()
            if len(numbers) == len(value)
            and names_amounts(other, common)
            and abs(facts.assigned.get(other, -_NEAR - 1) - line) <= _NEAR
            and are_amounts(numbers)
        ]
        if len(beside) == 1 and len(set(beside[0])) == len(value):
            yield _Pair(name, tuple(value), beside[0], line)


def _made(names: Sequence[NameBinding], facts: SourceFacts, common: Common) -> Iterator[_Pair]:
    dicts = {
        name: tuple((key, float(number)) for key, number in value.items())
        for name, value in facts.constants.items()
        if isinstance(value, dict) and all(map(is_number, value.values()))
        if names_amounts(name, common)
    }
    made = {b.name: b.numbers for b in names if b.numbers and b.name not in facts.constants}
    for name, items in {**made, **dicts}.items():
        spots, numbers = tuple(key for key, _ in items), tuple(number for _, number in items)
        if len(spots) >= _FEWEST and all(map(is_spot, spots)) and are_amounts(numbers):
            yield _Pair(name, spots, numbers, facts.assigned.get(name))


def _noted(facts: SourceFacts, common: Common) -> Iterator[_Pair]:
    for name, value in facts.constants.items():
        above = facts.comments.get(facts.assigned.get(name, 0) - 1, "")
        note = facts.notes.get(name, above)
        if not isinstance(value, (list, tuple)) or len(value) < _FEWEST:
            continue
        said = list(well_names(common).spec.finditer(note))
        if len(said) != 1 or not said[0]["last"] or not all(map(is_number, value)):
            continue
        spots = wells_between(f"{said[0]['first']}:{said[0]['last']}")
        numbers = tuple(map(float, value))
        of_amounts = names_amounts(name, common) or names_amounts(note, common)
        if _VOLUMES.search(note) or names_counts(name, common):
            continue  # "uL of standard in A1-A6"
        if len(spots) == len(numbers) == len(set(numbers)) and of_amounts and are_amounts(numbers):
            yield _Pair(name, spots, numbers, facts.assigned.get(name), note)
