"""The words of the phrases that a list of a rule file holds."""

from __future__ import annotations

import functools

from ..rules import Common
from .words import tokens


@functools.lru_cache(maxsize=64)
def first_words(phrases: tuple[str, ...]) -> frozenset[str]:
    """The first word of each phrase of a list."""
    return frozenset(tokens(phrase)[0] for phrase in phrases)


@functools.lru_cache(maxsize=64)
def words_of(phrases: tuple[str, ...]) -> frozenset[str]:
    """All words of the phrases of a list."""
    return frozenset(word for phrase in phrases for word in tokens(phrase))


def labware_words(common: Common) -> frozenset[str]:
    """All words for what stands on the deck: "tube", "plate"."""
    return words_of(tuple(word for words in common.labware.values() for word in words))
