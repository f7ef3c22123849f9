"""Plate maps: constants that hold well names, ``NTC_WELLS = ["H11", "H12"]``."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

from ...instrumentation import is_spot
from ..layouts import (
    Deck,
    drawn_and_filled,
    is_work_list,
    labware_by_field,
    labware_of_map,
    refs_of,
    used_with,
    wells_between,
)
from ..rules import Common
from ..text import SourceFacts, concentration_in, lexicon_of, origins
from .clues import Clue, Strength
from .levels import (
    as_one_of_amounts,
    far_apart,
    is_number,
    names_amounts,
    names_counts,
    number_in,
    words_for_zero,
)
from .name_parts import without_position


def plate_maps(
    deck: Deck, facts: SourceFacts, common: Common, others: Collection[str]
) -> Iterator[Clue]:
    """Constants that hold well names: ``NTC_WELLS = ["H11", "H12"]``, ``{"A1": "NTC"}``.

    Not the ``others``, which list transfers.
    """
    decks = lexicon_of({"deck": common.decks})
    written = _written_levels(facts, common)
    for name, value in facts.constants.items():
        if name == "metadata" or name in others or is_work_list(deck, value) or decks.find(name):
            continue
        line = facts.assigned.get(name)
        entries = list(_Reader(common, written).entries(without_position(name, common), value))
        all_names = [well for _, wells, _, _ in entries for well in wells]
        if not all_names:
            continue
        labware = labware_of_map(deck, facts, name, all_names, common)
        by_key = labware_by_field(deck, facts, name)
        used = set(used_with(deck, facts, name))
        if name in facts.parameters and not used:
            continue  # what it says stands nowhere, or is the place of a tip
        places = _numbers_places(facts, name)
        rest = used - {key for keys in by_key.values() for key in keys}
        told = isinstance(value, Mapping) and far_apart(_levels_told(value, written).values())
        strength = Strength.NAME
        if _tells_nothing_apart(value, [level for _, _, level, _ in entries], places):
            strength, entries = Strength.LOOSE_NAME, [(name, tuple(all_names), None, "")]
        for text, wells, level, column in entries:
            keyed = [keys for key, keys in by_key.items() if text.endswith(f" {key}")]
            if column in by_key:
                keyed = [by_key[column]]
            elif column and by_key and len(rest) == 1:
                keyed = [tuple(rest)]  # not where the other column's wells are
            refs = tuple(refs_of(deck, keyed[0] if keyed else labware, wells))
            if not keyed:
                refs = tuple(drawn_and_filled(deck, used, wells)) or refs
            if concentration_in(text) is not None or places:
                level = None  # the text says it, or the number beside it is a column's
            yield Clue(
                strength,
                text,
                refs,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(refs),
            )
            if told and level is not None:
                where = f"`{name}` at line {line}"
                yield as_one_of_amounts(refs, line, where, (level,) * len(refs))


def _tells_nothing_apart(value: Any, levels: Sequence[float | None], places: bool) -> bool:
    """Whether the keys of a map are columns, so that its name is all it says of each well.

    ``TREATMENT = {"1": "A1", "2": "A2", "3": "A3"}``: the vehicle may well be among them. Plain
    numbers are columns only where the run takes them for such, ``places``.
    """
    return (
        isinstance(value, Mapping)
        and len(value) >= _FEWEST_TOLD
        and (places or all(level is None for level in levels))
        and all(isinstance(key, str if not places else (str, int)) for key in value)
        and all(str(key).isdecimal() for key in value)
        and all(map(_spots, value.values()))
    )


def _numbers_places(facts: SourceFacts, name: str) -> bool:
    """Whether the run takes the numbers of a map's rows for those of columns."""
    taken = {part for names in facts.unpacked for part in names}
    return any(
        place.axis == "column"
        and place.name in taken
        and name in origins(facts, (place.name,), place.lines)
        for place in facts.numbered
    )


Entry = tuple[str, tuple[str, ...], "float | None", str]
"""What is said, of which wells, their level, and the column of a table that holds them."""


class _Reader:
    """Reads a constant that holds well names."""

    def __init__(self, common: Common, written: Sequence[Mapping[str, float]]) -> None:
        self._common = common
        self._written = written

    def entries(self, name: str, value: Any, depth: int = 0) -> Iterator[Entry]:
        """Each group of wells with what is said of it."""
        if depth > 3:
            return
        if isinstance(value, str):
            if wells := wells_between(value):
                yield name, wells, None, ""
        elif isinstance(value, Mapping):
            if depth > 0 and _is_record(value):
                yield from self._record(name, value)
                return
            levels = _levels_of_keys(value, names_amounts(name, self._common))
            levels = levels or _levels_told(value, self._written)
            coded = _has_codes(value)
            for key, item in value.items():
                if isinstance(key, str) and not coded and (spanned := wells_between(key)):
                    yield from self._beside(name, spanned, item)
                else:
                    level = levels.get(key)
                    for text, wells, own, column in self.entries(f"{name} {key}", item, depth + 1):
                        yield text, wells, level if own is None else own, column
        elif isinstance(value, (list, tuple)):
            yield from self._listed(name, value, depth)
        elif isinstance(value, (set, frozenset)):
            yield from self._listed(name, sorted(value, key=str), depth)

    def _listed(self, name: str, value: Sequence[Any], depth: int) -> Iterator[Entry]:
        wells = tuple(item for item in value if is_spot(item))
        spans = [wells_between(item) for item in value if isinstance(item, str)]
        if spans and all(spans) and len(spans) == len(value):
            yield name, tuple(well for span in spans for well in span), None, ""
        elif wells and depth > 0:
            yield from self._beside(name, wells, [item for item in value if item not in wells])
        else:
            for item in value:
                if isinstance(item, (list, tuple, Mapping)):
                    yield from self.entries(name, item, depth + 1)

    def _record(self, name: str, item: Mapping[Any, Any]) -> Iterator[Entry]:
        """A row of a table: ``{"well": "A1", "type": "NTC", "conc": 0}``."""
        held = {str(key): spots for key, value in item.items() if (spots := _spots(value))}
        texts = [v for v in item.values() if isinstance(v, str) and not is_spot(v)]
        numbers = {str(key): float(v) for key, v in item.items() if is_number(v)}
        amounts = [number for key, number in numbers.items() if names_amounts(key, self._common)]
        if not amounts and names_amounts(name, self._common):
            amounts = [n for key, n in numbers.items() if not names_counts(key, self._common)]
        level = amounts[0] if len(amounts) == 1 else None
        for text in texts or [name]:
            for column, wells in held.items():
                yield text, wells, level, column

    def _beside(self, name: str, wells: tuple[str, ...], said: Any) -> Iterator[Entry]:
        """What stands beside wells: ``"A1": "NTC"``, ``("A1", "NTC", 5)``."""
        if isinstance(said, Mapping):
            yield from self._record(name, {"": wells, **said})
            return
        listed = said if isinstance(said, (list, tuple)) else [said]
        texts = [item for item in listed if isinstance(item, str)]
        numbers = [float(item) for item in listed if is_number(item)]
        level = numbers[0] if len(numbers) == 1 else None
        for text in texts or ([name] if numbers else []):
            yield text, wells, level, ""


def _has_codes(value: Mapping[Any, Any]) -> bool:
    """Whether wells stand under keys, of which one at least is no well: "T2", so "P1" is none."""
    return all(map(_spots, value.values())) and not all(map(is_spot, value))


def _levels_of_keys(value: Mapping[Any, Any], of_amounts: bool) -> dict[Any, float]:
    """The levels that the keys of a map are: numbers, or texts of decimals; texts of other numbers
    where the map's name speaks ``of_amounts``.
    """
    found = {key: number for key in value if (number := number_in(key)) is not None}
    texts = {number for key, number in found.items() if isinstance(key, str)}
    amounts = any(number % 1 for number in texts) or (of_amounts and far_apart(texts))
    if not amounts or len(found) < len(value):
        found = {key: number for key, number in found.items() if not isinstance(key, str)}
    return found


def _written_levels(facts: SourceFacts, common: Common) -> list[Mapping[str, float]]:
    """What the text lists under names, and beside those the words for nothing at all."""
    nothing = dict.fromkeys(words_for_zero(common), 0.0)
    return [{**nothing, **told} for told in facts.levels.values()]


def _levels_told(
    value: Mapping[Any, Any], written: Sequence[Mapping[str, float]]
) -> dict[Any, float]:
    """The levels of the keys of a map, where the text lists amounts under all of them."""
    found = [told for told in written if len(value) >= _FEWEST_TOLD and value.keys() <= told.keys()]
    return {key: found[0][key] for key in value} if len(found) == 1 else {}


_FEWEST_TOLD = 3


def _spots(value: Any) -> tuple[str, ...]:
    """The wells that a cell of a table names."""
    listed = tuple(value) if isinstance(value, (list, tuple)) else (value,)
    return listed if all(map(is_spot, listed)) else ()


def _is_record(value: Mapping[Any, Any]) -> bool:
    """Whether this is one row, which says one well and more, rather than a map of wells."""
    wells = [v for v in value.values() if is_spot(v)]
    keys = [key for key in value if isinstance(key, str) and not is_spot(key)]
    return len(wells) == 1 and len(keys) == len(value) and len(value) > 1
