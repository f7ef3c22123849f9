"""Which labware a text means: by its label, the name of a variable, or what kind it is."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from ..rules import Common
from ..text import labware_words, lexicon_of, tokens, words_of
from .clauses import Part
from .deck import Deck
from .in_slots import Standing, in_slots
from .well_names import SLOT

_HEADING = re.compile(r"\W*([^\W\d]\w*(?:[ -][^\W\d]\w*){0,3}[ -]?)\s*(?:,[^\d,:]{2,30})?:")
"""A line that begins with what it speaks of: "tubes: A1 lowest ... B2 highest", or "tube rack,
fractions: C1..C6".
"""


IN_BRACKETS = re.compile(r"\([^()]*\)")

_LISTED_SLOT = re.compile(rf"\W*S?({SLOT})(\s*[:=])?\s+((?:[^\W\d]\w*\W+){{1,3}})")
"""How a line of a list of the deck begins: "C2  tube rack"."""

_NUMBER = re.compile(r"^\W*(?:[^\W\d]+\s+)?(?:\d{1,2}(?:\.\d{1,2})*|[A-Z])[.)]?\s+")
"""What numbers a heading: "Part A. Deck"."""

_SHORT_HEADING = 3
"""So few words may leave out a part of a label: the "intermediate plate" is the compounds'."""

_SHORTEST = 3
"""Fewer letters are short for many things."""

_WORD = re.compile(r"\w+")

_NEAR = 5
"""A noun so many words after a well still says where that is."""


_NONE: frozenset[str] = frozenset()


class LabwareNouns:
    """Finds the labware that words stand for; an empty set where they stand for none.

    Attributes:
        slots: How texts name the slots.
    """

    def __init__(self, deck: Deck, common: Common) -> None:
        self._deck = deck
        self._dull = words_of(common.pauses.get("plate", ()))
        self._kinds = [words_of(words) for words in common.labware.values()]
        self._nouns = labware_words(common)
        tubes = words_of(common.labware.get("tube", ()))
        self._racks = {word for word in self._nouns if word not in tubes or "rack" in word}
        self._on_deck = self._nouns | words_of(common.tips)
        self._strips = words_of(common.labware.get("strip", ()))
        self._decks = lexicon_of({"deck": common.decks})
        self._slots = {info.slot for info in deck.trace.labware.values()}
        self.slots = in_slots({info.slot.upper() for info in deck.plates()}, common)
        self._of = words_of(common.layout.get("of", ()))
        self._origins = words_of(common.origins)
        self._articles = words_of(common.articles)
        self._joints = words_of((*common.joints, *common.belonging))
        self._leading = self._articles | self._joints | words_of(common.toward)
        called = [(info.label, info.key) for info in deck.plates() if info.label]
        self._labels = [
            (f" {' '.join(tokens(label))} ", key) for label, key in (*called, *deck.described)
        ]

    def named(self, text: str) -> frozenset[str]:
        """The one labware that a text calls by its label or by the telling name of a variable."""
        slots = self.slots.slots_in(text) or self._listed_slot(text)
        if len(slots) == 1:
            return self._standing_in(slots)
        words = tokens(text)
        found = {key for label, key in self._labels if self._is_called(tuple(label.split()), words)}
        found = found or self._shortened(text)
        if not found:
            for name, keys in self._deck.by_name.items():
                telling = len(name) > 1 and set(tokens(name)) - self._dull  # not in "A1"
                if len(keys) == 1 and telling and self._is_called(tokens(name), words):
                    found |= keys
        return frozenset(found) if len(found) == 1 else frozenset()

    def _shortened(self, text: str) -> set[str]:
        """The labware whose labels say all that a short heading says, and more."""
        words = [word for word in tokens(IN_BRACKETS.sub(" ", text)) if not word.isdecimal()]
        if not 1 < len(words) <= _SHORT_HEADING or words[-1] not in self._nouns:
            return set()
        return {
            key
            for label, key in self._labels
            if all(
                {word, word.removesuffix("s")} & _with_singulars(label.split()) for word in words
            )
        }

    def is_of_deck_list(self, line: str, above: bool) -> bool:
        """Whether a line heads the deck's list, or goes on with it as the line ``above`` does."""
        return self._is_deck_heading(line) or (above and bool(line.strip()))

    def _is_deck_heading(self, line: str) -> bool:
        """Whether a line is no more than the heading of the deck's list: "Deck layout:"."""
        said = _NUMBER.sub("", line)
        return any(m.end - m.start == len(tokens(said)) for m in self._decks.find(said))

    def begun_by(self, line: str, in_deck: bool) -> frozenset[str]:
        """The one labware that a line of the deck's list speaks of: "slot 3   tube rack, ...", or
        "Tube rack (slot 3), 10x solutions"; "C2  cells" only below such a list's heading.
        """
        slots = self.slots.slots_in(line)
        if len(slots) > 1:
            return frozenset()  # prose, which speaks of both
        begins = self.slots.begins(line) or self.standing(line, in_deck) is not None
        found = self._standing_in(slots or self._listed_slot(line, in_deck)) if begins else _NONE
        return found if len(found) == 1 else _NONE

    def standing(self, line: str, in_deck: bool) -> Standing | None:
        """What a line says to stand in a slot; "C2  cells" only below the heading of a list."""
        if told := self.slots.standing(line):
            return told
        match = _LISTED_SLOT.match(f"{line} ")
        slots = self._listed_slot(line, in_deck)
        return Standing(slots.pop(), match[3].strip(" ,;:(")) if match and slots else None

    def in_slot(self, *slots: str) -> str | None:
        """The key of the one labware that stands in the one slot, if no other took its place."""
        keys = self._standing_in(slots) if len(slots) == 1 else _NONE
        return next(iter(keys)) if len(keys) == 1 else None

    def _standing_in(self, slots: Collection[str]) -> frozenset[str]:
        return frozenset(i.key for i in self._deck.plates() if i.slot.upper() in slots)

    def _listed_slot(self, text: str, in_deck: bool = False) -> set[str]:
        """The slot at the begin of a line of the deck's list: "C2  tube rack", no well's "tube"."""
        match = _LISTED_SLOT.match(f"{text} ")
        if match is None or match[1] not in self._slots or self._is_deck_heading(text):
            return set()
        named = not match[2] and not self._racks.isdisjoint(tokens(match[3]))
        return {match[1]} if in_deck or named else set()

    def _is_called(self, name: tuple[str, ...], words: tuple[str, ...]) -> bool:
        """Whether a text names a labware that is called so.

        One word may be what is in it: "gDNA in column 13" is not the plate called ``dna``.
        """
        for at in range(len(words) - len(name) + 1):
            if words[at : at + len(name)] == name:
                before, after = words[at - 1 : at], words[at + len(name) : at + len(name) + 1]
                leads = set(before) <= self._articles | self._joints
                if len(name) > 1 or leads or set(after) & self._nouns:
                    return True
        return False

    def of_name(self, name: str) -> frozenset[str]:
        """The one labware that a variable was, or whose wells it held, or those in turn."""
        keys = self._deck.by_name.get(name) or self._deck.of_wells.get(name) or set()
        in_turn = name in self._deck.in_turn
        return frozenset(keys) if in_turn or len(keys) == 1 else frozenset()

    def kind_in(self, text: str) -> frozenset[str]:
        """The one labware of a kind that a text speaks of: "vials", "strip"."""
        found = self.of_kinds_in(text)
        return found if len(found) == 1 else frozenset()

    def of_kinds_in(self, text: str) -> frozenset[str]:
        """All labware of the kinds that a text speaks of."""
        words = _with_singulars(tokens(text))
        return frozenset(
            info.key
            for kind in self._kinds
            if kind & words
            for info in self._deck.plates()
            if kind & set(tokens(info.load_name))
        )

    def heading(self, line: str) -> frozenset[str]:
        """What a line speaks of that begins with a noun and a colon."""
        match = _HEADING.match(IN_BRACKETS.sub("", line))
        return self._called(tokens(match[1])) if match else frozenset()

    def beginning(self, text: str) -> frozenset[str]:
        """The one labware that a text begins with: "rack on 1"."""
        words = tokens(text)
        for count in range(len(words), 0, -1):
            found = self._called(words[:count])
            if len(found) == 1:
                return found
        return frozenset()

    def ends_in_noun(self, text: str) -> bool:
        """Whether a text ends with a word for labware: "3   compound rack"."""
        return bool(tokens(text)) and _singular(tokens(text))[-1] in self._nouns

    def is_of_deck(self, part: Part, in_deck: bool) -> bool:
        """Whether a part says what stands in a slot that is called like a well: "D2 tips"."""
        start = part.text.find(part.wells[0].group())
        begun = part.text[:start].strip(" :,;-*")
        return (
            (not begun or bool(self._decks.find(begun)))
            and all(match.group() in self._slots for match in part.wells)
            and (in_deck or not self._on_deck.isdisjoint(_with_singulars(tokens(part.words))))
        )

    def is_elsewhere(self, part: Part) -> bool:
        """Whether a part speaks of strips, as columns, where none are on the deck."""
        begun = tokens(part.text[: part.text.find(part.wells[0].group())])[-1:]
        return bool(self._strips & _with_singulars(begun)) and not self.before(part)

    def before(self, part: Part) -> frozenset[str]:
        """What stands right before the first well: "strip columns 1 and 2", "tube A1"."""
        start = part.text.find(part.wells[0].group())
        return self._called(tokens(part.text[:start])[-2:]) or self._after(part)

    def _after(self, part: Part) -> frozenset[str]:
        """What stands after the last well: "columns 2 and 3 of the source plate"."""
        words = tokens(self._place(part))
        return self._called(tuple(word for word in words[1:] if word not in self._articles))

    def without_place(self, part: Part) -> Part:
        """A part whose words are not those for where its wells are: "H12 on the DNA plate: NTC"."""
        place = self._place(part)
        return part._replace(words=part.words.replace(place, " ", 1)) if place else part

    def _place(self, part: Part) -> str:
        """What follows the last well and says where it is, as written, or ``""``."""
        tail = part.text.rpartition(part.wells[-1].group())[2]
        found = list(_WORD.finditer(tail))[:_NEAR]
        if not found or found[0].group().lower() not in self._joints:
            return ""
        for word in found[1:]:
            if word.group().lower() in self._nouns:
                return tail[found[0].start() : word.end()]
        return ""

    def _called(self, words: tuple[str, ...]) -> frozenset[str]:
        """The labware of this kind, the one of this very name if there is one."""
        words = words[1:] if words[:1] and words[0] in self._leading else words
        if not words:
            return frozenset()
        if len(words) > 2 and words[0] in self._nouns and words[1] in self._of:
            words = (*words[2:], words[0])  # "placa de ADN"
        kinds = [kind for kind in self._kinds if words[-1] in kind]
        if not kinds:
            return frozenset()
        for called in (words, words[:-1]):  # "dose plate" may be labelled or named "dose"
            labelled = {key for label, key in self._labels if tuple(label.split()) == called}
            if len(labelled) == 1:
                return frozenset(labelled)
            for name in (*self._deck.by_name, *self._deck.of_wells):
                alike = sorted(_singular(tokens(name))) == sorted(_singular(called))
                if called and alike and self.of_name(name):
                    return self.of_name(name)
        if short := self._short_for(words[0]):
            return short
        found = {
            info.key
            for info in self._deck.plates()
            if any(kind & set(tokens(info.load_name)) for kind in kinds)
        }
        if self._origins & set(words):
            found -= self._deck.filled
        return frozenset(found)

    def _short_for(self, word: str) -> frozenset[str]:
        """The one labware whose variable is called by the first letters of a word: ``lib``."""
        keys = {
            key
            for name, held in self._deck.by_name.items()
            if len(name) >= _SHORTEST
            and len(held) == 1
            and len(name) < len(word)
            and word.startswith(name)
            for key in held
        }
        return frozenset(keys) if len(keys) == 1 else frozenset()


def _with_singulars(words: Iterable[str]) -> set[str]:
    return {form for word in words for form in (word, word.removesuffix("s"))}


def _singular(words: tuple[str, ...]) -> tuple[str, ...]:
    return (*words[:-1], words[-1].removesuffix("s")) if words else words
