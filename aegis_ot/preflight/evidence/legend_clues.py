"""What a legend says of the codes in plate maps and in the keys of dicts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from ..layouts import IN_BRACKETS
from ..text import SourceFacts, legend_of
from .clues import Clue, Strength, shortened

_KEY = re.compile(r"\[(['\"])(.+)\1\]$")


def with_codes_explained(clues: Iterable[Clue], facts: SourceFacts) -> Iterator[Clue]:
    """The clues, with what the code stands for where one is a code: ``layout['V']``, a cell ``V``.

    Where the code is a key, ``DRUGS['V']``, what is said of all in its map is said with it.
    """
    legend = legend_of(facts)
    lone = legend_of(facts, 1)
    for clue in clues:
        told = _told_by_code(clue, legend)
        if told:
            said = f"{clue.said}, where `{told}` stands for '{shortened(legend[told])}'"
            yield replace(clue, text=f"{told} {legend[told]}", said=said)
            continue
        named = clue.strength in (Strength.NAME, Strength.LOOSE_NAME) and not clue.whole
        key = _KEY.search(clue.text)
        in_map = clue.said.startswith("plate map")  # `LAYOUT V` there is the map and its key
        group, code = "", clue.text
        if key:
            group, code = clue.text[: key.start()], key[2]
        elif in_map:
            group, _, code = clue.text.rpartition(" ")
        # Of what is drawn one code alone may be explained: the others are numbers.
        known = {**lone, **legend} if clue.said.startswith(f"`{code}` in the map '") else legend
        meant = known.get(code) or known.get(code.rstrip("0123456789"))  # "U = urine", `U1`
        if not named or not meant or meant == clue.text:
            yield clue
            continue
        said = f"{clue.said}, where `{code}` stands for '{shortened(meant)}'"
        if not group:
            yield clue
        yield replace(clue, text=f"{group} {meant}".strip(), said=said, subject=False)


def _told_by_code(clue: Clue, legend: Mapping[str, str]) -> str:
    """The code that is all a text says of some wells: "A2  S1 (80 uL each)"; ``""`` for more."""
    if clue.strength is not Strength.COMMENT or clue.levels or not legend:
        return ""
    code = IN_BRACKETS.sub(" ", clue.text).partition(",")[0].strip(" :=.")
    numbered = re.fullmatch(r"[^\W\d_]{1,3}\d{1,2}", code)  # "A" may be a row, or a gene
    return code if numbered and legend.get(code, code) != code else ""
