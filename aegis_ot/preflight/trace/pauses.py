"""What a person may have done during a pause: replaced a plate, shook it, refilled a reservoir.

A pause hides what happens on the deck, and its message is prose. It is not understood, only
searched for a few words (``rules/common.json``, ``pauses``). Where it speaks of labware being
handled, that labware counts as new and nothing is held against it afterwards.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import LabwareInfo
from ..source import lexicon_of, tokens

_SLOT = re.compile(
    r"\bslots?\W{0,3}((?:(?:[A-D][1-4]|\d{1,2})\W{0,3}(?:and\b|und\b|et\b)?\s*)+)", re.I
)
_CLAUSE = re.compile(r"(?<!\d)[.,](?!\d)|[;:!?\n]|\b(?:and|then|und|et|y)\b", re.I)

_LONGEST = 2000
"""So many characters of a message are looked at."""

_FEWEST_WELLS = 6
"""Labware of fewer wells is no plate that somebody who says "the plate" may have taken."""

_LABWARE = frozenset({"plate", "trough"})


@dataclass(frozen=True)
class Intervention:
    """What one pause may have changed.

    Attributes:
        replaced: Keys of labware that counts as new afterwards.
        tips: Whether used tips were replaced, or taken out.
        thinned: Whether tips were taken out: a rack has gaps that nobody saw.
        shaken: Whether plates were mixed by hand or on a shaker.
        volumes_unsure: Whether wells may have been filled or emptied by hand.
    """

    replaced: frozenset[str] = frozenset()
    tips: bool = False
    shaken: bool = False
    volumes_unsure: bool = True
    thinned: bool = False


Words = Mapping[str, Sequence[str]]
"""By topic: ``plate``, ``trough``, ``tips`` and ``covers`` (lids, seals, gloves) are things;
``replace``, ``new``, ``away``, ``back``, ``refill`` and ``shake`` are what is done with them; a
rack called ``half`` loaded has every other tip."""


def topics_in(text: str, words: Words) -> set[str]:
    """The topics of which a text speaks."""
    return {match.topic for match in lexicon_of(words).find(text)}


def read_pause(
    text: str, words: Words, labware: Mapping[str, LabwareInfo], slots: Mapping[str, str]
) -> Intervention:
    """Read a pause message; an empty one says nothing, so anything may have happened.

    Facts of each labware, and the slot where it stands now, are by its key.
    """
    clauses = [topics_in(clause, words) for clause in _CLAUSE.split(text[:_LONGEST])]
    said = frozenset().union(*clauses)
    # "Remove the foil from the plate" is done to the foil.
    things = frozenset().union(*(one for one in clauses if "covers" not in one)) & _LABWARE
    named = _named(text[:_LONGEST], labware, slots)
    thinned = any({"tips", "away"} <= clause for clause in clauses)
    tips = thinned or ("tips" in said and not said.isdisjoint(("replace", "new", "refill")))
    shaken = "shake" in said
    if not things and not named:
        aside = not said.isdisjoint(("tips", "covers"))
        if "replace" not in said or aside:
            filled = "refill" in said and "tips" not in said  # "Refill the tube"
            return Intervention(
                tips=tips, shaken=shaken, volumes_unsure=filled or not aside, thinned=thinned
            )
        things = frozenset({"plate"})  # "Replace and resume"
    # What is brought back is the same plate.
    away = "away" in said and "back" not in said
    if not away and said.isdisjoint(("replace", "new")):
        return Intervention(tips=tips, shaken=shaken, thinned=thinned)
    meant = named or {key for key, info in labware.items() if _may_be(info, things)}
    return Intervention(frozenset(meant), tips, shaken, thinned=thinned)


def _may_be(info: LabwareInfo, things: frozenset[str]) -> bool:
    """Whether somebody who says "the plate" or "the reservoir" may have taken this."""
    if info.centers_channels:
        return "trough" in things and info.holds_liquid
    return "plate" in things and info.holds_liquid and len(info.wells) >= _FEWEST_WELLS


def _named(text: str, labware: Mapping[str, LabwareInfo], slots: Mapping[str, str]) -> set[str]:
    """Labware that the message names, by label or by slot."""
    joined = f" {' '.join(tokens(text))} "
    listed = {
        slot.upper() for several in _SLOT.findall(text) for slot in re.findall(r"\w+", several)
    }
    found: set[str] = set()
    for key, info in labware.items():
        label = " ".join(tokens(info.label))
        if not info.is_trash and (
            slots.get(key, "").upper() in listed or (label and f" {label} " in joined)
        ):
            found.add(key)
    return found
