"""The words for the roles of a family, ready to be searched for."""

from __future__ import annotations

from collections.abc import Iterator

from ..rules import Common, Family, RoleSpec
from ..text import Lexicon, lexicon_of


def role_words(family: Family, common: Common) -> Lexicon:
    """The words of all roles of a family; those that speak against one stand under ``!role``."""
    phrases: dict[str, list[str]] = {}
    for name, spec in family.roles.items():
        phrases.setdefault(name, []).extend(spec.words)
        phrases[f"!{name}"] = list(spec.never)
        for undosed in spec.undosed:
            phrases.setdefault(undosed, []).extend(_with_none_of(spec, family, common))
    return lexicon_of(phrases, common.aliases, common.endings)


def _with_none_of(spec: RoleSpec, family: Family, common: Common) -> Iterator[str]:
    """What wells are called that get none of what this role receives: "no LPS", "LPS free"."""
    for dose in spec.receives:
        for word in family.roles[dose].words:
            yield from (f"{lacking} {word}" for lacking in common.lacking)
            yield from (f"{word} {free}" for free in common.free_of)
