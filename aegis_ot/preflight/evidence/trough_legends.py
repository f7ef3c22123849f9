"""Legends of reservoirs by number: "1 sample buffer, 2 TMB substrate", "dye in trough 3"."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from itertools import pairwise

from ...instrumentation import LabwareInfo
from ..layouts import IN_BRACKETS, Deck
from ..rules import Common
from ..text import SourceFacts, any_of, comment_blocks, tokens, words_of
from .clues import Clue, Strength, shortened

_ENTRY = re.compile(
    r"(?:^|[,;/|])\s*#?(\d{1,2})(?!\w)\s*(?:[:=.)]|->|[-–](?=\s))?\s*"
    r"([^\W\d][^,;/|]{2,40}?)(?=\s*(?:[,;/|]|$))"
)
_FEWEST = 3
"""So many numbers in order are a legend; fewer may be amounts."""


_EQUATION = re.compile(r"(?:^|[,;/|])\s*(\d{1,2})\s*=\s*([^\W\d][^,;|=]{1,60})(?=[,;/|]|$)")
"""An entry of "12 channels: 1 = dye, 13 mL, 2 = buffer"."""


def trough_legends(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What a comment or docstring that speaks of a reservoir says of its troughs in turn.

    It is as exact as a plate map, and so as strong; it beats a name that holds several troughs.
    """
    troughs = [
        info for info in deck.plates() if info.centers_channels and 1 < len(info.wells) <= 24
    ]
    if len(troughs) != 1:
        return
    words = words_of(common.labware.get("reservoir", ()))
    words |= set(tokens(troughs[0].label)) & set(tokens(troughs[0].load_name))
    called = {
        word for kind in ("trough", "column", "columns") for word in common.layout.get(kind, ())
    }
    any_called = any_of(called)
    number_of = re.compile(rf"(?im)((?:^|[,;/|])\s*)(?:{any_called})\.?\s*(?=\d)")
    numbered = set(common.layout.get("trough", ())).difference(common.places, common.positions)
    for line, text in _blocks(facts):
        yield from _told_alone(deck, troughs[0], line, text, numbered)
        # In a list of what is on the deck the reservoir is an entry itself.
        entries = (said for written in text.splitlines() for _, said in _ENTRY.findall(written))
        in_entries = {word for said in entries for word in tokens(said)}
        if not words.isdisjoint(tokens(text)) and words.isdisjoint(in_entries):
            yield from _legend(deck, troughs[0], line, number_of.sub(r"\1", text))


_LONGEST_NAME = 5
"""Words; more are a sentence."""


def _told_alone(
    deck: Deck, trough: LabwareInfo, line: int, text: str, called: Collection[str]
) -> Iterator[Clue]:
    """What a text says to be "in trough 3", or "channel 3" to be."""
    if not called:
        return
    word = any_of(called)
    before = (
        rf"([^.,;:\n|]{{2,60}}?) (?:in|en|im|dans|nel) (?:the )?(?:{word}) ?(\d{{1,2}})(?![\w-])"
    )
    after = rf"(?:{word}) ?(\d{{1,2}})(?: ?(?:[:=]|->|→) ?|\s{{2,}})([^\W\d][^.,;:\n|]{{1,60}})"
    headed = rf"(?i:{word})[^\W\d_]{{0,2}}: ?(\d{{1,2}} ?= ?[^\n]+)"
    found = [(match[2], match[1]) for match in re.finditer(before, text, re.IGNORECASE)]
    found += [(match[1], match[2]) for match in re.finditer(after, text, re.IGNORECASE)]
    found += [entry for listed in re.findall(headed, text) for entry in _EQUATION.findall(listed)]
    found += [entry for entry in _line_by_line(text, word) if entry[0] not in dict(found)]
    names = list(trough.wells)
    for number, said in found:
        short = len(tokens(IN_BRACKETS.sub(" ", said))) <= _LONGEST_NAME
        if 0 < int(number) <= len(names) and short:
            ref = deck.ref(trough.key, names[int(number) - 1])
            told = f"'{shortened(said)}' in trough {number}, by the text at line {line}"
            yield Clue(Strength.COMMENT, said, (ref,), line, told, subject=False)


def _line_by_line(text: str, word: str) -> list[tuple[str, str]]:
    """Lines that begin with troughs in rising order, gaps among them: "channel 12 dye, 14 mL"."""
    entry = re.compile(rf"\W*(?:{word}) ?(\d{{1,2}})(?!\w)[ :=.]*([^\W\d][^.,;:\n|]{{1,60}})", re.I)
    lines = [match for written in text.splitlines() if (match := entry.match(written))]
    numbers = [int(match[1]) for match in lines]
    rising = all(one < other for one, other in pairwise(numbers))
    return [(match[1], match[2]) for match in lines] if rising and len(lines) > 1 else []


def _blocks(facts: SourceFacts) -> Iterator[tuple[int, str]]:
    """Docstrings by paragraph, and comments together with those right above."""
    for line, text in facts.docstrings:
        for part in re.split(r"\n\s*\n", text):
            yield line, part
    yield from comment_blocks(facts)


def _legend(deck: Deck, trough: LabwareInfo, line: int, text: str) -> Iterator[Clue]:
    entries: list[tuple[int, str]] = []
    for written in text.splitlines():
        # After a heading: "Reservoir: 1 buffer, 2 substrate".
        said = re.sub(r"^[^\d,;]*:\s*(?=\d)", "", written)
        entries += [(int(number), words) for number, words in _ENTRY.findall(said)]
    numbers = [number for number, _ in entries]
    rising = all(one < other for one, other in pairwise(numbers))
    if len(entries) < _FEWEST or not rising or numbers[-1] > len(trough.wells):
        return
    names = list(trough.wells)
    for number, words in entries:
        yield Clue(
            Strength.NAME,
            words,
            (deck.ref(trough.key, names[number - 1]),),
            line,
            f"'{number} {shortened(words)}' in the legend at line {line}",
        )
