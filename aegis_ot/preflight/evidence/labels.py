"""What the protocol declares of its labware and liquids: labels, ``load_liquid``, arguments."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from ...vocabulary import WellRef, nearest, one_line
from ..source import level_of, tokens
from .deck import DeckNames, parts_of_place
from .evidence import LONGEST_QUOTE, Evidence, Kind
from .well_names import WELL, not_wells_in
from .written_wells import entries_of

_WELL = re.compile(rf"\b{WELL}\b")
_SHORT = 4
"""Words of a description that is a name; a longer one is prose."""


def given_roles(
    deck: DeckNames, given: Mapping[str, Sequence[str]], words: Mapping[str, float]
) -> Iterator[Evidence]:
    """The guard's own arguments: ``roles={"ntc": ["PCR plate:H12"]}``, with a concentration or
    dose where a rule needs one: ``{"standard": ["4:A1 = 2 mg/mL", "4:B1 = 1 mg/mL"]}``.
    """
    for role, listed in given.items():
        wells: list[WellRef] = []
        levels: list[float | None] = []
        for place in map(str, listed):
            here = deck.at(place)
            wells += here
            levels += [level_of(parts_of_place(place)[2], words)] * len(here)
        citation = f"given to the guard as {role}"
        yield Evidence(Kind.GIVEN, role, tuple(wells), citation, role=role, levels=tuple(levels))


def unknown_places(
    deck: DeckNames, given: Mapping[str, Sequence[str]], words: Mapping[str, float]
) -> Iterator[tuple[str, bool]]:
    """What is wrong with places that were given, and whether it is so whatever else is loaded."""
    for role, listed in given.items():
        for place in map(str, listed):
            labware, spec, level = parts_of_place(place)
            found = deck.called(labware)
            told = f"The role {role} is given for '{place}', but "
            if level and level_of(level, words) is None:
                yield f"{told}'{level}' is no concentration or dose, as '2 mg/mL' is.", True
            if not found:
                on_deck = [info.label or info.slot for info in deck.plates()]
                told += f"no labware is called '{labware}'{nearest(labware, on_deck)}"
                yield f"{told}; there are {', '.join(map(repr, on_deck))}.", False
                continue
            left = [not_wells_in(spec, deck.trace.labware[key].wells) for key in found]
            if all(left):
                near = nearest(left[0], deck.trace.labware[found[0]].wells)
                yield f"{told}'{left[0]}' is no well of that labware{near}.", True


def loaded_liquids(deck: DeckNames) -> Iterator[Evidence]:
    """The names and descriptions of the liquids that were loaded into wells."""
    by_name: dict[str, list[WellRef]] = {}
    for well in deck.trace.wells.values():
        for liquid in well.liquids:
            by_name.setdefault(liquid, []).append(well.ref)
    for liquid, wells in by_name.items():
        yield Evidence(Kind.LIQUID, liquid, tuple(wells), f"liquid '{liquid}'")
        description = deck.trace.descriptions.get(liquid)
        if description and len(tokens(description)) <= _SHORT:
            said = f"liquid '{liquid}', described as '{one_line(description, LONGEST_QUOTE)}'"
            yield Evidence(Kind.DESCRIPTION, description, tuple(wells), said)


def labels(deck: DeckNames) -> Iterator[Evidence]:
    """What labware is called: "Compound source"; of single wells, where that is all it says."""
    for info in deck.plates():
        if not info.label:
            continue
        entries = entries_of(info.label, info)
        citation = f"label '{info.label}'"
        for names, said in entries:
            yield Evidence(Kind.NAME, said, deck.refs(info.key, names), citation)
        if not entries:
            apart = deck.refs(info.key, _WELL.findall(info.label))  # "DNA (H2 = water)"
            wells = tuple(ref for ref in deck.used_wells((info.key,)) if ref not in apart)
            yield Evidence(Kind.NAME, info.label, wells, citation, whole=True)
