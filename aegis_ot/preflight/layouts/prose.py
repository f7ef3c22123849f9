"""Sentences of running text, whose lines end anywhere; lists and tables keep their lines."""

from __future__ import annotations

import functools
import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import accumulate, groupby, pairwise

from ..rules import Common
from ..text import first_words, tokens
from .well_names import well_names

_SHORTEST_LINE = 40
"""Characters; a shorter line that is not the last one ends where its writer meant it to."""

_DEEPEST_INDENT = 4
"""Characters; what stands deeper is set below something."""

_ARRANGED = re.compile(r"\S(?<![.!?])\s{2,}\S|[|\t]|\.{3,}|->|=>")
"""What columns are set apart with."""

_ITEM = re.compile(r"\s*(?:[-*•#>+]|\(?\d{1,2}(?:\.\d{1,2})*[.)]\s|[A-Za-z][.)]\s)")
_DEFINES = re.compile(r"\s*[^\s:=,.]+(?: [^\s:=,.]+){0,5}\s?[:=](?=\s|$)")
_SHORT_WORD = re.compile(r"\b[a-z]{1,3}$")


def in_sentences(lines: Sequence[str], common: Common) -> Iterator[tuple[int, list[str]]]:
    """Lines by number, in blocks: each sentence of running text is one line of its own.

    Yields:
        The number of a block's first line, and its lines: a sentence, or all others in turn.
    """
    numbered, ends = enumerate(lines), _sentence_ends(common.abbreviations)
    for blank, group in groupby(numbered, key=lambda item: not item[1].strip()):
        paragraph = list(group)
        first, written = paragraph[0][0], [line for _, line in paragraph]
        if blank or not _is_prose(written):
            yield first, written
        else:
            yield from ((first + at, [said]) for at, said in _sentences(written, ends))


@functools.lru_cache(maxsize=8)
def _sentence_ends(abbreviations: tuple[str, ...]) -> re.Pattern[str]:
    """What stands between two sentences; the dot of an abbreviation, or of "A.", ends none."""
    short = "".join(rf"(?<!\b{re.escape(word)}\.)" for word in abbreviations)
    return re.compile(rf"(?<=[.!?])(?<!\b[A-Za-z]\.){short}\s+(?=[A-Z\"“(])")


def _is_prose(lines: Sequence[str]) -> bool:
    """Whether a paragraph is running text, with sentences that go on in the next line."""
    if len(lines) < 2 or any(len(line.strip()) < _SHORTEST_LINE for line in lines[:-1]):
        return False
    if any(_ARRANGED.search(line.strip()) or _ITEM.match(line) for line in lines):
        return False
    if any(map(_DEFINES.match, lines[1:])):
        return False
    first, *indents = (len(line) - len(line.lstrip()) for line in lines)
    straight = len(set(indents)) == 1 and abs(indents[0] - first) <= _DEEPEST_INDENT
    ends = [(one.rstrip(), other.lstrip()) for one, other in pairwise(lines)]
    flowing = sum(
        (other[:1].islower() and one[-1] not in ".:;") or bool(_SHORT_WORD.search(one))
        for one, other in ends
    )
    ended = sum(one[-1] in ".!?" and not other[:1].islower() for one, other in ends)
    broken = len(ends) - flowing - ended
    whole = not broken or lines[-1].rstrip()[-1] in ".!?"
    return straight and whole and flowing > 0 and flowing >= 2 * broken


def _sentences(lines: Sequence[str], ends: re.Pattern[str]) -> Iterator[tuple[int, str]]:
    """The sentences of some lines, each with the number of the line that it begins in."""
    starts = [0, *accumulate(len(line.strip()) + 1 for line in lines)]
    text, at = " ".join(line.strip() for line in lines), 0
    indent = lines[0][: len(lines[0]) - len(lines[0].lstrip())]
    for said in ends.split(text):
        at = text.find(said, at)
        yield bisect_right(starts, at) - 1, indent + said
        at += len(said)


def statements(said: str, common: Common) -> Iterator[str]:
    """A sentence, cut where a colon ends one: "...: column 1 holds the samples".

    Not behind a heading, "Plate (slot 1): column 1 holds the samples".
    """
    spec, verbs = well_names(common).spec, first_words(common.holding)
    begun = 0
    for colon in _COLON.finditer(said):
        wells = spec.match(said, colon.end())
        holds = wells and not verbs.isdisjoint(tokens(said[wells.end() :])[:1])
        if (
            holds
            and len(tokens(_BRACKETS.sub(" ", said[begun : colon.start()]))) > _LONGEST_HEADING
        ):
            yield said[begun : colon.start()]
            begun = colon.end()
    yield said[begun:]


_COLON = re.compile(r":\s+")
_BRACKETS = re.compile(r"\([^()]*\)")
_LONGEST_HEADING = 6
