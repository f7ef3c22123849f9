"""Lists whose lines end with the place: "water, PCR grade ....... B2" is "B2: water"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .well_names import WellNames

_FEWEST = 2
"""One line alone may be anything."""

_SPACED = re.compile(r"\s{3,}")


def with_places_first(lines: Sequence[str], names: WellNames) -> list[str]:
    """Lines of such lists, two at least one below the other, as lines that begin with the place.

    What stands before the last wide gap names no well, and the wells come right behind that.
    """
    turned = [_turned(line, names) for line in lines]
    told: list[str] = []
    for at, line in enumerate(lines):
        beside = any(turned[max(at - 1, 0) : at]) or any(turned[at + 1 : at + _FEWEST])
        told.append((beside and turned[at]) or line)
    return told


def _turned(line: str, names: WellNames) -> str:
    """One line with its place first, or ``""`` where it does not end with one."""
    gaps = list(_SPACED.finditer(line.rstrip()))
    gap = gaps[-1] if gaps else None
    if gap is None or not (said := line[: gap.start()].strip(" -*•")) or names.spec.search(said):
        return ""
    place = names.places.match(line, gap.end())
    rest = line[place.end() :] if place else ""
    if place is None or not any(map(str.isalpha, said)) or names.spec.search(rest):
        return ""
    if rest.strip() and rest.lstrip()[0] not in ",;(":
        return ""  # "samples    A1 wild type"
    indent = line[: len(line) - len(line.lstrip())]
    return f"{indent}{place[0].strip()}: {said}{rest}"
