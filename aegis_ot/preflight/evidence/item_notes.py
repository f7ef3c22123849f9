"""Comments beside the items of a list or a dict of wells: ``rack["A2"],  # vehicle``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ...instrumentation import NameBinding, is_spot
from ...vocabulary import WellRef
from ..layouts import Deck, is_work_list, labware_of_map, refs_of, used_with, well_names
from ..rules import Common
from ..text import SourceFacts, tokens, words_of
from .clues import Clue, Strength, shortened
from .names import of_all


def item_notes(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """What the comment beside each item of a list or a dict says of the wells of that item."""
    held = {binding.name: [(ref,) for ref in binding.wells] for binding in names}
    yield from _of_dicts(deck, names, facts, common)
    yield from _of_lists(deck, facts, common)
    for name, notes in facts.item_notes.items():
        wells = held.get(name) or _listed(deck, facts, name, common)
        if len(wells) != len(notes):
            continue
        first = facts.assigned.get(name)
        for note, refs in zip(notes, wells, strict=True):
            yield _noted(note, refs, name, first)


def _noted(note: str, wells: tuple[WellRef, ...], name: str, line: int | None) -> Clue:
    said = f"comment '{shortened(note)}' in `{name}` at line {line}"
    return Clue(Strength.COMMENT, note, wells, line, said, subject=False)


def _of_dicts(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """What the comment beside each line of a dict says of the wells that stand in it."""
    bound = {binding.name.replace("'", '"'): binding.wells for binding in names}
    for name, notes in facts.key_notes.items():
        value = facts.constants.get(name)
        from_to = isinstance(value, Mapping) and all(map(is_spot, value))
        if from_to or is_work_list(deck, value):
            continue  # which of the two wells of a line it speaks of is not said
        spots = {
            key: (item,) if isinstance(item, str) else tuple(item)
            for key, item in (value.items() if isinstance(value, Mapping) else ())
            if isinstance(item, (str, list, tuple))
        }
        listed = [spot for item in spots.values() for spot in item]
        written = bool(listed) and all(map(is_spot, listed))
        labware = labware_of_map(deck, facts, name, listed, common) if written else ()
        spots = spots if written else {}
        for note, keys in notes.items():
            wells = [ref for key in keys for ref in bound.get(f'{name}["{key}"]', ())]
            wells = wells or [
                ref for key in keys for ref in refs_of(deck, labware, spots.get(key, ()))
            ]
            if wells and _is_of_one_thing(note, common):
                yield _noted(note, tuple(wells), name, facts.assigned.get(name))


def _is_of_one_thing(note: str, common: Common) -> bool:
    """Whether a comment says what something is, and not what it is held against: "vs DMSO"."""
    comparing = not words_of(common.comparing).isdisjoint(tokens(note))
    return not comparing and not well_names(common).spec.search(note)


def _of_lists(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What the comment beside a name says of the wells that are listed there: ``["A1", "B1"]``.

    Only of those that the run uses with one labware.
    """
    for name, note in facts.notes.items():
        value = facts.constants.get(name)
        spots = value if isinstance(value, (list, tuple)) else (value,)
        if not all(map(is_spot, spots)) or len(used_with(deck, facts, name)) != 1:
            continue
        wells = tuple(refs_of(deck, labware_of_map(deck, facts, name, spots, common), spots))
        if wells and of_all(note, wells, common):
            yield replace(_noted(note, wells, name, facts.assigned.get(name)), lone=len(wells) > 1)


def _listed(deck: Deck, facts: SourceFacts, name: str, common: Common) -> list[tuple[WellRef, ...]]:
    """The wells of each item of a list of well names, or of lists of these."""
    value = facts.constants.get(name)
    items = [
        (item,) if isinstance(item, str) else tuple(item)
        for item in (value if isinstance(value, (list, tuple)) else ())
        if isinstance(item, (str, list, tuple))
    ]
    spots = [spot for item in items for spot in item]
    if not spots or not all(map(is_spot, spots)):
        return []
    labware = labware_of_map(deck, facts, name, spots, common)
    return [tuple(refs_of(deck, labware, item)) for item in items]
