"""What the cells of a table are for, by their words: slots, labware, wells."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from ..rules import Common
from ..text import any_of, labware_words, level_in, tokens, words_of
from .labware_nouns import IN_BRACKETS
from .shared_words import unit_in_brackets
from .well_names import SLOT, WellNames, well_names

NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_WORD = re.compile(r"\w+")
_LONGEST_NAME = 3


class Place(NamedTuple):
    """A cell that begins with where something is: "rack slot 3, A1, 5 mL".

    Attributes:
        lead: What stands before its wells: "rack slot 3".
        wells: The wells, ``""`` where it names none.
        rest: What stands after them.
    """

    lead: str
    wells: str
    rest: str


class TableWords:
    """Tells the cells of a table apart, with the words of the rule files."""

    def __init__(self, common: Common) -> None:
        self._common = common
        self.names: WellNames = well_names(common)
        self._nouns = labware_words(common) | words_of(common.pauses.get("trough", ()))
        self._slots = words_of(common.layout.get("slot", ()))
        joining = words_of((*common.joints, *common.belonging, *common.articles))
        self._leading = self._nouns | joining
        said = any_of(self._slots)
        self._slot = re.compile(rf"(?i:\b(?:{said})\s*)({SLOT})\b")
        self._bare_slot = re.compile(rf"(?i:(?:{said})\s*)?({SLOT})")
        self._dots = re.compile(r"\b([A-P]\d{1,2})\s*(?:\.{2,}|…)\s*(?=[A-P]\d)")

    def are_slots(self, title: str, cells: Sequence[str]) -> bool:
        """Whether a column holds nothing but slots, as its title says."""
        words = tokens(IN_BRACKETS.sub(" ", title))  # not "plate (slot 1)"
        return not self._slots.isdisjoint(words) and all(map(self._bare_slot.fullmatch, cells))

    def slot_in(self, text: str, bare: bool = False) -> str:
        """The slot that a text names, without the word for it if it is ``bare``; or ``""``."""
        match = self._bare_slot.fullmatch(text) if bare else self._slot.search(text)
        return match[1] if match else ""

    def says_labware(self, cell: str) -> bool:
        """Whether a cell says what stands somewhere, and no wells in it."""
        words = {*tokens(cell), *(word.removesuffix("s") for word in tokens(cell))}
        return not self._nouns.isdisjoint(words) and not self.has_wells(cell)

    def has_wells(self, cell: str) -> bool:
        """Whether a cell names wells."""
        return self.names.spec.search(self._slot.sub(" ", cell)) is not None

    def labware_after(self, begin: re.Pattern[str], text: str) -> str:
        """The labware that is named right after a match: "cell plate"; or ``""``."""
        match = begin.search(text)
        said = [*_WORD.finditer(text, match.end())][:_LONGEST_NAME] if match else []
        for word in said:
            if word.group().lower() in self._nouns:
                return text[said[0].start() : word.end()]
        return ""

    def with_unit(self, cell: str, title: str) -> str:
        """A number with the unit of its column, ``""`` if that has none; others as they are."""
        if not NUMBER.fullmatch(cell):
            return cell
        unit = unit_in_brackets(title) or title
        return f"{cell} {unit}" if level_in(f"1 {unit}", self._common, False) is not None else ""

    def without_dots(self, cell: str) -> str:
        """A cell with a dash for the dots between the ends of a range: "B1 ... B5"."""
        return self._dots.sub(r"\1-", cell)

    def place(self, cell: str) -> Place | None:
        """A cell that says where something is, and at most after that what; ``None`` for others."""
        cell = self.without_dots(cell)
        slot = self._slot.search(cell)
        found = list(self.names.spec.finditer(cell, slot.end() if slot else 0))
        lead = cell[: found[0].start()] if found else cell
        words = tokens(self._slot.sub(" ", lead))
        known = all(not {word, word.removesuffix("s")}.isdisjoint(self._leading) for word in words)
        if not known or not (found or slot):
            return None
        end = len(lead)
        for match in found:
            if match is not found[0] and not self.names.between.fullmatch(cell, end, match.start()):
                break
            end = match.end()
        return Place(lead.strip(" ,;:"), cell[len(lead) : end].strip(), cell[end:].strip(" ,;:="))
