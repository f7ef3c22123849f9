"""What a person did during a pause: replaced a plate, shook it, refilled a reservoir.

A pause hides what happens on the deck. Its message often says it. The words come from the
rule files (``rules/common.json``), so that other languages can be added there.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ...instrumentation import LabwareInfo
from ..source import lexicon_of, tokens
from .pause_objects import PauseObjects

_SLOT = re.compile(r"\b(?:[A-Da-d][1-4]|\d{1,2})\b")


_WAYS = ("back", "elsewhere", "another")
"""Where a plate went, in the order of the words: "to the incubator, then return it to slot 1"."""

_TOPICS = ("replace", "plate", "tips", "refill", "shake", "away", "spin")
"""What is looked for together, so that the longest phrase wins."""

_NEAR = 3
"""So many words after "an empty" say what is empty."""


@dataclass(frozen=True)
class Intervention:
    """What one pause message says.

    Attributes:
        replaced: Keys of labware that are new afterwards.
        returned: Keys of labware that was away meanwhile, and is back.
        all_tips: Whether used tips were replaced.
        shaken: Whether plates were mixed by hand or on a shaker.
        volumes_unsure: Whether wells may have been filled or emptied by hand.
        refilled: Whether the message says so.
        touched: Keys of the labware whose wells these are, where the message names them;
            ``None`` if any may be meant.
    """

    replaced: frozenset[str] = frozenset()
    all_tips: bool = False
    shaken: bool = False
    volumes_unsure: bool = False
    refilled: bool = False
    touched: frozenset[str] | None = None
    returned: frozenset[str] = frozenset()


@dataclass
class Replacements:
    """Reads pause messages with word lists.

    Args:
        words: Phrases by topic: ``replace``, ``plate``, ``tips``, ``refill``,
            ``shake``, ``away``, ``spin``, ``trough``, ``back``, ``elsewhere``, ``another``,
            ``vacant``, and those of :class:`PauseObjects`.
        joining: Words for "and".
    """

    words: Mapping[str, Sequence[str]] = field(default_factory=dict)
    joining: Sequence[str] = ()

    def __post_init__(self) -> None:
        joint = "|".join([r"\s*[,/&+]", *(rf"\s+{re.escape(word)}\b" for word in self.joining)])
        self._slots = re.compile(
            rf"(?i:\bslots?\W{{0,3}}{_SLOT.pattern}(?:(?:{joint})+\s*{_SLOT.pattern})*)"
        )
        self._lexicon = lexicon_of({topic: tuple(self.words.get(topic, ())) for topic in _TOPICS})
        self._ways = lexicon_of({topic: tuple(self.words.get(topic, ())) for topic in _WAYS})
        self._plates = lexicon_of({"plate": tuple(self.words.get("plate", ()))})
        self._objects = PauseObjects(self.words, self.joining)
        self._vacant = lexicon_of({"vacant": tuple(self.words.get("vacant", ()))})
        self._troughs = lexicon_of({"trough": tuple(self.words.get("trough", ()))})

    def shakes(self, text: str) -> bool:
        """Whether a text speaks of shaking or mixing a plate."""
        return any(match.topic == "shake" for match in self._lexicon.find(text))

    def read(
        self, text: str, labware: Mapping[str, LabwareInfo], slots: Mapping[str, str]
    ) -> Intervention:
        """Read a pause message; an empty one says nothing, so anything may have happened."""
        if not text.strip():
            return Intervention(volumes_unsure=True)
        found = self._lexicon.find(text)
        topics = {match.topic for match in found}
        if self._objects.name_plates(text):
            topics.add("plate")  # "clean plate" says it as well
        said = frozenset(topics)
        named = self._named(text, labware, slots)
        others = {
            topic
            for topic in topics & {"replace", "away"}
            if not self._objects.are_plates(text, topic, bool(named))
        }
        shaken = "shake" in topics
        # "Replace the empty tip racks" fills and empties nothing.
        refill = "refill" in topics and self._objects.may_change_volumes(text, "refill")
        new_tips = "replace" in topics and "tips" in topics
        if new_tips and "plate" not in topics:
            unsure = refill or self._objects.may_change_volumes(text, "replace")
            return Intervention(
                all_tips=True, shaken=shaken, volumes_unsure=unsure, refilled=unsure
            )
        topics -= others  # "new gloves", "remove the seal"
        if self._puts_empty_one(text):
            topics |= {"replace", "plate"}
        if refill and not any(
            m.topic == "plate" and not self._troughs.find(m.phrase) for m in found
        ):
            named = named or self._troughs_meant(text, labware)
            if named and all(labware[key].centers_channels for key in named):
                # "Refill the trough with fresh buffer" brings no fresh plate.
                return Intervention(
                    all_tips=new_tips,
                    shaken=shaken,
                    volumes_unsure=True,
                    refilled=True,
                    touched=frozenset(named),
                )
        ways = [match.topic for match in self._ways.find(text)]
        gone = "away" in topics or "back" in ways
        returned = ways[-1:] == ["back"] and "another" not in ways
        new = "replace" in topics
        if new or (gone and "spin" not in topics):
            plates = frozenset(named or _plates_of(labware))
            if new or not returned:
                return Intervention(plates, "tips" in topics, shaken, refill, refill)
            return Intervention(
                frozenset(), "tips" in topics, shaken, True, refill, plates, returned=plates
            )
        filled = refill or any(  # a new tube, say
            self._objects.may_change_volumes(text, topic) for topic in others
        )
        # Beside "empty the trash" a message may speak of anything, but of tips.
        unsaid = "tips" not in said and (not said or "refill" in said)
        unsure = filled or unsaid
        touched = frozenset(named) or None
        return Intervention(frozenset(), "tips" in topics, shaken, unsure, filled, touched)

    def _puts_empty_one(self, text: str) -> bool:
        """Whether a text speaks of "an empty cryo plate"."""
        words = self._vacant.words(text)
        return any(
            self._plates.find(" ".join(words[match.end :][:_NEAR]))
            for match in self._vacant.find(text)
        )

    def _troughs_meant(self, text: str, labware: Mapping[str, LabwareInfo]) -> set[str]:
        """All reservoirs, where the message speaks of one without saying where it stands."""
        if not self._troughs.find(text):
            return set()
        return {key for key, info in labware.items() if info.centers_channels and not info.is_trash}

    def _named(
        self, text: str, labware: Mapping[str, LabwareInfo], slots: Mapping[str, str]
    ) -> set[str]:
        """Labware that the message names, by label or by slot."""
        joined = f" {' '.join(tokens(text))} "
        listed = {
            slot.lower() for several in self._slots.findall(text) for slot in _SLOT.findall(several)
        }
        found: set[str] = set()
        for key, info in labware.items():
            if info.is_trash:
                continue
            slot = slots.get(key, "").lower()
            label = " ".join(tokens(info.label))
            if slot in listed or (label and f" {label} " in joined):
                found.add(key)
        return found


def _plates_of(labware: Mapping[str, LabwareInfo]) -> set[str]:
    """What somebody who says "the plate" may have taken."""
    return {
        key
        for key, info in labware.items()
        if not info.is_tip_rack
        and not info.is_trash
        and len(info.wells) >= _FEWEST_WELLS
        and not info.centers_channels
    }


_FEWEST_WELLS = 6
