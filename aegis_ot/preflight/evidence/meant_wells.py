"""Which wells a part of a text means: of which labware, and whether unused ones as well."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from ...vocabulary import WellRef
from ..layouts import Deck, Part, axis_of, numbers_things, well_names
from ..rules import Common
from ..text import lexicon_of
from ..trace import in_trough
from .twins import may_be_twins

_ALL = re.compile(r"\ball\s+\d", re.IGNORECASE)


class Meant(NamedTuple):
    """The labware that a part speaks of.

    Attributes:
        keys: Those that it or its text names, none where nothing is said.
        firm: Whether it says so itself.
        others: Those that it does not mean.
        twins: Whether plates of one kind are said to be filled alike.
    """

    keys: frozenset[str]
    firm: bool
    others: frozenset[str]
    twins: bool


def wells_meant(
    deck: Deck, part: Part, said: str, labware: Meant, common: Common
) -> Iterator[Sequence[WellRef]]:
    """The wells that a part means, those of each labware together; none where it is not plain.

    Args:
        deck: What stands where.
        part: A part of a text that names wells.
        said: The part, and what follows it.
        labware: Of which labware it speaks.
        common: Words.
    """
    having = _having(deck, part, labware, common)
    by_hand = bool(lexicon_of({"hand": common.by_hand}).find(said))
    meant: dict[str, list[WellRef]] = {}
    for key, named in having.items():
        if used := _with_left_out(deck, part, key, named, labware.firm, by_hand):
            meant[key] = [deck.ref(key, name) for name in dict.fromkeys(used)]
    keys, firm = labware.keys, labware.firm
    if len(meant) > 1 and not (firm and meant.keys() == keys and deck.are_alike(keys)):
        # Of several labware that have such wells it speaks of those that the run fills there, or
        # else of those that it fills at all: what is untreated gets nothing.
        here = {key: wells for key, wells in meant.items() if _is_mostly_filled(deck, wells)}
        meant = here or {key: wells for key, wells in meant.items() if key in deck.filled}
    plates = [deck.trace.labware[key] for key in meant]
    if labware.twins and len({plate.load_name for plate in plates}) == 1:
        kind = plates[0].load_name
        alike = [k for k in having if k in deck.filled and deck.trace.labware[k].load_name == kind]
        there = {ref.name for wells in meant.values() for ref in wells}
        meant |= {key: [deck.ref(key, n) for n in having[key] if n in there] for key in alike}
    elif not all(plate.label and may_be_twins(plate, plates[0]) for plate in plates[1:]):
        return
    yield from meant.values()


def _having(deck: Deck, part: Part, labware: Meant, common: Common) -> Mapping[str, Sequence[str]]:
    """The labware that may be meant, with the names of the wells that a part names in each."""
    names = well_names(common)
    filled = deck.filled if goes_there(part, common) else None
    having = {
        info.key: named
        for info in deck.plates()
        if info.key not in labware.others
        and (filled is None or info.key in filled)
        and (named := names.meant_by(part.wells, info))
    }
    called = {key: named for key, named in having.items() if key in labware.keys}
    if labware.firm and not called and numbers_things(part):
        return {}  # "Fractions F1-F12: tube rack slot 4"
    in_use = any((key, name) in deck.refs for key, named in called.items() for name in named)
    # It may name that labware in passing.
    return called or having if labware.firm or in_use else having


def _with_left_out(
    deck: Deck, part: Part, key: str, named: Sequence[str], firm: bool, by_hand: bool
) -> Sequence[str]:
    """Those of the named wells of a labware that the run uses, and those that it leaves out though
    they are meant.

    "Column 2 = vehicle" may leave out the rows at the edge, if all of the plate does; "A2-H2" and
    "all 8" do not.
    """
    told = firm and in_trough(deck.trace, key)  # unused as well: the diluent, say
    used = [name for name in named if told or (key, name) in deck.refs]
    ranges = any(match["last"] for match in part.wells)
    outright = ranges or _ALL.search(part.words) or all(match["first"] for match in part.wells)
    if outright and deck.are_left_out(key, [name for name in named if name not in used], used):
        return named  # more than a few are wells for which there is nothing this time
    axis = axis_of(part)
    if axis is not None and not by_hand:
        return [*deck.where_filled(key, used, axis), *deck.passed_over(key, list(named), axis)]
    return used


def _is_mostly_filled(deck: Deck, wells: Sequence[WellRef]) -> bool:
    """Whether the run fills half of these wells at least, of those that it uses; not of a trough,
    into which goes waste.
    """
    if in_trough(deck.trace, *{ref.labware for ref in wells}):
        return False
    used = [(ref.labware, ref.name) for ref in wells if (ref.labware, ref.name) in deck.refs]
    return bool(used) and 2 * sum(place in deck.received for place in used) >= len(used)


def goes_there(part: Part, common: Common) -> bool:
    """Whether a part says what goes into its wells: "diluent to columns 2-12"."""
    before = part.text[: part.text.find(part.wells[0].group())].split()
    return bool(before) and before[-1].lower() in common.toward
