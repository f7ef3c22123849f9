"""Labware that only a text describes: "4.2 Dose plate (slot 3)", "Slot 5: tube rack, extracts"."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from ...vocabulary import WellRef
from ..layouts import Deck, LabwareNouns, in_sentences
from ..rules import Common
from ..text import SourceFacts, comment_blocks, tokens, words_of
from .clues import Clue, Strength, shortened


def described_labware(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What comments and docstrings say of the labware in a slot, which no step of the run says.

    Each is one more name of that labware, by which the texts may speak of it; of its wells it says
    what they all are, but not which of them are controls. Of labware with one well in use a
    sentence may say what that holds: "the trough on slot 3 holds the dye".
    """
    nouns = LabwareNouns(deck, common)
    comments = comment_blocks(facts, indented=True)
    texts = [(line, text) for line, text in comments if line not in facts.among_code]
    for first, text in (*facts.docstrings, *texts):
        lines = nouns.slots.with_slots(text).splitlines()
        sentences = list(in_sentences(lines, common))
        yield from _names(deck, nouns, first, lines, _flowing(lines, sentences))
        for number, block in sentences:
            for at, said in enumerate(block, first + number):
                if place := _only_well(deck, nouns, said, common):
                    yield replace(_clue(said, (place,), at, said), lone=True)


def _flowing(lines: Sequence[str], sentences: Sequence[tuple[int, Sequence[str]]]) -> set[int]:
    """The numbers of the lines that are not as they were written: those of running text."""
    kept = {
        number + at
        for number, block in sentences
        for at, said in enumerate(block)
        if number + at < len(lines) and said.strip() == lines[number + at].strip()
    }
    return set(range(len(lines))) - kept


def _names(
    deck: Deck, nouns: LabwareNouns, first: int, lines: Sequence[str], flowing: Collection[int]
) -> Iterator[Clue]:
    """What the lines of a text call labware by its slot; several things are what is in it."""
    told: dict[str, list[Clue]] = {}
    in_deck = False
    for number, line in enumerate(lines):
        in_deck = nouns.is_of_deck_list(line, in_deck)
        standing = None if number in flowing else nouns.standing(line, in_deck)
        key = nouns.in_slot(standing.slot) if standing else None
        if standing and key:
            wells = deck.used_wells((key,))
            told.setdefault(key, []).append(_clue(standing.what, wells, first + number, line))
    for key, clues in told.items():
        if len({clue.text for clue in clues}) == 1:
            deck.described.append((clues[0].text, key))
            yield clues[0]


def _clue(text: str, wells: tuple[WellRef, ...], line: int, said: str) -> Clue:
    said = f"'{shortened(said)}' at line {line}"
    return Clue(Strength.COMMENT, text, wells, line, said, subject=False, whole=True)


def _only_well(deck: Deck, nouns: LabwareNouns, text: str, common: Common) -> WellRef | None:
    """The one well that is drawn from in the one labware of which a text names the slot."""
    if not words_of(common.negations).isdisjoint(tokens(text)):
        return None  # "the buffer is not the one in slot 3"
    key = nouns.in_slot(*nouns.slots.slots_in(text))
    used = deck.used_wells((key,)) if key else ()
    return used[0] if len(used) == 1 and key not in deck.filled else None
