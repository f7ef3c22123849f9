"""What comments and docstrings say of wells by name."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from ...vocabulary import WellRef
from ..layouts import (
    Amount,
    Deck,
    LabwareNouns,
    Part,
    Topic,
    axis_of,
    items_after,
    numbers_things,
    plain_lines,
    side_by_side,
    told_tables,
    unit_in_brackets,
    used_with,
    well_names,
    with_shared_words,
    with_unit,
    with_what_follows,
)
from ..rules import Common
from ..text import (
    Rank,
    SourceFacts,
    comment_blocks,
    direction_in,
    lexicon_of,
    listed_levels,
    tokens,
)
from ..trace import in_trough, row_column
from .bare_numbers import with_bare_numbers
from .clues import Clue, Strength, shortened
from .levels import names_zero
from .spoken import laid_out_in_the_run
from .twins import called_alike, said_to_be_twins


def written_wells(
    deck: Deck, facts: SourceFacts, common: Common, others: Collection[str]
) -> Iterator[Clue]:
    """Well names in comments and docstrings: "A1-A8: samples", "NTC in H12".

    And in constants of several lines, but those of the ``others``, which are tables.
    """
    texts = list(facts.docstrings)
    texts += comment_blocks(facts, indented=True)
    texts += [(1, text) for text in facts.metadata.values()]
    texts += _written_out(facts, others)
    texts += laid_out_in_the_run(deck.trace, common)
    nouns = LabwareNouns(deck, common)
    noted = {
        note: nouns.of_name(name) or _indexed_by(deck, facts, name)
        for name, note in facts.notes.items()
    }
    alone = {info.slot: next(iter(info.wells)) for info in deck.plates() if len(info.wells) == 1}
    plain = (block for line, text in texts for block in told_tables(line, text, common, alone))
    apart = (block for line, text in plain for block in side_by_side(line, text, common))
    for line, text in apart:
        layout = line not in facts.among_code  # there, comments are on the run's steps
        clues = _of_text(deck, nouns, noted, line, text, layout, common)
        yield from with_bare_numbers([*clues], text)


def _indexed_by(deck: Deck, facts: SourceFacts, name: str) -> frozenset[str]:
    """The one labware that a map of wells indexes: its comment is about that."""
    keys = used_with(deck, facts, name)
    return frozenset(keys) if len(keys) == 1 else frozenset()


def _of_text(
    deck: Deck,
    nouns: LabwareNouns,
    noted: Mapping[str, frozenset[str]],
    line: int,
    text: str,
    layout: bool,
    common: Common,
) -> Iterator[Clue]:
    """What one comment or docstring says, which begins at a line."""
    topic = Topic(nouns, common)
    amount: Amount | None = None
    unit, twins = "", said_to_be_twins(text, common)
    for number, written in plain_lines(text, deck, nouns, common, layout):
        parts, more = with_what_follows(topic.entries(written), common)
        topic.next_line(written, parts)
        parts = [nouns.without_place(topic.without_heading(part)) for part in parts]
        unit = unit if parts else unit_in_brackets(written)
        parts = with_unit(parts, unit)
        parts, amount = with_shared_words(parts, amount if written.strip() else None)
        own = [nouns.before(part) for part in parts]
        for at, (part, before) in enumerate(zip(parts, own, strict=True)):
            topic.next_part(before)
            if len(part.text) > _LONGEST_CLAUSE or not tokens(part.words):
                continue
            if nouns.is_of_deck(part, topic.in_deck) or nouns.is_elsewhere(part):
                continue
            firm = topic.said(part, before, noted.get(written.strip(), frozenset()))
            keys = firm or topic.above() or _only_one_with(deck, parts, common)
            # "col 3  1 nM     tube A2": the column is not one of the tubes'.
            others = frozenset[str]().union(*own[at:]).difference(*own[: at + 1])
            meant = _Meant(keys - others, bool(firm) or topic.places(keys), others, twins)
            said = f"{part.text}, {more[at]}"
            clues = list(_spoken(deck, part, said, line + number, meant, common))
            placed = topic.places(keys)
            if _goes_there(part, common):
                topic.next_part(frozenset(ref.labware for clue in clues for ref in clue.wells))
            for clue in clues:
                levels = _across(part, f"{part.words}, {more[at]}", clue.wells, common)
                if topic.heading and keys.isdisjoint(topic.heading):
                    levels = ()  # named by what its wells hold, perhaps
                clue = replace(clue, placed=placed, levels=levels)
                yield from _one_by_one(part, said, clue, common) or [clue]


def _one_by_one(part: Part, said: str, clue: Clue, common: Common) -> list[Clue]:
    """Each well of a row or column with its own item: "row A: ethanol, 1 uM, 3 uM"."""
    last = part.wells[-1]
    if len(part.wells) > 1 or last["first"]:
        return []
    end = said.find(last.group()) + len(last.group())
    items = items_after(said.rstrip(" ,"), end, len(clue.wells), common)
    return [
        replace(clue, text=item, wells=(ref,), levels=())
        for item, ref in zip(items, clue.wells, strict=False)
    ]


def _written_out(facts: SourceFacts, others: Collection[str]) -> list[tuple[int, str]]:
    """Texts of several lines that are bound to names, with their first lines."""
    return [
        (facts.assigned.get(name, 1), value)
        for name, value in facts.constants.items()
        if isinstance(value, str) and name not in others and value.count("\n") >= _FEWEST_LINES
    ]


_FEWEST_LINES = 3


def _only_one_with(deck: Deck, parts: Sequence[Part], common: Common) -> frozenset[str]:
    """The one labware that all entries of a line can speak of: "A1 vehicle, A2 low, A3 high".

    A plate that is filled may lack one entry, the wells that are left untreated.
    """
    names = well_names(common)
    fitting = []
    for info in deck.plates():
        lacking = sum(
            not all(
                any((info.key, name) in deck.refs for name in names.meant(match, info))
                for match in part.wells
            )
            for part in parts
        )
        if not lacking or (lacking == 1 and len(parts) > 2 and info.key in deck.filled):
            fitting.append(info.key)
    return frozenset(fitting) if len(fitting) == 1 else frozenset()


_LONGEST_CLAUSE = 160

_ALL = re.compile(r"\ball\s+\d", re.IGNORECASE)


class _Meant(NamedTuple):
    """The labware that a part speaks of, whether it says so itself, and those it does not mean;
    and whether plates of one kind are said to be filled alike.
    """

    keys: frozenset[str]
    firm: bool
    others: frozenset[str]
    twins: bool


def _spoken(
    deck: Deck, part: Part, said: str, line: int, labware: _Meant, common: Common
) -> Iterator[Clue]:
    names = well_names(common)
    keys, firm, others, twins = labware
    by_hand = lexicon_of({"hand": common.by_hand}).find(said)
    meant: dict[str, list[WellRef]] = {}
    # "Column 2 = vehicle" may leave out the rows at the edge, if all of the plate does; "A2-H2"
    # and "all 8" do not.
    ranges = any(match["last"] for match in part.wells)
    outright = ranges or _ALL.search(part.words) or all(match["first"] for match in part.wells)
    axis = axis_of(part)
    filled = deck.filled if _goes_there(part, common) else None
    having = {
        info.key: named
        for info in deck.plates()
        if info.key not in others
        and (filled is None or info.key in filled)
        and (named := names.meant_by(part.wells, info))
    }
    called = {key: named for key, named in having.items() if key in keys}
    if firm and not called and numbers_things(part):
        return  # "Fractions F1-F12: tube rack slot 4"
    if firm or any((key, name) in deck.refs for key, named in called.items() for name in named):
        having = called or having  # it may name that labware in passing
    for key, named in having.items():
        told = firm and in_trough(deck.trace, key)  # unused as well: the diluent, say
        used = [name for name in named if told or (key, name) in deck.refs]
        if outright and deck.are_left_out(key, [name for name in named if name not in used], used):
            used = named  # more than a few are wells for which there is nothing this time
        elif axis is not None and not by_hand:
            used = [*deck.where_filled(key, used, axis), *deck.passed_over(key, named, axis)]
        if used:
            meant[key] = [deck.ref(key, name) for name in dict.fromkeys(used)]
    if len(meant) > 1 and not (firm and meant.keys() == keys and deck.are_alike(keys)):
        # Of several labware that have such wells it speaks of those that the run fills there, or
        # else of those that it fills at all: what is untreated gets nothing.
        here = {key: wells for key, wells in meant.items() if _is_mostly_filled(deck, wells)}
        meant = here or {key: wells for key, wells in meant.items() if key in deck.filled}
    plates = [deck.trace.labware[key] for key in meant]
    if twins and len({plate.load_name for plate in plates}) == 1:
        kind = plates[0].load_name
        alike = [k for k in having if k in deck.filled and deck.trace.labware[k].load_name == kind]
        there = {ref.name for wells in meant.values() for ref in wells}
        meant |= {key: [deck.ref(key, n) for n in having[key] if n in there] for key in alike}
    elif not all(plate.label and called_alike(plate, plates[0]) for plate in plates[1:]):
        return
    for wells in meant.values():
        yield Clue(
            Strength.COMMENT,
            part.words,
            tuple(wells),
            line,
            f"'{shortened(part.text)}' at line {line}",
            subject=False,
        )


def _is_mostly_filled(deck: Deck, wells: Sequence[WellRef]) -> bool:
    """Whether the run fills half of these wells at least, of those that it uses; not of a trough,
    into which goes waste.
    """
    if in_trough(deck.trace, *{ref.labware for ref in wells}):
        return False
    used = [(ref.labware, ref.name) for ref in wells if (ref.labware, ref.name) in deck.refs]
    return bool(used) and 2 * sum(place in deck.received for place in used) >= len(used)


def _goes_there(part: Part, common: Common) -> bool:
    """Whether a part says what goes into its wells: "diluent to columns 2-12"."""
    before = part.text[: part.text.find(part.wells[0].group())].split()
    return bool(before) and before[-1].lower() in common.toward


def _across(part: Part, said: str, wells: Sequence[WellRef], common: Common) -> tuple[float, ...]:
    """Levels that a part gives column by column or row by row: one for each, or a direction;
    or one for each well of a range along one row or one column.
    """
    axis, listed = axis_of(part), listed_levels(said)
    direction = direction_in(said, common)
    if len(wells) == len(part.wells) > 2 and not any(match["last"] for match in part.wells):
        # "tubes A1 B1 C1 A2 in rising order": in the order in which they are named.
        return tuple(Rank(direction * at) for at in range(len(wells))) if direction else ()
    if axis is None and len(part.wells) == 1 and part.wells[0]["last"]:
        axis = _axis_along(wells, len(listed))
    at = [] if axis is None else [row_column(ref.name)[axis] for ref in wells]
    if axis is not None and len(set(at)) == 1:  # "row A: blank, 0.1, 0.2 mg/ml": along it
        at = [row_column(ref.name)[1 - axis] for ref in wells]
    places = sorted(set(at))
    if len(places) < 2:
        return ()
    if listed and len(listed) + 1 == len(places) and names_zero(said, common):
        listed = (0.0, *listed)
    if _runs_backwards(part.wells[0].group()):
        places.reverse()  # "col 8..3 = 30 10 3 1 0.3 0.1 uM"
    # Two columns and two numbers may come together for any reason.
    if len(listed) == len(set(listed)) == len(places) > 2:
        return tuple(listed[places.index(place)] for place in at)
    return tuple(Rank(direction * places.index(place)) for place in at) if direction else ()


def _runs_backwards(written: str) -> bool:
    """Whether a range or a list of columns begins with a later one than it ends with."""
    numbers = [int(number) for number in re.findall(r"\d+", written)]
    return len(numbers) > 1 and numbers[0] > numbers[-1]


def _axis_along(wells: Sequence[WellRef], count: int) -> int | None:
    """1 where so many levels are those of the columns of a range of wells, 0 of its rows."""
    rows, columns = (len({row_column(ref.name)[axis] for ref in wells}) for axis in (0, 1))
    if min(rows, columns) == 1:
        return 1 if rows == 1 else 0
    return {columns: 1, rows: 0}.get(count) if rows != columns else None
