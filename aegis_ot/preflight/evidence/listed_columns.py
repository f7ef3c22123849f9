"""Lists with one entry for each column or row of a plate: ``COLUMNS = "U V d1 d2 ...".split()``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ...instrumentation import LabwareInfo, is_spot
from ..layouts import Deck
from ..rules import Common
from ..text import SourceFacts, lexicon_of, origins
from ..trace import row_column
from .clues import Clue, Strength

_LONGEST = 24
"""Letters of an entry; more are a sentence."""

_LETTERS = "ABCDEFGHIJKLMNOP"

_TURNED = frozenset({"reversed", "sorted"})
"""Functions after which the place in the list is none on the plate."""


def listed_columns(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What such a list says of each column or row of the plate that the run goes along with it."""
    for name, value in facts.constants.items():
        entries = _entries(value)
        axis = _axis(f"{name} {facts.notes.get(name, '')}", common) if entries else None
        if axis is None:
            continue
        keys = _gone_along(deck, facts, name, axis)
        meant = [i for i in deck.plates() if i.key in keys and _count(i, axis) == len(entries)]
        if len(meant) != 1:
            continue
        line = facts.assigned.get(name)
        for entry in dict.fromkeys(entries):
            places = {at for at, other in enumerate(entries) if other == entry}
            named = [spot for spot in meant[0].wells if row_column(spot)[axis] in places]
            used = [spot for spot in named if (meant[0].key, spot) in deck.refs]
            used += deck.passed_over(meant[0].key, named, axis)
            if wells := tuple(deck.ref(meant[0].key, spot) for spot in dict.fromkeys(used)):
                said = f"plate map `{name}` at line {line}"
                yield Clue(Strength.NAME, entry, wells, line, said)


def _entries(value: Any) -> Sequence[str]:
    """The entries of a list of short texts that are not all one, or of a text of codes; not the
    names of rows or columns themselves.
    """
    if isinstance(value, str) and value.isalnum():
        value = list(value)
    if not isinstance(value, (list, tuple)) or not all(isinstance(item, str) for item in value):
        return ()
    short = all(0 < len(item) <= _LONGEST and not is_spot(item) for item in value)
    names = list(_LETTERS[: len(value)]), [str(at) for at in range(1, len(value) + 1)]
    return value if short and len(set(value)) > 1 and list(value) not in names else ()


def _axis(said: str, common: Common) -> int | None:
    """1 where words speak of columns, 0 where of rows, ``None`` where of neither or of both."""
    kinds = {kind: (*common.layout[kind], *common.layout[f"{kind}s"]) for kind in ("column", "row")}
    found = {match.topic for match in lexicon_of(kinds).find(said)}
    return {"column": 1, "row": 0}[found.pop()] if len(found) == 1 else None


def _gone_along(deck: Deck, facts: SourceFacts, name: str, axis: int) -> set[str]:
    """The labware whose columns or rows the run counts while it goes through a list, in order:
    ``for i, code in enumerate(COLUMNS): ... plate.columns()[i]``, or both in one ``zip``.
    """
    kind = "column" if axis else "row"
    found: set[str] = set()
    for loop in facts.runs:
        if all(values.source != name for values in loop.values):
            continue
        made_of = origins(facts, loop.names, range(loop.first, loop.last + 1))
        if not _TURNED.isdisjoint(made_of):
            continue
        for place in facts.numbered:
            within = any(loop.first <= line <= loop.last for line in place.lines)
            if within and place.axis == kind and place.name in loop.names and place.first in (0, 1):
                found |= deck.by_name.get(place.labware, set())
        beside = {key for other in made_of for key in deck.by_name.get(other, ())}
        found |= beside if len(beside) == 1 else set()
    return found


def _count(info: LabwareInfo, axis: int) -> int:
    return len({row_column(spot)[axis] for spot in info.wells})
