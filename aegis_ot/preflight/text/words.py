"""Finds the words of a list in identifiers and texts, however they are spelled.

``templateWells``, ``template_wells``, ``TEMPLATES`` and "the template wells" all hold the
word *template*. Identifiers are cut at underscores, case changes and digits; accents, case
and English plurals do not matter; the longest phrase wins, so that "no template control" is
not a template.
"""

from __future__ import annotations

import functools
import re
import unicodedata
from collections.abc import Mapping, Sequence
from typing import NamedTuple

_PIECES = re.compile(r"#|[A-Z]{2,}s(?![a-z])|[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+(?:\.\d+)?|[^\W\d_]+")


class Match(NamedTuple):
    """A phrase found: its topic, the phrase, and which tokens it covers."""

    topic: str
    phrase: str
    start: int
    end: int


@functools.lru_cache(maxsize=8192)
def tokens(text: str) -> tuple[str, ...]:
    """Cut a text or identifier into lower-case words, plurals reduced."""
    plain = unicodedata.normalize("NFKD", text.replace("ß", "ss").replace("µ", "u"))
    plain = "".join(c for c in plain if not unicodedata.combining(c)).replace("'", "")
    return tuple(_singular(piece.lower()) for piece in _PIECES.findall(plain))


def _singular(word: str) -> str:
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("sses", "xes", "ches", "shes")):
        return word[:-2]
    if len(word) > 2 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        return word[:-1]
    return word


def _same(here: tuple[str, ...], parts: tuple[str, ...]) -> bool:
    return len(here) == len(parts) and all(
        one == other or (other == "#" and one.isdigit())
        for one, other in zip(here, parts, strict=True)
    )


class Lexicon:
    """Phrases by topic, ready to be searched for; ``#`` in a phrase stands for any number.

    Args:
        phrases: For each topic its phrases. A phrase that stands under several topics is
            reported for each.
        aliases: Abbreviations and what they stand for, word by word.
    """

    def __init__(
        self, phrases: Mapping[str, Sequence[str]], aliases: Mapping[str, str] | None = None
    ) -> None:
        self._aliases = aliases or {}
        self._by_first: dict[str, list[tuple[tuple[str, ...], str, str]]] = {}
        for topic, listed in phrases.items():
            for phrase in listed:
                parts = self._full(tokens(phrase))
                if parts:
                    self._by_first.setdefault(parts[0], []).append((parts, topic, phrase))
        for entries in self._by_first.values():
            entries.sort(key=lambda entry: -len(entry[0]))
        self._cache: dict[str, tuple[Match, ...]] = {}

    def find(self, text: str) -> tuple[Match, ...]:
        """All phrases in ``text``, none overlapping a longer one, in order."""
        found = self._cache.get(text)
        if found is None:
            found = self._cache[text] = tuple(self._search(self._full(tokens(text))))
        return found

    def _full(self, words: tuple[str, ...]) -> tuple[str, ...]:
        aliases = self._aliases
        return tuple(aliases.get(word, word) for word in words) if aliases else words

    def _search(self, words: tuple[str, ...]) -> list[Match]:
        found: list[Match] = []
        at = 0
        while at < len(words):
            length = 0
            for parts, topic, phrase in self._by_first.get(words[at], ()):
                if len(parts) < length:
                    break
                here = words[at : at + len(parts)]
                if here == parts or ("#" in parts and _same(here, parts)):
                    length = len(parts)
                    found.append(Match(topic, phrase, at, at + length))
            at += length or 1
        return found
