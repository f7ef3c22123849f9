"""What a legend says of the codes in plate maps and in the keys of dicts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from ..text import SourceFacts, legend_of
from .clues import Clue, Strength, shortened

_KEY = re.compile(r"\[(['\"])(.+)\1\]$")


def explained(clues: Iterable[Clue], facts: SourceFacts) -> Iterator[Clue]:
    """For each clue that is a code, ``layout['V']`` or a cell ``V``, what the code stands for."""
    legend = legend_of(facts)
    if not legend:
        return
    for clue in clues:
        if clue.strength not in (Strength.NAME, Strength.LOOSE_NAME) or clue.whole:
            continue
        key = _KEY.search(clue.text)
        in_map = clue.said.startswith("plate map")  # `LAYOUT V` there is the map and its key
        code = key[2] if key else clue.text.rpartition(" ")[2] if in_map else clue.text
        said = legend.get(code) or legend.get(code.rstrip("0123456789"))  # "U = urine", `U1`
        if said and said != clue.text:
            yield replace(
                clue,
                text=said,
                said=f"{clue.said}, where `{code}` stands for '{shortened(said)}'",
                subject=False,
            )
