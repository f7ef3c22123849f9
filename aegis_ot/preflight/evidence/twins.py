"""Plates that are called alike, or are said to share their layout."""

from __future__ import annotations

from ...instrumentation import LabwareInfo
from ..rules import Common
from ..text import lexicon_of, tokens


def may_be_twins(one: LabwareInfo, other: LabwareInfo) -> bool:
    """Whether two labware are of one kind and have one name but for a number."""
    return one.load_name == other.load_name and _called(one) == _called(other)


def said_to_be_twins(text: str, common: Common) -> bool:
    """Whether a text says that its plates share their layout: "All three plates look the same"."""
    return bool(lexicon_of({"twins": common.twins}).find(text))


def _called(info: LabwareInfo) -> tuple[str, ...]:
    return tuple(word for word in tokens(info.label) if len(word) > 1 and not word.isdigit())
