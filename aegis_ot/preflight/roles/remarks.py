"""What comments and docstrings say of wells, by name or beside a transfer."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, lexicon_of, tokens
from ..trace import Trace
from .clauses import Part, parts_of
from .clues import Clue, Strength, shortened
from .deck import Deck
from .labware_nouns import LabwareNouns
from .replicates import called_alike
from .well_names import WellNames, well_names


def written_wells(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Well names in comments and docstrings: "A1-A8: samples", "NTC in H12"."""
    texts = list(facts.docstrings)
    texts += _blocks(facts)
    texts += [(1, text) for text in facts.metadata.values()]
    nouns = LabwareNouns(deck, common)
    names = well_names(common)
    noted = {note: nouns.of_name(name) for name, note in facts.notes.items()}
    for line, text in texts:
        heading: frozenset[str] = frozenset()
        last: frozenset[str] = frozenset()
        for number, written in enumerate(text.splitlines() or [text]):
            of_line = nouns.named(written) or nouns.heading(written)
            if of_line and _heads(written, common):
                heading = of_line
            elif not written.strip():
                heading = last = frozenset()
            for part in parts_of(written, common):
                if not part.wells or len(part.text) > _LONGEST_CLAUSE or not tokens(part.words):
                    continue
                before = nouns.before(part)
                last = before or last
                keys = (
                    nouns.named(part.text)
                    or before
                    or noted.get(written)
                    or of_line
                    or heading
                    or last
                )
                yield from _spoken(deck, part, line + number, keys, names)


def _blocks(facts: SourceFacts) -> list[tuple[int, str]]:
    """Comments by their first line; those that stand below each other are one text."""
    blocks: dict[int, list[str]] = {}
    first = 0
    for line, text in sorted(facts.comments.items()):
        if line in facts.own_line and line - 1 in facts.own_line:
            blocks[first].append(text)
        else:
            first = line
            blocks[first] = [text]
    return [(line, "\n".join(texts)) for line, texts in blocks.items()]


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

_LEFT_OUT = 2
"""As many wells of those that prose names may have been left out by mistake."""


def _spoken(
    deck: Deck, part: Part, line: int, keys: frozenset[str], names: WellNames
) -> Iterator[Clue]:
    meant: dict[str, list[WellRef]] = {}
    # "Column 2 = vehicle" may leave out the rows at the edge; "A2-H2" and "all 8" do not.
    ranges = any(match["last"] for match in part.wells)
    outright = ranges or _ALL.search(part.words) or all(match["first"] for match in part.wells)
    having = {
        info.key: named
        for info in deck.plates()
        if (named := [name for match in part.wells for name in names.meant(match, info)])
    }
    if not keys.isdisjoint(having):  # else it names that labware in passing
        having = {key: named for key, named in having.items() if key in keys}
    for key, named in having.items():
        used = [name for name in named if (key, name) in deck.refs]
        if outright and 0 < len(named) - len(used) <= min(_LEFT_OUT, len(used) // 3):
            used = named  # more than a few are wells for which there is nothing this time
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
