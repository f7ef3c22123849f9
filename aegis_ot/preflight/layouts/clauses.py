"""Cuts what is written into parts that each speak of wells of their own.

"A1-G1 samples, H1 NTC" has two parts, and so has "soil DNA in columns 1-3 (A1 = water)".
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from ..rules import Common
from ..text import first_words, tokens, words_of
from .ellipses import spelled_out
from .well_names import WellNames, well_names, wells_between

_BREAKS = re.compile(
    r"[;|]|(?<!\.[a-z]{3})(?<!\.)\.\s+(?=[A-Z])|\.\s{2,}(?=\w)|(?:(?<=[)\]])|(?<=[a-z]{5}))\.\s+(?=[a-z])"
    r"|,(?=\s*(?:[a-zA-Z ]{0,20}\b[A-P]\d|\d+(?:st|nd|rd|th)\b|[A-Za-z]{3,}|[A-Za-z]{1,2}\.\s*\d))"
    r"|(?<=\S)\s{3,}(?=(?:[a-z]+\s+)?[A-P]\d{1,2}\b)"
)
_TO_THE_END = re.compile(r"[;|()]|\.\s|\s{3,}")
_BRACKETS = re.compile(r"[(\[]([^()\[\]]*)[)\]]")


_NUMBERED = re.compile(
    r"\b(?P<wells>(?P<first>[A-P]\d{1,2})\s?[-–]\s?(?P<last>[A-P]\d{1,2}))\s+"
    r"(?P<numbers>(?P<letter>[A-P])(?P<low>\d{1,2})\s?[-–]\s?(?P=letter)(?P<high>\d{1,2}))"
    r"(?=\s*(?:[,;.)]|$))"
)
"""Wells, and the numbers of what stands in them: "A1-H1 S1-S8"."""

_LONGEST_LINE = 2000
"""A longer line is data and not prose, and would take for ages."""


class Part(NamedTuple):
    """A part of a text: as written, without its well names, and the matches of these."""

    text: str
    words: str
    wells: tuple[re.Match[str], ...]


def axis_of(part: Part) -> int | None:
    """1 where a part names nothing but columns, 0 where nothing but rows."""
    for axis, kinds in ((1, ("column", "columns")), (0, ("row", "rows"))):
        if all(any(match[kind] for kind in kinds) for match in part.wells):
            return axis
    return None


def parts_of(text: str, common: Common) -> Iterator[Part]:
    """The parts of one line, in order; a part that names no wells has an empty ``wells``."""
    names = well_names(common)
    if len(text) > _LONGEST_LINE:
        yield Part(text, text, ())
        return
    text = _NUMBERED.sub(_without_numbers, spelled_out(text, common))
    if len(text) > _LONGEST_LINE:
        yield Part(text, text, ())
        return
    for clause in _clauses(text, names, first_words(_nouns(common))):
        groups = _groups(clause, names)
        for piece in _shares(clause, groups) if len(groups) > 1 else [clause]:
            wells = _without_codes(piece, _innermost(names.spec.finditer(piece)), names)
            if wells and _is_left_out(piece[: wells[0].start()], common):
                wells = ()  # "PBS everywhere except column 1" says nothing of column 1
            # "column 4 with 10 nM and | column 5 with 1 nM"
            words = names.spec.sub(" ", piece)
            yield Part(piece.strip(), names.and_at_end.sub("", words) if wells else words, wells)


def _without_numbers(match: re.Match[str]) -> str:
    """A range of wells with the numbers of what stands there: "A2-D2 G9-G12" in small letters."""
    wells = wells_between(f"{match['first']}:{match['last']}")
    if not int(match["high"]) - int(match["low"]) + 1 == len(wells) > 1:
        return match[0]
    return f"{match['wells']} {match['numbers'].lower()}"


def with_what_follows(line: str, common: Common) -> tuple[list[Part], list[str]]:
    """The parts of a line that name wells, and for each what follows without wells of its own.

    A thing that follows says what that is: "A1 PBS, the blank" is "PBS (blank)". Not one that comes
    to it: "rows A-D, the controls too".
    """
    parts: list[Part] = []
    more: list[str] = []
    for part in parts_of(line, common):
        if part.wells:
            parts.append(part)
            more.append("")
        elif more:
            first, *words = _BRACKETS.sub(" ", part.words).split() or [""]
            short = 0 < len(words) < _LONGEST_APPOSITION
            short = short and words_of(common.also).isdisjoint(tokens(words[-1])[-1:])
            if short and not more[-1] and first.lower() in first_words(common.articles):
                parts[-1] = parts[-1]._replace(words=f"{parts[-1].words} ({' '.join(words)})")
            more[-1] += f" {part.words}"
    return parts, more


_LONGEST_APPOSITION = 4


def _without_codes(
    piece: str, wells: tuple[re.Match[str], ...], names: WellNames
) -> tuple[re.Match[str], ...]:
    """Without what numbers things by their first letter: "A2-F2 = milk fractions F1-F6".

    Not after a word that joins wells, "A1 and A2"; the first ones only where several things are
    numbered, and it is said where these are: "fractions F1-F6 in column 4".
    """
    named = [
        match
        for at, match in enumerate(wells)
        if (word := _numbered(piece[: match.start()], match))
        and not names.between.fullmatch(word)
        and (at > 0 or (match["last"] and _says_where(piece, wells, names)))
    ]
    return tuple(match for match in wells if match not in named)


def numbers_things(part: Part) -> bool:
    """Whether the first wells of a part may be numbers of what stands before: "fractions F1-F6"."""
    first = part.wells[0]
    return bool(first["last"] and _numbered(part.text.partition(first.group())[0], first))


def _numbered(before: str, match: re.Match[str]) -> str:
    """The last word before some wells if it begins with their letter, or ``""``."""
    word = "".join(tokens(before)[-1:])
    alike = match["first"] and len(word) > 1 and word[0].upper() == match["first"][0]
    return word if alike else ""


def _says_where(piece: str, wells: tuple[re.Match[str], ...], names: WellNames) -> bool:
    """Whether it is said after the first wells where they are: in wells of another letter, or in a
    column or row; more of a list, "D1-D6 and E1-E6", say no such thing.
    """
    if len(wells) < 2 or names.between.fullmatch(piece, wells[0].end(), wells[1].start()):
        return False
    letter = wells[0]["first"][0]
    return any(other["first"] is None or other["first"][0] != letter for other in wells[1:])


def _is_left_out(before: str, common: Common) -> bool:
    """Whether the words before some wells end by leaving them out, or by what else goes along."""
    words = tuple(word for word in tokens(before) if word not in first_words(common.articles))
    left_out = any(words[-len(said) :] == said for said in map(tokens, common.exceptions))
    return left_out and words[-2:-1] != ("nothing",)


def _nouns(common: Common) -> tuple[str, ...]:
    """What people call labware: "tube", and "tubes"."""
    listed = tuple(word for words in common.labware.values() for word in words)
    return listed + tuple(f"{word}s" for word in listed)


def _innermost(matches: Iterable[re.Match[str]]) -> tuple[re.Match[str], ...]:
    """Without a row that only says where the wells after it stand: "row C  C1-C3 vehicle"."""
    found = tuple(matches)
    if not any(match["first"] for match in found):
        return found
    return tuple(
        match
        for match in found
        if not (match["row"] and any((o["first"] or "")[:1] == match["row"] for o in found))
    )


def _clauses(text: str, names: WellNames, nouns: frozenset[str]) -> Iterator[str]:
    """What commas and the like divide; a bracket that says something of wells stands alone."""
    apart = [
        inner
        for inner in _BRACKETS.findall(text)
        if names.spec.search(inner) and not nouns.issuperset(tokens(names.spec.sub(" ", inner)))
        if not _heads_its_row(inner, text, names)
    ]  # "buffer (reservoir A1)" is one
    for inner in apart:
        text = text.replace(f"({inner})", " ").replace(f"[{inner}]", " ")
    for whole in (text, *apart):
        start = 0
        for at in [match.span() for match in _BREAKS.finditer(whole)] + [(len(whole), len(whole))]:
            clause = whole[start : at[0]]
            mark = whole[at[0] : at[0] + 1]
            goes_on = mark not in ("", ".")
            rest = whole[at[1] :]
            listed = _is_list(clause, names, nouns) and not _says_anew(clause, rest, names)
            if mark == ";" and not names.spec.match(rest.lstrip()):
                listed = False  # "columns 1 and 2; fractions from C3 on"
            if goes_on and (listed or _is_open(clause)):
                continue  # "A1, B1 and C1: standards" is one, and "columns 1+2 (blank, standards)"
            if mark == "," and _is_begun(clause, rest, names):
                continue  # "NTCs H3, H6"
            if mark.isspace() and not names.spec.search(clause):
                continue  # "vehicle     A3" is one entry of a layout
            if clause.strip():
                yield clause
            start = at[1]


def _heads_its_row(inner: str, text: str, names: WellNames) -> bool:
    """Whether a bracket says in which row the wells after it are: "(slot 2, row A): A1 ..."."""
    row, after = names.spec.search(inner), text.partition(f"{inner}):")[2]
    first = names.spec.match(after.lstrip())
    return bool(row and row["row"] and first and (first["first"] or "")[:1] == row["row"])


def _is_begun(clause: str, rest: str, names: WellNames) -> bool:
    """Whether wells that end a clause are the first of a list that goes on to the end."""
    groups = _groups(clause, names)
    if not groups or not tokens(clause[: groups[0][0]]) or tokens(clause[groups[-1][1] :]):
        return False
    if names.further.match(rest):
        return True  # "in the tubes A1, A2 and A3 of the rack"
    headed = len(groups) == 1 and clause[: groups[0][0]].rstrip().endswith(":")
    if headed and _is_told_at_the_end(rest, names):
        return True  # "Standards: A1-A4, B1-B4 = 0, 125, 250, ... ug/ml"
    return _is_list(_TO_THE_END.split(rest, maxsplit=1)[0], names, frozenset())


def _is_told_at_the_end(rest: str, names: WellNames) -> bool:
    """Whether more wells follow, and then the numbers that all of them have."""
    first = names.spec.match(rest.lstrip())
    return first is not None and bool(_LEVELS.match(rest.lstrip(), first.end()))


_LEVELS = re.compile(r"\s*=\s*\d+(?:[.,]\d+)?\s*[,;/]")


def _says_anew(clause: str, rest: str, names: WellNames) -> bool:
    """Whether one column or row follows several, by its own word: "columns 1-5, column 6 = NTC"."""
    mentions, first = list(names.spec.finditer(clause)), names.spec.match(rest.lstrip())
    if not mentions or first is None:
        return False
    last = mentions[-1]
    return bool((last["columns"] and first["column"]) or (last["rows"] and first["row"]))


def _is_open(clause: str) -> bool:
    """Whether a bracket is still open at the end of a clause."""
    return sum(clause.count(mark) for mark in "([") > sum(clause.count(mark) for mark in ")]")


def _is_list(clause: str, names: WellNames, nouns: frozenset[str]) -> bool:
    """Whether a clause names wells and nothing else, but for what they stand in: "tubes A1-A6"."""
    groups = _groups(clause, names)
    if len(groups) != 1:
        return False
    return nouns.issuperset(tokens(clause[: groups[0][0]] + clause[groups[0][1] :]))


def _groups(clause: str, names: WellNames) -> list[tuple[int, int]]:
    """Start and end of each list of wells in a clause: of "A1, B1 and C1"."""
    found: list[tuple[int, int]] = []
    for match in _without_codes(clause, _innermost(names.spec.finditer(clause)), names):
        if found and names.between.fullmatch(clause, found[-1][1], match.start()):
            found[-1] = (found[-1][0], match.end())
        else:
            found.append(match.span())
    return found


def _shares(clause: str, groups: Sequence[tuple[int, int]]) -> list[str]:
    """One piece for each list of wells, where it is plain which words go with which."""
    before, after = tokens(clause[: groups[0][0]]), tokens(clause[groups[-1][1] :])
    if after and not before:  # "A1 standards B1 blanks"
        cuts = [start for start, _ in groups[1:]]
    elif before and not after:  # "standards A1 blanks B1"
        cuts = [end for _, end in groups[:-1]]
    else:
        return [clause]
    bounds = [0, *cuts, len(clause)]
    return [clause[one:other] for one, other in pairwise(bounds)]
