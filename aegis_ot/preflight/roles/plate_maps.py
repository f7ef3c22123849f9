"""Plate maps: constants that hold well names, ``NTC_WELLS = ["H11", "H12"]``."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from ...instrumentation import is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..text import Place, SourceFacts, concentration_in, lexicon_of, origins, tokens
from .clues import Clue, Strength
from .deck import MOST_TUBES, Deck
from .labware_nouns import LabwareNouns
from .levels import as_one_of_amounts, far_apart, is_number, names_amounts, names_counts, number_in
from .phrases import without_position, words_of
from .well_names import plain_name, wells_between
from .work_lists import drawn_and_filled, is_work_list


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
        places = _numbers_places(facts, name)
        rest = used - {key for keys in by_key.values() for key in keys}
        told = isinstance(value, Mapping) and far_apart(_levels_told(value, written).values())
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
                Strength.NAME,
                text,
                refs,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(refs),
            )
            if told and level is not None:
                where = f"`{name}` at line {line}"
                yield as_one_of_amounts(refs, line, where, (level,) * len(refs))


def labware_of_map(
    deck: Deck, facts: SourceFacts, name: str, spots: Sequence[str], common: Common
) -> tuple[str, ...]:
    """The labware that a plate map of this name speaks of: the one that is called so, several
    plates where the run uses it on all alike, none where that is not plain.
    """
    owners = (*deck.by_name.items(), *deck.by_label.items())
    called = {key for own, keys in owners if tokens(own) == tokens(name) for key in keys}
    if len(called) == 1:
        return tuple(called)
    used = used_with(deck, facts, name)
    if len(used) > 1:
        in_all = all((key, spot) in deck.refs for key in used for spot in spots)
        sizes = [len(deck.trace.labware[key].wells) for key in used]
        if in_all and min(sizes) <= MOST_TUBES < max(sizes):
            # Tubes, and wells of the same names: of both where each goes into its namesake.
            if _is_stamped(deck, used, spots):
                return used
            alike = called_alike(deck, name, common)
            return (alike,) if alike in used else ()
        used = _alike(deck, used, spots)
    return used or _unused(deck, name, spots, common)


def _unused(deck: Deck, name: str, spots: Sequence[str], common: Common) -> tuple[str, ...]:
    """The one labware that a map speaks of which the run does not use: ``RESERVOIR_MAP``."""
    nouns = LabwareNouns(deck, common)
    called = nouns.named(name) or nouns.kind_in(name)
    if called:
        return tuple(called)
    one = called_alike(deck, name, common) or deck.most_likely(spots)
    return (one,) if one and one in (nouns.of_kinds_in(name) or (one,)) else ()


def _is_stamped(deck: Deck, keys: Sequence[str], spots: Sequence[str]) -> bool:
    """Whether each of these places of one labware is drawn into the same place of another."""
    names = set(map(plain_name, spots))
    copied = {
        source.ref.name
        for source, well, _ in deck.trace.feedings()
        if source.ref.name == well.ref.name
        and source.ref.labware != well.ref.labware
        and {source.ref.labware, well.ref.labware} <= set(keys)
    }
    return names <= copied


def refs_of(deck: Deck, labware: Sequence[str], spots: Iterable[str]) -> Iterator[WellRef]:
    """The wells of these names in each of these labware."""
    names = [plain_name(spot) for spot in spots]
    for key in labware:
        info = deck.trace.labware.get(key)
        for name in names:
            if info is not None and name in info.wells:
                yield deck.ref(key, name)


def used_with(deck: Deck, facts: SourceFacts, name: str) -> tuple[str, ...]:
    """The labware that is indexed by this constant, straight or in a comprehension.

    Only where all indices are made of parts of it, that which is indexed by these.
    """
    straight: set[str] = set()
    by_parts: set[str] = set()
    for place in facts.places:
        if name in origins(facts, place.names, (place.line,)):
            keys = deck.by_name.get(place.labware) or _listed(deck, facts, place)
            (by_parts if place.made else straight).update(keys)
    return tuple(sorted(straight or by_parts))


def _listed(deck: Deck, facts: SourceFacts, place: Place) -> set[str]:
    """The labware that a comprehension takes in turn: ``[rack[name] for rack in racks ...]``."""
    lists = origins(facts, (place.labware,), (place.line,))
    held = (deck.lists.get(name, set()) for name in lists)
    return {key for keys in held if len(keys) > 1 for key in keys}


def _numbers_places(facts: SourceFacts, name: str) -> bool:
    """Whether the run takes the numbers of a map's rows for those of columns."""
    taken = {part for names in facts.unpacked for part in names}
    return any(
        place.axis == "column"
        and place.name in taken
        and name in origins(facts, (place.name,), place.lines)
        for place in facts.numbered
    )


def labware_by_field(deck: Deck, facts: SourceFacts, name: str) -> dict[str, tuple[str, ...]]:
    """For keys of a map the one labware that is indexed by them: ``tubes[layout["mix"]]``.

    Or by a name that such a key gives its value: ``tube = row["tube"]``, a helper's parameter.
    """
    found: dict[str, set[str]] = {}
    for place in facts.places:
        names = origins(facts, place.names, (place.line,))
        if name in names:
            asked = {
                key
                for part in names
                for key, first, last in facts.asked.get(part, ())
                if first <= place.line <= last
            }
            for key in asked.union(place.keys):
                found.setdefault(key, set()).update(deck.by_name.get(place.labware, ()))
    return {key: tuple(labware) for key, labware in found.items() if len(labware) == 1}


def _alike(deck: Deck, keys: Sequence[str], spots: Sequence[str]) -> tuple[str, ...]:
    """Those in which all these wells are filled, if they are of one kind; or else all of them, if
    they are of one kind and the run fills the same wells of each.
    """
    filled = tuple(key for key in keys if all((key, spot) in deck.received for spot in spots))
    given = {frozenset(name for key, name in deck.received if key == one) for one in keys}
    meant = filled or (tuple(keys) if len(given) == 1 else ())
    return meant if deck.are_alike(meant) else ()


def called_alike(deck: Deck, name: str, common: Common) -> str:
    """The one labware whose label shares a telling word with this constant's name."""
    dull = words_of(common.noise)
    words = set(tokens(name)) - dull
    alike = [info.key for info in deck.plates() if words & (set(tokens(info.label)) - dull)]
    return alike[0] if len(alike) == 1 else ""


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
    nothing = {word: 0.0 for word, level in common.levels.items() if level == 0}
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
