"""Names in an index: ``rack[MASTER_MIX]``, ``plate.columns()[NTC_COLUMN]``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...vocabulary import WellRef
from ..layouts import Deck
from ..rules import Common
from ..text import Place, SourceFacts, tokens, words_of
from ..trace import row_column
from .clues import Clue, Strength
from .name_parts import without_position


def indexing_names(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What labware was indexed with."""
    positions = words_of(common.positions)
    for place in facts.places:
        keys = deck.by_name.get(place.labware, set())
        if len(keys) != 1 and not (place.labware in deck.in_turn and deck.are_alike(keys)):
            continue
        wells = tuple(ref for key in sorted(keys) for ref in _indexed(deck, key, place))
        if place.partly:
            wells = tuple(ref for ref in wells if (ref.labware, ref.name) in deck.refs)
        for name in place.names:
            if positions >= set(tokens(name)):
                continue
            if wells and ("<comprehension>", name) not in facts.loose:
                yield Clue(
                    Strength.NAME,
                    without_position(name, common),
                    wells,
                    place.line,
                    f"name `{name}` at line {place.line}",
                )


def _indexed(deck: Deck, key: str, place: Place) -> Iterator[WellRef]:
    info = deck.trace.labware[key]
    value = place.value
    names = list(info.wells)
    if place.kind in ("well", "wells") and not isinstance(value, str):
        groups = [[name] for name in names]
    elif place.kind in ("columns", "column"):
        groups = _grouped(names, 1)
    elif place.kind in ("rows", "row"):
        groups = _grouped(names, 0)
    else:
        groups = []
    if isinstance(value, bool):
        return
    if isinstance(value, int) and -len(groups) <= value < len(groups):
        chosen = groups[value]
    elif isinstance(value, slice) and value != slice(None, None):
        chosen = [name for group in groups[value] for name in group]
    elif isinstance(value, str) and place.kind in ("column", "row"):
        if place.kind == "column" and not value.isdecimal():
            return
        at = 1 if place.kind == "column" else 0
        wanted = int(value) - 1 if value.isdecimal() else row_column(value)[0]
        chosen = [name for name in names if row_column(name)[at] == wanted]
    elif isinstance(value, str) and value in info.wells:
        chosen = [value]
    elif isinstance(value, (list, tuple)):
        chosen = [item for item in value if isinstance(item, str) and item in info.wells]
    else:
        return
    for name in chosen:
        yield deck.ref(key, name)


def _grouped(names: Sequence[str], axis: int) -> list[list[str]]:
    groups: dict[int, list[str]] = {}
    for name in names:
        groups.setdefault(row_column(name)[axis], []).append(name)
    return [groups[at] for at in sorted(groups)]
