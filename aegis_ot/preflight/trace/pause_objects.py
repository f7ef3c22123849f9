"""What it is that a pause message speaks of replacing or taking away: plates, or other things."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from ..source import Match, lexicon_of, tokens

_CLAUSE = re.compile(r"(?<!\d)[.,](?!\d)|[;:!?\n]")
"""What stands between two clauses; "0.5 mL" is one."""

_MOST = 50
"""So many words of a clause are looked at; a message of more is none."""

_KINDS = ("plate", "tips", "dry", "liquids")


class _Said(NamedTuple):
    """A word for what is done, and the clause that it stands in."""

    match: Match
    clause: str
    kinds: list[Match]
    """Words for things of any kind, in order; of several in a row the last: "plate seal"."""

    @property
    def after(self) -> list[Match]:
        """Those behind the word."""
        return [kind for kind in self.kinds if kind.start >= self.match.end]


class PauseObjects:
    """Tells by the words after a verb, or after "new", whether plates are meant.

    Args:
        words: Phrases by topic: what is done (``replace``, ``refill``, ``away``, of which those of
            ``taking`` may be done with anything; ``qualities``, of ``replace``, stand right before
            what they are said of), and with what: ``plate``, ``vessels`` that mean the same here,
            ``tips``, ``liquids`` and what holds them (``tubes``), what is ``dry`` and no labware,
            and ``fillers``, which say nothing of it.
        joining: Words for "and".
    """

    def __init__(self, words: Mapping[str, Sequence[str]], joining: Sequence[str]) -> None:
        listed = {topic: tuple(words.get(topic, ())) for topic in words}
        topics = ("replace", "away", "refill", "tips", "dry", "liquids", "fillers")
        plates = (*listed.get("plate", ()), *listed.get("vessels", ()))
        self._lexicon = lexicon_of({t: listed.get(t, ()) for t in topics} | {"plate": plates})
        self._plates = lexicon_of({"plate": plates})
        self._taking = lexicon_of({"taking": listed.get("taking", ())})
        self._qualities = lexicon_of({"qualities": listed.get("qualities", ())})
        self._tubes = frozenset(listed.get("tubes", ()))
        self._joining = frozenset(tokens(word)[0] for word in joining)
        small = (*listed.get("fillers", ()), *listed.get("qualities", ()))
        self._between = self._joining | frozenset(tokens(word)[0] for word in small)

    def name_plates(self, text: str) -> bool:
        """Whether a text has a word for plates."""
        return bool(self._plates.find(text))

    def are_plates(self, text: str, topic: str, named: bool) -> bool:
        """Whether a text says of plates what the words of a topic say of anything.

        "New gloves" are none, and neither is "the seal of the plate"; "replace and resume" speaks
        of what the text speaks of.

        Args:
            text: A message.
            topic: ``replace`` or ``away``.
            named: Whether it names labware that stands on the deck.
        """
        anywhere = named or self.name_plates(text)
        return any(self._is_of_plates(said, anywhere) for said in self._said(text, topic))

    def may_change_volumes(self, text: str, topic: str) -> bool:
        """Whether what a text says by the words of a topic may be done with what wells hold.

        "Refill the tips, empty the trash" is not.
        """
        of_tips = any(match.topic == "tips" for match in self._lexicon.find(text))
        for said in self._said(text, topic):
            after = said.after
            kinds = self._joined(after, said.clause) if after else set()
            if not kinds.isdisjoint(("plate", "liquids")) or not (kinds or of_tips):
                return True
        return False

    def _said(self, text: str, topic: str) -> Iterator[_Said]:
        """The words of a topic, each with what its clause names."""
        for clause in _CLAUSE.split(text):
            matches = self._lexicon.find(clause)[:_MOST]
            found = [match for match in matches if match.topic in _KINDS]
            kinds = [one for one, then in pairwise(found) if then.start > one.end] + found[-1:]
            yield from (_Said(m, clause, kinds) for m in matches if m.topic == topic)

    def _is_of_plates(self, said: _Said, anywhere: bool) -> bool:
        """Whether one such word is said of plates.

        Args:
            said: The word.
            anywhere: Whether the text speaks of plates at all.
        """
        match = said.match
        if self._plates.find(match.phrase) or (
            match.topic == "away" and not self._taking.find(match.phrase)
        ):
            return True  # "clean plate" says both, and so does "to the incubator"
        if said.after:
            return "plate" in self._joined(said.after, said.clause) or self._are_tubes(said)
        if anywhere or said.kinds:
            # "The plate is full, replace it"
            return not said.kinds or said.kinds[0].topic == "plate"
        if not self._qualities.find(match.phrase):
            return True  # "exchange source"
        return self._says_nothing_else(said.clause)

    def _joined(self, after: Sequence[Match], clause: str) -> set[str]:
        """What the first of these things is, and those that "and" joins to it."""
        words = self._lexicon.words(clause)
        found = {after[0].topic}
        for one, then in pairwise(after):
            between = {word for word in words[one.end : then.start] if not word.isdecimal()}
            if between.isdisjoint(self._joining) or not between <= self._between:
                break
            found.add(then.topic)
        return found

    def _are_tubes(self, said: _Said) -> bool:
        """Whether it is said of several tubes; one new tube leaves the others as they are."""
        phrase = said.after[0].phrase
        return phrase in self._tubes and f"{phrase}s" in said.clause.lower()

    def _says_nothing_else(self, clause: str) -> bool:
        """Whether all words of a clause say what is done, and none of what: "Swap and resume"."""
        told = {
            at
            for match in self._lexicon.find(clause)
            if match.topic in ("replace", "away", "fillers")
            for at in range(match.start, match.end)
        }
        return len(told) == len(self._lexicon.words(clause))
