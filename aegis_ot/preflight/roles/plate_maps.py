"""Plate maps: constants that hold well names, ``NTC_WELLS = ["H11", "H12"]``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..text import SourceFacts
from .clues import Clue, Strength
from .deck import Deck
from .well_names import WELL_NAME


def plate_maps(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    """Constants that hold well names: ``NTC_WELLS = ["H11", "H12"]``, ``{"A1": "NTC"}``."""
    for name, value in facts.constants.items():
        if name == "metadata":
            continue
        line = facts.assigned.get(name)
        entries = list(_entries(name, value))
        all_names = [well for _, wells, _ in entries for well in wells]
        if not all_names:
            continue
        labware = _used_with(deck, facts, name) or deck.most_likely(dict.fromkeys(all_names))
        if not labware:
            continue
        info = deck.trace.labware[labware]
        for text, wells, level in entries:
            refs = tuple(deck.ref(labware, well) for well in wells if well in info.wells)
            yield Clue(
                Strength.NAME,
                text,
                refs,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(refs),
            )


def _used_with(deck: Deck, facts: SourceFacts, name: str) -> str:
    """The labware that is indexed by this constant, straight or in a comprehension."""
    keys: set[str] = set()
    for place in facts.places:
        if name in place.names:
            keys |= deck.by_name.get(place.labware, set())
    return next(iter(keys)) if len(keys) == 1 else ""


def _entries(
    name: str, value: Any, depth: int = 0
) -> Iterator[tuple[str, tuple[str, ...], float | None]]:
    """``(text, well names, level)`` of a constant that holds well names."""
    if depth > 3:
        return
    if isinstance(value, str):
        if WELL_NAME.match(value):
            yield name, (value,), None
        return
    if isinstance(value, Mapping):
        for key, item in value.items():
            if isinstance(key, str) and WELL_NAME.match(key):
                for text in _said_of(item):
                    yield text, (key,), None
                for number in _numbers_of(item):
                    yield name, (key,), number
            else:
                level = float(key) if is_number(key) else None
                for text, wells, own in _entries(f"{name} {key}", item, depth + 1):
                    yield text, wells, level if own is None else own
        return
    if isinstance(value, (list, tuple)):
        wells = tuple(item for item in value if isinstance(item, str) and WELL_NAME.match(item))
        if wells and len(wells) == len(value):
            yield name, wells, None
            return
        texts = [item for item in value if isinstance(item, str) and not WELL_NAME.match(item)]
        if wells and depth > 0:
            numbers = [float(item) for item in value if is_number(item)]
            for text in texts or [name]:
                yield text, wells, numbers[0] if len(numbers) == 1 else None
            return
        for item in value:
            if isinstance(item, (list, tuple, Mapping)):
                yield from _record(name, item, depth + 1)


def _record(
    name: str, item: Any, depth: int
) -> Iterator[tuple[str, tuple[str, ...], float | None]]:
    """A row of a table: ``{"well": "A1", "type": "NTC"}`` or ``("A1", "NTC", 5)``."""
    if isinstance(item, Mapping):
        wells = tuple(v for v in item.values() if isinstance(v, str) and WELL_NAME.match(v))
        if len(wells) == 1:
            for value in item.values():
                if isinstance(value, str) and value not in wells:
                    yield value, wells, None
            return
    yield from _entries(name, item, depth)


def _said_of(item: Any) -> Iterator[str]:
    if isinstance(item, str):
        yield item
    elif isinstance(item, Mapping):
        yield from (value for value in item.values() if isinstance(value, str))
    elif isinstance(item, (list, tuple)):
        yield from (value for value in item if isinstance(value, str))


def _numbers_of(item: Any) -> Iterator[float]:
    if is_number(item):
        yield float(item)


def is_number(value: Any) -> bool:
    """Whether a constant is a number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
