"""Lines below a reservoir's heading, which number its troughs: "1 .... vehicle", "well 3: dye"."""

from __future__ import annotations

import re

from ...instrumentation import LabwareInfo
from ..rules import Common
from ..text import any_of, tokens
from .deck import Deck
from .labware_nouns import LabwareNouns
from .well_names import WellNames, well_names


def with_troughs(text: str, deck: Deck, nouns: LabwareNouns, common: Common) -> str:
    """A text with "A1" for the troughs that it numbers on the line that names their reservoir's
    slot, and on the deeper ones below that.
    """
    read: _Numbers | None = None
    told: list[str] = []
    depth, in_deck = 0, False
    for line in text.split("\n"):
        in_deck = nouns.is_of_deck_list(line, in_deck)
        standing, indent = nouns.standing(line, in_deck), len(line) - len(line.lstrip())
        if standing is not None:
            info = deck.trace.labware.get(nouns.in_slot(standing.slot) or "")
            read = _Numbers(info, well_names(common), common) if _is_reservoir(info) else None
            depth = indent
            told.append(read.called(line) if read else line)
            continue
        if _is_heading(line) and _is_reservoir(info := _only(deck, nouns.of_kinds_in(line))):
            read, depth = _Numbers(info, well_names(common), common), indent - 1
        elif read and (not line.strip() or indent <= depth):
            read = None
        told.append(read.listed(read.called(line)) if read else line)
    return "\n".join(told)


def _is_heading(line: str) -> bool:
    """Whether a line is no more than a few words without a number: "== Trough ==", "Reservoir:"."""
    words = tokens(line)
    return 0 < len(words) <= _LONGEST_HEADING and not any(map(str.isdecimal, words))


_LONGEST_HEADING = 3


def _only(deck: Deck, keys: frozenset[str]) -> LabwareInfo | None:
    return deck.trace.labware[next(iter(keys))] if len(keys) == 1 else None


def _is_reservoir(info: LabwareInfo | None) -> bool:
    """Whether labware has several troughs in one row."""
    return (
        info is not None
        and info.centers_channels
        and len(info.wells) > 1
        and all(name[0] == "A" for name in info.wells)
    )


class _Numbers:
    """The numbers of one reservoir's troughs."""

    def __init__(self, info: LabwareInfo | None, names: WellNames, common: Common) -> None:
        self._count = len(info.wells) if info else 0
        words = any_of(common.layout.get("trough", ()))
        one = rf"\d{{1,2}}(?:{names.to}\d{{1,2}})?"
        called = rf"(?i:\b(?:{words})s?)\.?\s*"
        self._called = re.compile(rf"{called}(?P<all>{one}(?:{names.conjunction}{one})*)(?![\w.])")
        self._first = re.compile(r"(?P<before>\s*(?:[-*•]\s+)?)(?P<all>\d{1,2})(?=[:=]?\s+[^\W\d])")
        self._further = re.compile(r"(?P<before>\s{3,}|[;|]\s*)(?P<all>\d{1,2})(?=[:=]?\s+[^\W\d])")

    def called(self, line: str) -> str:
        """A line with names for "troughs 1 and 2"."""
        return self._called.sub(self._named, line)

    def listed(self, line: str) -> str:
        """A line with names for the numbers of a list: "1 vehicle     3 drug"."""
        if self._first.match(line) is None:
            return line
        line = self._first.sub(self._named, line, count=1)
        return self._further.sub(self._named, line)

    def _named(self, match: re.Match[str]) -> str:
        numbers = re.findall(r"\d+", match["all"])
        if any(not 1 <= int(number) <= self._count for number in numbers):
            return match[0]
        return match.groupdict().get("before", "") + re.sub(r"(\d+)", r"A\1", match["all"])
