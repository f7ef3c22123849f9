"""What a text says to stand in which slot: "4.2 Dose plate (slot 3, deep-well)", "Slot 5: rack"."""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Collection
from typing import NamedTuple

from ..rules import Common
from ..text import any_of, labware_words, tokens, words_of
from .well_names import SLOT, WellNames, well_names

_LONGEST_LINE = 1000
"""Characters; what is longer lists no deck."""

_LONGEST_NAME = 6
"""So many words may call what stands there; more are a sentence."""

_NUMBERED = r"(?:\(?(?:\d{1,2}(?:\.\d{1,2})*|[A-Za-z])[.)]\s+|\d{1,2}(?:\.\d{1,2})+\s+)?"  # "4.2  "
_LEAD = rf"[\s*#>•–-]*(?:o\s+)?{_NUMBERED}"
_WHAT = r"(?P<what>[\"'“]?[^\W_](?:[^().:;\n]|(?<=\w)\.(?=\w)|:(?=\s)){1,60}?)"
_ENDS = r"(?=\s*(?:$|[,:;(]|\s{2}|\s[-–]\s|\.{2,}))"

_BEGUN = re.compile(r"(?m)^(?P<indent>[^\S\n]*)[A-P]\d{1,2}\b")
"""A line that begins with a well, or with what is called like one."""
_COLUMNS = re.compile(r"\S\s{2,}\S")
"""How cells of a table are set apart: "albumin    rack in slot 4"; the first is no labware."""


class Standing(NamedTuple):
    """What a line says to stand in a slot.

    Attributes:
        slot: The slot, in capitals: "3", "D1".
        what: What is there, in the line's words: "Dose plate".
    """

    slot: str
    what: str


class InSlots:
    """The forms in which a line may say so, as patterns.

    Args:
        slots: The slots in which labware stands, in capitals.
        names: What people call a slot.
        nouns: What people call labware.
        tubes: Those of them that may be called so in a rack: a "tube in A1".
        others: What else stands on a deck: tips, the trash.
    """

    def __init__(
        self,
        slots: Collection[str],
        names: WellNames,
        nouns: Collection[str],
        tubes: Collection[str],
        others: Collection[str],
    ) -> None:
        self._slots = frozenset(slots)
        self._names = names
        slot = rf"{names.slot}\s*(?P<slot>(?i:{SLOT}))\b"
        self._slot = re.compile(slot)
        whole, several = any_of(set(nouns) - set(tubes)), any_of(tubes)
        noun = rf"(?i:\b(?:(?:{whole})s?|(?:{several})s)\b)"
        # The slots of a Flex are called like wells: only "plate in D1" names one.
        bare = any_of([slot for slot in self._slots if slot[0].isalpha()])
        self._bare = re.compile(rf"{noun}(?:\s+(?:in|on|at)\s+|\s*\(\s*)(?={bare}\b)")
        on_deck = rf"(?=[^\n]*?(?:{noun}|(?i:\b(?:{any_of(others)})s?\b)))"
        self._listed = re.compile(
            rf"(?m)^(?P<indent>[^\S\n]*)(?=[A-D][1-4](?:\s*[:=]|\s+[-–]\s|[^\S\n])[^\S\n]*\w){on_deck}"
        )
        self._position = re.compile(
            rf"(?m)(?P<lead>^{_LEAD})(?:{names.position}\s*|P(?=\d{{1,2}}\s*(?:->|[:=])))"
            rf"(?={SLOT}\b{on_deck})"
        )
        self._at_end = re.compile(
            rf"(?m)(?P<lead>^[^\n]*?{noun}[^\n.]*?(?:\.{{2,}}|\s{{2,}}|[,:])\s*){names.position}\s*"
            rf"(?={SLOT}\b)"
        )
        joined = (
            r"(?:\s*[,:]\s*|\s*\.{2,}\s*|\s+[-–]\s+|\s{2,}|\s+(?:in|on|at)\s+(?:the\s+)?)"
            r"(?:\w+\s+)?"
        )
        self._forms = (
            re.compile(
                rf"{_LEAD}{slot}(?:\s*(?:->|=>|[:.)=]+)\s*|\s+[-–]?\s*)(?P<what>[^\W_][^().,:;\n]{{1,60}}"
                r"(?:,\s*[^\W\d][^\d().,:;\n]{1,30})?)"
            ),
            re.compile(rf"{_LEAD}{_WHAT}\s*\([^()]*?{slot}[^()]*\){_ENDS}"),
            re.compile(rf"{_LEAD}{_WHAT}{joined}{slot}{_ENDS}"),
        )

    def slots_in(self, text: str) -> set[str]:
        """The slots that a text names, in capitals."""
        return {slot.upper() for slot in self._slot.findall(text)}

    def begins(self, line: str) -> bool:
        """Whether a line begins with a slot."""
        return self._slot.match(line.strip(" \t#*-")) is not None

    def with_slots(self, text: str) -> str:
        """A text with "slot" before those that it calls otherwise: "the plate on C2", "Position 4
        tube rack", lines of a list of the deck "D1: cells, 12-well plate".
        """
        lines = text.split("\n")
        text = "\n".join(line if self._slot.search(line) else self._placed(line) for line in lines)
        if any(slot[0].isalpha() for slot in self._slots):
            text = self._with_listed(text)
        return self._bare.sub(lambda match: f"{match[0]}slot ", text)

    def _with_listed(self, text: str) -> str:
        """A text with "slot" on the lines of a Flex deck's list, which all speak of labware."""
        listed = Counter(match["indent"] for match in self._listed.finditer(text))
        begun = Counter(match["indent"] for match in _BEGUN.finditer(text))
        lists = {indent for indent, count in listed.items() if count == begun[indent] > 1}
        return self._listed.sub(
            lambda match: f"{match[0]}slot " if match["indent"] in lists else match[0], text
        )

    def _placed(self, line: str) -> str:
        if len(line) > _LONGEST_LINE:
            return line
        line = self._at_end.sub(r"\g<lead>slot ", line, count=1)
        return line if self._slot.search(line) else self._position.sub(r"\g<lead>slot ", line)

    def standing(self, line: str) -> Standing | None:
        """What a line that begins with a labware, or with its slot, says to stand there.

        Prose ("the plate in slot 3 holds ...") says no such thing, nor a line of several slots.
        """
        if len(self._slot.findall(line)) != 1:
            return None
        for form in self._forms:
            match = form.match(line)
            if match and form is self._forms[-1] and self._is_of_wells(line[match.end() :]):
                return None  # "albumin    rack in slot 4, D2"
            if match and match["slot"].upper() in self._slots:
                said = " ".join(match["what"].split())
                if len(tokens(said)) > _LONGEST_NAME:
                    said = said.partition(",")[0]  # "extract plate, as delivered by ..."
                what = said.strip(" \"'“”,:-–")
                # "Curve (slot 2, row A)" is only what some of its wells hold.
                beside = line[: match.start("slot")] + line[match.end("slot") : match.end()]
                apart = _COLUMNS.search(match["what"]) or self._names.spec.search(beside)
                if 0 < len(tokens(what)) <= _LONGEST_NAME and not apart:
                    return Standing(match["slot"].upper(), what)
        return None

    def _is_of_wells(self, rest: str) -> bool:
        """Whether wells follow, as the place of what is said before."""
        return self._names.spec.match(rest.lstrip(" ,;(")) is not None


def in_slots(slots: Collection[str], common: Common) -> InSlots:
    """The forms for one deck, in the words of the rule files; made once for equal ones."""
    nouns = labware_words(common)
    tubes = {word for word in words_of(common.labware.get("tube", ())) if "rack" not in word}
    others = words_of((*common.tips, *common.waste))
    return _made(frozenset(slots), well_names(common), nouns, frozenset(tubes), others)


@functools.lru_cache(maxsize=8)
def _made(
    slots: frozenset[str],
    names: WellNames,
    nouns: frozenset[str],
    tubes: frozenset[str],
    others: frozenset[str],
) -> InSlots:
    return InSlots(slots, names, nouns, tubes, others)
