"""Comments beside the items of a list of wells: ``rack["A2"],  # vehicle``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...instrumentation import NameBinding, is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts
from .clues import Clue, Strength, shortened
from .deck import Deck
from .plate_maps import labware_of_map, refs_of


def item_notes(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """What the comment beside each item of a list says of the wells of that item."""
    held = {binding.name: [(ref,) for ref in binding.wells] for binding in names}
    for name, notes in facts.item_notes.items():
        wells = held.get(name) or _listed(deck, facts, name, common)
        if len(wells) != len(notes):
            continue
        first = facts.assigned.get(name)
        for note, refs in zip(notes, wells, strict=True):
            yield Clue(
                Strength.COMMENT,
                note,
                refs,
                first,
                f"comment '{shortened(note)}' in `{name}` at line {first}",
                subject=False,
            )


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
