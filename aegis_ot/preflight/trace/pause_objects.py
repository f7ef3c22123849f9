"""What it is that a pause message speaks of replacing or taking away: plates, or other things."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from ..text import Match, lexicon_of

_CLAUSE = re.compile(r"(?<!\d)[.,](?!\d)|[;:!?\n]")
"""What stands between two clauses; "0.5 mL" is one."""


_KINDS = ("plate", "tips", "bins", "things")


class PauseObjects:
    """Tells by the words after a verb, or after "new", whether plates are meant.

    Args:
        words: Phrases by topic: what is done (``replace``, ``refill``, ``away``, of which those of
            ``taking`` may be done with anything), and with what: ``plate``, ``tips``, ``bins``,
            ``things`` that are no labware, and ``fillers``, which say nothing of it.
    """

    def __init__(self, words: Mapping[str, Sequence[str]]) -> None:
        topics = ("replace", "away", "refill", *_KINDS, "fillers")
        self._lexicon = lexicon_of({topic: tuple(words.get(topic, ())) for topic in topics})
        self._taking = lexicon_of({"taking": tuple(words.get("taking", ()))})
        self._plates = lexicon_of({"plate": tuple(words.get("plate", ()))})

    def are_plates(self, text: str, topic: str, named: bool) -> bool:
        """Whether a text says of plates what the words of a topic say of anything.

        "New gloves" are none, and neither is "the seal of the plate"; "replace and resume" speaks
        of what the text speaks of.

        Args:
            text: A message.
            topic: ``replace`` or ``away``.
            named: Whether it names labware that stands on the deck.
        """
        anywhere = named or bool(self._plates.find(text))
        clauses = [clause for clause in _CLAUSE.split(text) if clause.strip()]
        return any(
            self._is_of_plates(clause, match, anywhere)
            for clause in clauses
            for match in self._lexicon.find(clause)
            if match.topic == topic
        )

    def may_change_volumes(self, text: str, topic: str) -> bool:
        """Whether what a text says by the words of a topic may be done with what wells hold.

        "Refill the tips, empty the trash" is not.
        """
        found = {match.topic for match in self._lexicon.find(text)}
        for clause in _CLAUSE.split(text):
            matches = self._lexicon.find(clause)
            for match in matches:
                after = {m.topic for m in matches if m.start >= match.end and m.topic in _KINDS}
                of_wells = not after.isdisjoint(("plate", "things"))
                if match.topic == topic and (of_wells or not (after or "tips" in found)):
                    return True
        return False

    def _first_after(self, clause: str, match: Match) -> Match | None:
        """The first thing of any kind that a clause names after a word."""
        after = (m for m in self._lexicon.find(clause) if m.start >= match.end)
        return next((m for m in after if m.topic in _KINDS), None)

    def _is_of_plates(self, clause: str, match: Match, anywhere: bool) -> bool:
        """Whether one such word of a clause is said of plates.

        Args:
            clause: The clause.
            match: The word.
            anywhere: Whether the text speaks of plates at all.
        """
        if self._plates.find(match.phrase) or (
            match.topic == "away" and not self._taking.find(match.phrase)
        ):
            return True  # "clean plate" says both, and so does "to the incubator"
        found = [m for m in self._lexicon.find(clause) if m.topic in _KINDS]
        if first := self._first_after(clause, match):
            of_it = any(m.start == first.end and m.topic == "things" for m in found)
            return first.topic == "plate" and not of_it  # "the plate seal"
        if anywhere:
            return not found or found[-1].topic == "plate"  # "the plate is full: replace it"
        return self._says_nothing_else(clause)

    def _says_nothing_else(self, clause: str) -> bool:
        """Whether all words of a clause say what is done, and none of what: "Swap and resume"."""
        told = {
            at
            for match in self._lexicon.find(clause)
            if match.topic in ("replace", "away", "fillers")
            for at in range(match.start, match.end)
        }
        return len(told) == len(self._lexicon.words(clause))
