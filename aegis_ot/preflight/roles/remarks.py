"""What comments and docstrings say of wells, by name or beside a transfer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, comment_blocks, direction_in, lexicon_of, listed_levels, tokens
from ..trace import Trace, row_column
from .clauses import Part, parts_of
from .clues import Clue, Strength, shortened
from .deck import LEFT_OUT, Deck
from .ellipses import with_rows
from .labware_nouns import LabwareNouns
from .replicates import called_alike
from .well_names import well_names


def written_wells(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Well names in comments and docstrings: "A1-A8: samples", "NTC in H12"."""
    texts = list(facts.docstrings)
    texts += comment_blocks(facts)
    texts += [(1, text) for text in facts.metadata.values()]
    nouns = LabwareNouns(deck, common)
    noted = {note: nouns.of_name(name) for name, note in facts.notes.items()}
    for line, text in texts:
        heading: frozenset[str] = frozenset()
        last: frozenset[str] = frozenset()
        lines = _whole_lines(with_rows(text, common).splitlines() or [text], common)
        for number, written in lines:
            headed = nouns.heading(written)
            of_line = nouns.named(written) or headed
            begun, colon, _ = written.partition(":")
            if colon and len(tokens(begun)) <= _LONGEST_HEADING and nouns.named(begun):
                heading = nouns.named(begun)  # and of the lines below: "strips: column 1 blank"
            elif of_line and _heads(written, common):
                heading = of_line
            elif not written.strip():
                heading = last = frozenset()
            parts, more = _with_what_follows(written, common)
            own = [nouns.before(part) for part in parts]
            if colon and not of_line and parts and _is_headed(parts[0], begun):
                heading = last = frozenset()  # "cells: column 1 ..." goes on with something else
            in_line: frozenset[str] = frozenset()
            for at, (part, before) in enumerate(zip(parts, own, strict=True)):
                last, in_line = before or last, before or in_line
                if nouns.heading(part.text):  # "drug plate: A1 vehicle" is no drug
                    part = part._replace(words=part.words.partition(":")[2])
                if len(part.text) > _LONGEST_CLAUSE or not tokens(part.words):
                    continue
                keys = (
                    (before if len(before) == 1 else frozenset())
                    or nouns.named(part.text)
                    or before
                    or noted.get(written)
                    or (in_line if len(in_line) == 1 else frozenset())
                    or of_line
                    or heading
                    or last
                    or _only_one_with(deck, parts, common)
                )
                # "col 3  1 nM     tube A2": the column is not one of the tubes'.
                others = frozenset[str]().union(*own[at:]).difference(*own[: at + 1])
                placed = 1 in (len(headed), len(in_line))
                for clue in _spoken(deck, part, line + number, keys - others, others, common):
                    levels = _across(part, f"{part.words}, {more[at]}", clue.wells, common)
                    if heading and keys.isdisjoint(heading):
                        levels = ()  # named by what its wells hold, perhaps
                    yield replace(clue, placed=placed, levels=levels)


def _is_headed(part: Part, begun: str) -> bool:
    """Whether a line has a heading without wells of its own before its first columns."""
    return 0 < len(tokens(begun)) <= _LONGEST_HEADING and (
        part.text.strip().startswith(begun.strip())
        and _axis(part) == 1
        and part.text.find(part.wells[0].group()) > len(begun.strip())
    )


def _whole_lines(lines: Sequence[str], common: Common) -> Iterator[tuple[int, str]]:
    """Lines by number; one that ends with "in" or the like goes on in the next."""
    leading = {w for phrase in (*common.joints, *common.toward) for w in tokens(phrase)}
    begun, first = "", 0
    for number, line in enumerate(lines):
        first = first if begun else number
        begun = f"{begun} {line.strip()}" if begun else line
        last = begun.rstrip().rpartition(" ")[2].lower()
        if last not in leading or number + 1 == len(lines):
            yield first, begun
            begun = ""


def _with_what_follows(line: str, common: Common) -> tuple[list[Part], list[str]]:
    """The parts of a line that name wells, and for each what follows without wells of its own."""
    parts: list[Part] = []
    more: list[str] = []
    for part in parts_of(line, common):
        if part.wells:
            parts.append(part)
            more.append("")
        elif more:
            more[-1] += f" {part.words}"
    return parts, more


def _only_one_with(deck: Deck, parts: Sequence[Part], common: Common) -> frozenset[str]:
    """The one labware that all entries of a line can speak of: "A1 vehicle, A2 low, A3 high"."""
    names = well_names(common)
    fitting = [
        info.key
        for info in deck.plates()
        if all(
            any((info.key, name) in deck.refs for name in names.meant(match, info))
            for part in parts
            for match in part.wells
        )
    ]
    return frozenset(fitting) if len(fitting) == 1 else frozenset()


_LONGEST_HEADING = 6


def _heads(line: str, common: Common) -> bool:
    """Whether a line says which labware the next ones speak of: "rack in slot 5"."""
    if line.rstrip().endswith(":"):
        return True
    return len(tokens(line)) <= _LONGEST_HEADING and not any(
        p.wells for p in parts_of(line, common)
    )


_LONGEST_CLAUSE = 160

_ALL = re.compile(r"\ball\s+\d", re.IGNORECASE)


def _spoken(
    deck: Deck,
    part: Part,
    line: int,
    keys: frozenset[str],
    others: frozenset[str],
    common: Common,
) -> Iterator[Clue]:
    names = well_names(common)
    meant: dict[str, list[WellRef]] = {}
    # "Column 2 = vehicle" may leave out the rows at the edge, if all of the plate does; "A2-H2"
    # and "all 8" do not.
    ranges = any(match["last"] for match in part.wells)
    outright = ranges or _ALL.search(part.words) or all(match["first"] for match in part.wells)
    axis = _axis(part)
    filled = {key for key, _ in deck.received} if _goes_there(part, common) else None
    having = {
        info.key: named
        for info in deck.plates()
        if info.key not in others
        and (filled is None or info.key in filled)
        and (named := [name for match in part.wells for name in names.meant(match, info)])
    }
    if not keys.isdisjoint(having):  # else it names that labware in passing
        having = {key: named for key, named in having.items() if key in keys}
    for key, named in having.items():
        used = [name for name in named if (key, name) in deck.refs]
        if outright and 0 < len(named) - len(used) <= min(LEFT_OUT, len(used) // 3):
            used = named  # more than a few are wells for which there is nothing this time
        elif axis is not None:
            used += deck.passed_over(key, named, axis)
        if used:
            meant[key] = [deck.ref(key, name) for name in used]
    if len(meant) > 1:
        # Of several labware that have such wells it speaks of the one that is filled in the run.
        meant = {
            key: wells
            for key, wells in meant.items()
            if all(
                (key, ref.name) in deck.received for ref in wells if (key, ref.name) in deck.refs
            )
        }
    plates = [deck.trace.labware[key] for key in meant]
    if not all(plate.label and called_alike(plate, plates[0]) for plate in plates[1:]):
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


def _goes_there(part: Part, common: Common) -> bool:
    """Whether a part says what goes into its wells: "diluent to columns 2-12"."""
    before = part.text[: part.text.find(part.wells[0].group())].split()
    return bool(before) and before[-1].lower() in common.toward


def _across(part: Part, said: str, wells: Sequence[WellRef], common: Common) -> tuple[float, ...]:
    """Levels that a part gives column by column or row by row: one for each, or a direction."""
    axis = _axis(part)
    at = [] if axis is None else [row_column(ref.name)[axis] for ref in wells]
    places = sorted(set(at))
    if len(places) < 2:
        return ()
    listed = listed_levels(said)
    # Two columns and two numbers may come together for any reason.
    if len(listed) == len(set(listed)) == len(places) > 2:
        return tuple(listed[places.index(place)] for place in at)
    direction = direction_in(said, common)
    return tuple(float(direction * place) for place in at) if direction else ()


def _axis(part: Part) -> int | None:
    """1 where a part names nothing but columns, 0 where nothing but rows."""
    for axis, kinds in ((1, ("column", "columns")), (0, ("row", "rows"))):
        if all(any(match[kind] for kind in kinds) for match in part.wells):
            return axis
    return None


_LONGEST_STEP_COMMENT = 14


def step_comments(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Comments beside or right above a transfer: "# distribute diluent".

    They name what is drawn, if they name one thing only; short ones with nothing else in them
    may name a single destination ("# NTC").
    """
    beside = _comment_of_line(facts)
    unsaid = lexicon_of({"not": common.negations})
    drawn: dict[str, dict[WellRef, None]] = {}
    given: dict[str, dict[WellRef, None]] = {}
    at_line: dict[str, int] = {}
    for visit in trace.visits:
        if visit.mixing:
            continue
        for line in visit.lines:
            text = beside.get(line)
            if text is None:
                continue
            at_line[text] = line
            if visit.kind is OperationKind.ASPIRATE:
                drawn.setdefault(text, {})[visit.well.ref] = None
            elif visit.parts:
                given.setdefault(text, {})[visit.well.ref] = None
            break
    for text, line in at_line.items():
        count = len(tokens(text))
        if count > _LONGEST_STEP_COMMENT or unsaid.find(text) or _is_layout(text, common):
            continue
        said = f"comment '{shortened(text)}' at line {line}"
        sources = tuple(ref for ref in drawn.get(text, ()) if ref not in given.get(text, ()))
        if sources:
            yield Clue(Strength.COMMENT, text, sources, line, said, subject=False, step="source")
        into = tuple(given.get(text, ()))
        if into and count <= _LONGEST_STEP_COMMENT // 2 and len(into) <= 8:
            yield Clue(
                Strength.COMMENT,
                text,
                into,
                line,
                said,
                subject=False,
                step="destination",
                lone=True,
            )


def _is_layout(text: str, common: Common) -> bool:
    """Whether a comment lists wells of several kinds rather than say what is done next."""
    return sum(bool(part.wells) for part in parts_of(text, common)) > 1


def _comment_of_line(facts: SourceFacts) -> dict[int, str]:
    """The comment that speaks of each line: beside it, or right above its block."""
    found: dict[int, str] = {}
    for line, text in facts.comments.items():
        if line not in facts.own_line:
            found[line] = text
    for line in sorted(facts.own_line):
        below = line + 1
        if below in facts.own_line:
            continue
        text = facts.comments[line]
        first = line
        while first - 1 in facts.own_line:
            first -= 1
            text = f"{facts.comments[first]} {text}"
        for covered in facts.blocks.get(below, (below,)):
            found.setdefault(covered, text)
    return found
