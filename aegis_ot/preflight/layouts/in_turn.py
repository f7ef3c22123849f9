"""Spells out lists that go with places in turn: "columns 1-3: untreated, vehicle, drug"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..rules import Common
from ..text import first_words, tokens
from .well_names import WellNames, well_names, wells_between

_FEWEST = 3
"""Of two things after two wells, the second may only say more about the first."""

_LONGEST_ITEM = 4
"""Words; more are a sentence."""

_LIST = re.compile(r"\s*(?::|=|->|=>|→)\s*(?P<items>[^;:=\n]+?)\s*(?=$|[;\n]|\.(?!\d))")
_ASIDE = re.compile(r"^\s*,?\s*\(?\d+x\)?")
"""Of what strength they all are: ", 100x"."""
_COMMA = re.compile(r"\s*,\s*(?![^()]*\))")
_BRACKETS = re.compile(r"\([^()]*\)")
_SLASH = re.compile(r"\s+/\s+")


def in_turn(text: str, common: Common) -> str:
    """The text with each place before its item: "column 1: untreated, column 2: vehicle, ...".

    Where as many items follow as places, and each is more than a number.
    """
    names = well_names(common)
    for start, end, places in reversed([*_lists(text, names)]):
        match = _LIST.match(text, end)
        if match and (items := _items(match["items"], len(places), names, common)):
            entries = ", ".join(f"{at}: {item}" for at, item in zip(places, items, strict=True))
            text = text[:start] + entries + text[match.end() :]
    return text


def items_after(text: str, end: int, count: int, common: Common) -> list[str]:
    """As many items as wells of a row or column, in the list that follows it; else none."""
    names = well_names(common)
    match = _LIST.match(_ASIDE.sub("", text[end:], count=1))
    if match is None or count < _FEWEST:
        return []
    return _items(match["items"], count, names, common)


def _lists(text: str, names: WellNames) -> Iterator[tuple[int, int, list[str]]]:
    """Start, end and places of each list of wells, columns or rows: of "A1, A2 and A3"."""
    start, end, places = 0, 0, list[str]()
    for match in names.spec.finditer(text):
        if places and not names.between.fullmatch(text, end, match.start()):
            if len(places) >= _FEWEST:
                yield start, end, places
            places = []
        start = start if places else match.start()
        end = match.end()
        places += _places(match, names)
    if len(places) >= _FEWEST:
        yield start, end, places


def _places(match: re.Match[str], names: WellNames) -> list[str]:
    """Each well, column or row that a match of ``names.spec`` stands for, as one would write it."""
    if match["first"]:
        last = match["last"]
        return list(wells_between(f"{match['first']}-{last}") if last else [match["first"]])
    listed = match["columns"] or match["column"]
    word = names.first_word_of["column" if listed else "row"]
    return [f"{word} {place}" for place in names.numbers(listed or match["rows"] or match["row"])]


def _items(listed: str, count: int, names: WellNames, common: Common) -> list[str]:
    """The items of a list of so many that each say what is there; of any other list, none."""
    if names.spec.search(listed):
        return []
    items = _COMMA.split(listed)
    if len(items) == 1:
        items = _SLASH.split(listed)
    if len(items) == count - 1:  # "untreated, vehicle and drug"
        items[-1:] = re.split(names.conjunction, items[-1], maxsplit=1)
    return items if len(items) == count and _tell(items, common) else []


def _tell(items: Sequence[str], common: Common) -> bool:
    """Whether each says what is there, more than a number, and none goes on about the others:
    "drug in triplicate, vehicle last, fresh tips".
    """
    further = _further(common)
    bare = [_BRACKETS.sub(" ", item) for item in items]
    return all(
        re.search(r"[^\W\d]", item)
        and len(item.split()) <= _LONGEST_ITEM
        and further.isdisjoint(tokens(item))
        for item in bare
    )


def _further(common: Common) -> set[str]:
    """Words with which a sentence goes on, rather than name one more thing."""
    phrases = (
        *common.joints,
        *common.toward,
        *common.partly,
        *common.negations,
        *common.tips,
        *common.handling,
        *common.replicates,
        *common.articles,
        *common.giving,
        *common.places,
    )
    return {word for word in first_words(phrases) if len(word) > 1} - first_words(common.controls)
