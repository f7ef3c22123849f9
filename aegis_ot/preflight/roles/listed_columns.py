"""Lists with one entry for each column or row of a plate: ``COLUMNS = "U V d1 d2 ...".split()``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ...instrumentation import LabwareInfo, is_spot
from ..rules import Common
from ..text import SourceFacts, lexicon_of
from ..trace import row_column
from .clues import Clue, Strength
from .deck import Deck
from .labware_nouns import LabwareNouns
from .map_labware import used_with

_LONGEST = 24
"""Letters of an entry; more are a sentence."""


def listed_columns(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What such a list says of each column or row, where its name or its comment says which."""
    nouns = LabwareNouns(deck, common)
    for name, value in facts.constants.items():
        entries = _entries(value)
        axis = _axis(f"{name} {facts.notes.get(name, '')}", common) if entries else None
        if axis is None:
            continue
        note = facts.notes.get(name, "")
        said = nouns.named(note) or nouns.of_kinds_in(note)
        indexed = said or used_with(deck, facts, name)
        plates = [
            info
            for info in deck.plates()
            if len(_lines(info, axis)) == len(entries) and (said or not info.centers_channels)
        ]
        meant = [info for info in plates if info.key in indexed]
        if not meant and not said:
            meant = [info for info in plates if info.key in deck.filled]
        if len(meant) != 1:
            continue
        line = facts.assigned.get(name)
        for entry in dict.fromkeys(entries):
            places = {at for at, other in enumerate(entries) if other == entry}
            named = [spot for spot in meant[0].wells if row_column(spot)[axis] in places]
            used = [spot for spot in named if (meant[0].key, spot) in deck.refs]
            used += deck.passed_over(meant[0].key, named, axis)
            if wells := tuple(deck.ref(meant[0].key, spot) for spot in dict.fromkeys(used)):
                evidence = f"plate map `{name}` at line {line}"
                yield Clue(Strength.NAME, entry, wells, line, evidence)


def _entries(value: Any) -> Sequence[str]:
    """The entries of a list of short texts that are not all one, or of a text of codes."""
    if isinstance(value, str) and value.isalnum():
        value = list(value)
    if not isinstance(value, (list, tuple)) or not all(isinstance(item, str) for item in value):
        return ()
    short = all(0 < len(item) <= _LONGEST and not is_spot(item) for item in value)
    return value if short and len(set(value)) > 1 else ()


def _axis(said: str, common: Common) -> int | None:
    """1 where words speak of columns, 0 where of rows, ``None`` where of neither or of both."""
    kinds = {kind: (*common.layout[kind], *common.layout[f"{kind}s"]) for kind in ("column", "row")}
    found = {match.topic for match in lexicon_of(kinds).find(said)}
    return {"column": 1, "row": 0}[found.pop()] if len(found) == 1 else None


def _lines(info: LabwareInfo, axis: int) -> set[int]:
    return {row_column(spot)[axis] for spot in info.wells}
