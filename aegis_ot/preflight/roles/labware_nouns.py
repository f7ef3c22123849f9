"""Which labware a text means: by its label, the name of a variable, or what kind it is."""

from __future__ import annotations

import re

from ..rules import Common
from ..text import tokens
from .clauses import Part
from .deck import Deck

_HEADING = re.compile(r"\W*([^\W\d]\w*(?:[ -][^\W\d]\w*){0,3}[ -]?)\s*:")
"""A line that begins with what it speaks of: "tubes: A1 lowest ... B2 highest"."""


_SLOT = re.compile(r"(?i:\bslot\s+)([A-Da-d][1-4]|1[01]|[1-9])\b")

_NEAR = 5
"""A noun so many words after a well still says where that is."""


class LabwareNouns:
    """Finds the labware that words stand for; an empty set where they stand for none."""

    def __init__(self, deck: Deck, common: Common) -> None:
        self._deck = deck
        self._dull = {word for phrase in common.pauses.get("plate", ()) for word in tokens(phrase)}
        self._kinds = [
            {word for phrase in words for word in tokens(phrase)}
            for words in common.labware.values()
        ]
        self._origins = {word for phrase in common.origins for word in tokens(phrase)}
        self._joints = {
            word for phrase in (*common.joints, *common.belonging) for word in tokens(phrase)
        }
        self._labels = [
            (f" {' '.join(tokens(info.label))} ", info.key) for info in deck.plates() if info.label
        ]

    def named(self, text: str) -> frozenset[str]:
        """The one labware that a text calls by its label or by the telling name of a variable."""
        slots = {slot.lower() for slot in _SLOT.findall(text)}
        if len(slots) == 1:
            return frozenset(i.key for i in self._deck.plates() if i.slot.lower() in slots)
        words = f" {' '.join(tokens(text))} "
        found = {key for label, key in self._labels if label in words}
        if not found:
            for name, keys in self._deck.by_name.items():
                telling = set(tokens(name)) - self._dull
                if len(keys) == 1 and telling and f" {' '.join(tokens(name))} " in words:
                    found |= keys
        return frozenset(found) if len(found) == 1 else frozenset()

    def of_name(self, name: str) -> frozenset[str]:
        """The one labware that a variable was, or whose wells it held."""
        keys = self._deck.by_name.get(name) or self._deck.of_wells.get(name) or set()
        return frozenset(keys) if len(keys) == 1 else frozenset()

    def kind_in(self, text: str) -> frozenset[str]:
        """The one labware of a kind that a text speaks of: "vials", "strip"."""
        words = set(tokens(text))
        words |= {word.removesuffix("s") for word in words}
        found = {
            info.key
            for kind in self._kinds
            if kind & words
            for info in self._deck.plates()
            if kind & set(tokens(info.load_name))
        }
        return frozenset(found) if len(found) == 1 else frozenset()

    def heading(self, line: str) -> frozenset[str]:
        """What a line speaks of that begins with a noun and a colon."""
        match = _HEADING.match(line)
        return self._called(tokens(match[1])) if match else frozenset()

    def before(self, part: Part) -> frozenset[str]:
        """What stands right before the first well: "strip columns 1 and 2", "tube A1"."""
        start = part.text.find(part.wells[0].group())
        return self._called(tokens(part.text[:start])[-2:]) or self._after(part)

    def _after(self, part: Part) -> frozenset[str]:
        """What stands after the last well: "columns 2 and 3 of the source plate"."""
        words = tokens(part.text.rpartition(part.wells[-1].group())[2])
        if not words or words[0] not in self._joints:
            return frozenset()
        ends = [at for at, word in enumerate(words[:_NEAR]) if any(word in k for k in self._kinds)]
        return self._called(words[1 : ends[0] + 1]) if ends else frozenset()

    def _called(self, words: tuple[str, ...]) -> frozenset[str]:
        """The labware of this kind, the one of this very name if there is one."""
        if not words:
            return frozenset()
        kinds = [kind for kind in self._kinds if words[-1] in kind]
        if not kinds:
            return frozenset()
        for called in (words, words[:-1]):  # "dose plate" may be labelled or named "dose"
            labelled = {key for label, key in self._labels if tuple(label.split()) == called}
            if len(labelled) == 1:
                return frozenset(labelled)
            for name in (*self._deck.by_name, *self._deck.of_wells):
                if called and tokens(name) == called and self.of_name(name):
                    return self.of_name(name)
        found = {
            info.key
            for info in self._deck.plates()
            if any(kind & set(tokens(info.load_name)) for kind in kinds)
        }
        if self._origins & set(words):
            found -= {key for key, _ in self._deck.received}
        return frozenset(found)
