"""What comments and docstrings say of wells by name."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from ...vocabulary import WellRef
from ..layouts import (
    Amount,
    Deck,
    LabwareNouns,
    Part,
    Topic,
    axis_of,
    items_after,
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
    listed_levels,
    tokens,
)
from ..trace import row_column
from .bare_numbers import with_bare_numbers
from .clues import Clue, Strength, shortened
from .levels import names_zero
from .meant_wells import Meant, goes_there, wells_meant
from .spoken import laid_out_in_the_run
from .twins import said_to_be_twins


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
            meant = Meant(keys - others, bool(firm) or topic.places(keys), others, twins)
            said = f"{part.text}, {more[at]}"
            clues = [
                _clue(part, wells, line + number)
                for wells in wells_meant(deck, part, said, meant, common)
            ]
            placed = topic.places(keys)
            if goes_there(part, common):
                topic.next_part(frozenset(ref.labware for clue in clues for ref in clue.wells))
            for clue in clues:
                levels = _across(part, f"{part.words}, {more[at]}", clue.wells, common)
                if topic.heading and keys.isdisjoint(topic.heading):
                    levels = ()  # named by what its wells hold, perhaps
                clue = replace(clue, placed=placed, levels=levels)
                yield from _one_by_one(part, said, clue, common) or [clue]


def _clue(part: Part, wells: Sequence[WellRef], line: int) -> Clue:
    said = f"'{shortened(part.text)}' at line {line}"
    return Clue(Strength.COMMENT, part.words, tuple(wells), line, said, subject=False)


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
