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

_MIXED = re.compile(r"(?<![A-Za-z])[A-Za-z]*[a-z][A-Z][A-Za-z]*")
"""A word with a capital inside."""


class Match(NamedTuple):
    """A phrase found: its topic, the phrase, and which tokens it covers."""

    topic: str
    phrase: str
    start: int
    end: int


@functools.lru_cache(maxsize=8192)
def tokens(text: str) -> tuple[str, ...]:
    """Cut a text or identifier into lower-case words, plurals reduced."""
    if not text.isascii():
        text = unicodedata.normalize("NFKD", text.translate(_LETTERS))
        text = "".join(c for c in text if not unicodedata.combining(c))
    pieces = _PIECES.findall(text.replace("'", ""))
    return tuple([_singular(_folded(piece.lower())) for piece in pieces])


@functools.lru_cache(maxsize=8192)
def _is_mixed(text: str) -> bool:
    return _MIXED.search(text) is not None


_LETTERS = str.maketrans({"ß": "ss", "µ": "u", "æ": "ae", "Æ": "Ae", "œ": "oe", "Œ": "Oe"})


def _folded(word: str) -> str:
    """``stammloesung`` and "Stammlösung" are one word, ``oestradiol`` and "œstradiol" too."""
    return word.replace("ae", "a").replace("oe", "o").replace("ue", "u")


def _singular(word: str) -> str:
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("sses", "xes", "ches", "shes")):
        return word[:-2]
    if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        return word[:-1]
    return word


def _same(here: tuple[str, ...], parts: tuple[str, ...]) -> bool:
    return len(here) == len(parts) and all(
        one == other or (other == "#" and one.isdigit())
        for one, other in zip(here, parts, strict=True)
    )


_MOST_TEXTS = 4096
"""A lexicon outlives a protocol."""


class Lexicon:
    """Phrases by topic, ready to be searched for; ``#`` in a phrase stands for any number.

    Args:
        phrases: For each topic its phrases. A phrase that stands under several topics is
            reported for each.
        aliases: Abbreviations and what they stand for, word by word.

    Attributes:
        find: All phrases in a text, none overlapping a longer one, in order.
        words: The words of a text that matches count: abbreviations spelled out.
    """

    def __init__(
        self, phrases: tuple[tuple[str, tuple[str, ...]], ...], aliases: tuple[tuple[str, str], ...]
    ) -> None:
        self._aliases = dict(aliases)
        self._by_first: dict[str, list[tuple[tuple[str, ...], str, str]]] = {}
        for topic, listed in phrases:
            for phrase in listed:
                parts = self._full(tokens(phrase))
                if parts:
                    self._by_first.setdefault(parts[0], []).append((parts, topic, phrase))
        for entries in self._by_first.values():
            if len(entries) > 1:
                entries.sort(key=lambda entry: -len(entry[0]))
        self.find = functools.lru_cache(maxsize=_MOST_TEXTS)(self._find)
        self.words = functools.lru_cache(maxsize=_MOST_TEXTS)(self._words)

    def may_find(self, text: str) -> bool:
        """Whether a word of a text begins a phrase: else there is none in any part of it."""
        return not self._by_first.keys().isdisjoint(self.words(text))

    def _words(self, text: str) -> tuple[str, ...]:
        return self._full(tokens(_MIXED.sub(self._joined, text) if _is_mixed(text) else text))

    def _joined(self, written: re.Match[str]) -> str:
        """One word of "HeLa" or "siRNA", where the lists have that and none of its parts."""
        word = written.group().lower()
        if any(part in self._by_first for part in tokens(written.group())):
            return written.group()
        return word if tokens(word)[0] in self._by_first else written.group()

    def _full(self, words: tuple[str, ...]) -> tuple[str, ...]:
        if self._aliases.keys().isdisjoint(words):
            return words
        return tuple(self._aliases.get(word, word) for word in words)

    def _find(self, text: str) -> tuple[Match, ...]:
        words = self.words(text)
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
        return tuple(found)


def lexicon_of(
    phrases: Mapping[str, Sequence[str]], aliases: Mapping[str, str] | None = None
) -> Lexicon:
    """The lexicon of a rule file's lists (see :class:`Lexicon`), made once for equal lists."""
    listed = tuple((topic, tuple(words)) for topic, words in phrases.items())
    return _made(listed, tuple((aliases or {}).items()))


_made = functools.lru_cache(maxsize=128)(Lexicon)
