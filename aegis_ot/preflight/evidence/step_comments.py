"""What comments beside a transfer, or right above it, say of the wells that it uses."""

from __future__ import annotations

from collections.abc import Iterator

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..layouts import parts_of
from ..rules import Common
from ..text import SourceFacts, lexicon_of, tokens
from ..trace import Trace
from .clues import Clue, Strength, shortened

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
