"""What comments and docstrings say of wells, by name or beside a transfer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, comment_blocks, direction_in, lexicon_of, tokens
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
        for number, written in enumerate(with_rows(text, common).splitlines() or [text]):
            headed = nouns.heading(written)
            of_line = nouns.named(written) or headed
            if of_line and _heads(written, common):
                heading = of_line
            elif not written.strip():
                heading = last = frozenset()
            parts = [part for part in parts_of(written, common) if part.wells]
            own = [nouns.before(part) for part in parts]
            for at, (part, before) in enumerate(zip(parts, own, strict=True)):
                last = before or last
                if len(part.text) > _LONGEST_CLAUSE or not tokens(part.words):
                    continue
                keys = (
                    (before if len(before) == 1 else frozenset())
                    or nouns.named(part.text)
                    or before
                    or noted.get(written)
                    or of_line
                    or heading
                    or last
                    or _only_one_with(deck, parts, common)
                )
                # "col 3  1 nM     tube A2": the column is not one of the tubes'.
                others = frozenset[str]().union(*own[at:]).difference(*own[: at + 1])
                placed = 1 in (len(headed), len(before))
                for clue in _spoken(deck, part, line + number, keys - others, others, common):
                    yield replace(clue, placed=placed)


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
    having = {
        info.key: named
        for info in deck.plates()
        if info.key not in others
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
            levels=_across(part, wells, common),
        )


def _across(part: Part, wells: Sequence[WellRef], common: Common) -> tuple[float, ...]:
    """Levels that rise or fall from column to column, or from row to row, if it says so."""
    direction, axis = direction_in(part.words, common), _axis(part)
    at = [] if axis is None else [row_column(ref.name)[axis] for ref in wells]
    return tuple(float(direction * place) for place in at) if len(set(at)) > 1 and direction else ()


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
