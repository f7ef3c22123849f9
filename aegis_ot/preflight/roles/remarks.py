"""What comments and docstrings say of wells, by name or beside a transfer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ...vocabulary import WellRef
from ..rules import Common
from ..text import Lexicon, SourceFacts, tokens
from ..trace import Trace
from .clues import Clue, Strength, shortened
from .deck import Deck
from .well_names import WELL_SPEC, wells_meant


def written_wells(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    """Well names in comments and docstrings: "A1-A8: samples", "NTC in H12"."""
    texts = list(facts.docstrings)
    texts += list(facts.comments.items())
    texts += [(1, text) for text in facts.metadata.values()]
    for line, text in texts:
        for number, written in enumerate(text.splitlines() or [text]):
            for clause in re.split(
                r"[;|]|,(?=\s*(?:[a-zA-Z ]{0,20}\b[A-P]\d|[A-Za-z]{3,}))", written
            ):
                found = list(WELL_SPEC.finditer(clause))
                if not found or len(clause) > 160:
                    continue
                rest = WELL_SPEC.sub(" ", clause)
                if not tokens(rest):
                    continue
                at = line + number
                yield from _spoken(deck, clause, rest, found, at)


def _spoken(
    deck: Deck, clause: str, rest: str, found: Sequence[re.Match[str]], line: int
) -> Iterator[Clue]:
    named = [
        info.key
        for info in deck.plates()
        if info.label and f" {' '.join(tokens(info.label))} " in f" {' '.join(tokens(rest))} "
    ]
    for labware in named if len(named) == 1 else [info.key for info in deck.plates()]:
        info = deck.trace.labware[labware]
        wells: list[WellRef] = []
        for match in found:
            wells.extend(
                deck.ref(labware, name)
                for name in wells_meant(match, info)
                if (labware, name) in deck.refs
            )
        if wells:
            yield Clue(
                Strength.COMMENT,
                rest,
                tuple(wells),
                line,
                f"'{shortened(clause)}' at line {line}",
                subject=False,
            )


_LONGEST_STEP_COMMENT = 14


def step_comments(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Comments beside or right above a transfer: "# distribute diluent".

    They name what is drawn, if they name one thing only; short ones with nothing else in them
    may name a single destination ("# NTC").
    """
    beside = _comment_of_line(facts)
    unsaid = Lexicon({"not": common.negations})
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
            if visit.kind.value == "aspirate":
                drawn.setdefault(text, {})[visit.well.ref] = None
            elif visit.parts:
                given.setdefault(text, {})[visit.well.ref] = None
            break
    for text, line in at_line.items():
        count = len(tokens(text))
        if count > _LONGEST_STEP_COMMENT or unsaid.find(text):
            continue
        said = f"comment '{shortened(text)}' at line {line}"
        sources = tuple(ref for ref in drawn.get(text, ()) if ref not in given.get(text, ()))
        if sources:
            yield Clue(Strength.COMMENT, text, sources, line, said, subject=False, step="source")
        into = tuple(given.get(text, ()))
        if into and count <= _LONGEST_STEP_COMMENT // 2 and len(into) <= 8:
            yield Clue(Strength.COMMENT, text, into, line, said, subject=False, step="destination")


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
