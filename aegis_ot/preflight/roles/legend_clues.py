"""What a legend says of the codes in plate maps and in the keys of dicts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from ..text import SourceFacts, legend_of
from .clues import Clue, Strength, shortened

_KEY = re.compile(r"\[(['\"])(.+)\1\]$")


def with_codes_explained(clues: Iterable[Clue], facts: SourceFacts) -> Iterator[Clue]:
    """The clues, with what the code stands for where one is a code: ``layout['V']``, a cell ``V``.

    Where the code is a key, ``DRUGS['V']``, what is said of all in its map is said with it.
    """
    legend = legend_of(facts)
    for clue in clues:
        named = clue.strength in (Strength.NAME, Strength.LOOSE_NAME) and not clue.whole
        key = _KEY.search(clue.text)
        in_map = clue.said.startswith("plate map")  # `LAYOUT V` there is the map and its key
        group, code = "", clue.text
        if key:
            group, code = clue.text[: key.start()], key[2]
        elif in_map:
            group, _, code = clue.text.rpartition(" ")
        meant = legend.get(code) or legend.get(code.rstrip("0123456789"))  # "U = urine", `U1`
        if not named or not meant or meant == clue.text:
            yield clue
            continue
        said = f"{clue.said}, where `{code}` stands for '{shortened(meant)}'"
        if not group:
            yield clue
        yield replace(clue, text=f"{group} {meant}".strip(), said=said, subject=False)
