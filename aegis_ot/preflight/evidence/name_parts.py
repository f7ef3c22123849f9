"""The part of a name that says what something is, not where it stands or what it belongs to."""

from __future__ import annotations

from ..rules import Common
from ..text import first_words, tokens


def without_position(name: str, common: Common) -> str:
    """A name that holds where something stands, without the word for that: ``LYSATE_POS``.

    Only where it is the last of several: ``POS_WELL`` is a positive control's.
    """
    base, bracket, key = name.partition("[")
    words = tokens(base)
    if len(words) < 2 or words[-1] not in first_words(common.positions):
        return name
    return " ".join(words[:-1]) + bracket + key


def told_once(name: str) -> str:
    """A field without the words that its record's name has: ``NO_DNA.dna_tube`` holds no DNA."""
    record, dot, field = name.rpartition(".")
    told = set(tokens(record))
    return f"{record}.{' '.join(w for w in tokens(field) if w not in told)}" if dot else name
