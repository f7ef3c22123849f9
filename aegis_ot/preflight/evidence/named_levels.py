"""Levels that names, their keys and the comments beside them give to wells."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...instrumentation import NameBinding
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, any_of, listed_levels, unit_in
from .levels import far_apart, is_number, names_counts, speaks_of_amounts, words_for_zero

_IN_BRACKETS = re.compile(r"\([^()\d]*\)")
NUMBERED = re.compile(r"(.*)\[(?P<quote>['\"]?)(-?\d+(?:\.\d+)?)(?P=quote)\]([^\[\]]*)")


def numeric_keys(names: Sequence[NameBinding]) -> dict[str, float | None]:
    """Level of each name like ``standards[125]``; ``None`` where the keys only count.

    Keys that are text, ``tubes["1"]``, name something rather than count it.
    """
    groups: dict[tuple[str, str], dict[str, float]] = {}
    for binding in names:
        match = NUMBERED.fullmatch(binding.name)
        if match:
            key = (match[1] + match[4], match["quote"])
            groups.setdefault(key, {})[binding.name] = float(match[3])
    found: dict[str, float | None] = {}
    for (_, quote), group in groups.items():
        values = sorted(group.values())
        counting = values in (
            [float(n) for n in range(len(values))],
            [float(n + 1) for n in range(len(values))],
        )
        if not (counting and quote):
            found.update({name: None if counting else value for name, value in group.items()})
    return found


def amounts_in_names(names: Sequence[NameBinding]) -> dict[str, float]:
    """Level of names like ``s_2000``, ``s_500``, ``s_0``: alike but for numbers too far apart to
    count something. So many amounts of one thing are its standards.
    """
    groups: dict[str, dict[str, float]] = {}
    for binding in names:
        match = re.fullmatch(r"([A-Za-z]+?)_?(\d+(?:p\d+)?)", binding.name)
        if match and len(binding.wells) == 1:
            groups.setdefault(match[1], {})[binding.name] = float(match[2].replace("p", "."))
    return {
        name: value
        for group in groups.values()
        if far_apart(group.values())
        for name, value in group.items()
    }


def keyed_amounts(
    names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> dict[str, float]:
    """Level of ``standards["s1"]`` where a dict of amounts has the same keys: ``CONC["s1"]``."""
    groups: dict[str, dict[str, str]] = {}
    for binding in names:
        match = re.fullmatch(r"([^\[\]]+)\[(['\"])(.+)\2\]", binding.name)
        if match:
            groups.setdefault(match[1], {})[match[3]] = binding.name
    found: dict[str, float] = {}
    maps = [
        (constant, {str(key): float(number) for key, number in value.items()})
        for constant, value in (*facts.constants.items(), *facts.levels.items())
        if isinstance(value, dict) and all(is_number(number) for number in value.values())
    ]
    maps += [(binding.name, dict(binding.numbers)) for binding in names if binding.numbers]
    for constant, by_key in maps:
        if not _has_amounts(constant, facts, common):
            continue
        for group in groups.values():
            if len(group) > 1 and group.keys() <= by_key.keys():
                found.update({name: by_key[key] for key, name in group.items()})
    return found


def _has_amounts(name: str, facts: SourceFacts, common: Common) -> bool:
    """Whether a name, or the comment on it, says that its numbers are amounts: "kit, ug/mL"."""
    noted = bool(unit_in(facts.notes.get(name, ""))) and not names_counts(name, common)
    return speaks_of_amounts(name, common) or noted


def listed_beside(
    facts: SourceFacts, line: int, wells: Sequence[WellRef], common: Common
) -> tuple[float, ...]:
    """One level for each well of a name that a comment beside it or right above it lists:
    "BSA 0, 0.1, 0.2, 0.4 mg/ml: A1-A4 of the rack", "blank, 0.1, 0.2 mg/ml".
    """
    above = facts.comments.get(line - 1, "") if line - 1 in facts.own_line else ""
    note = facts.comments.get(line) or above
    if not note:
        return ()
    nothing = words_for_zero(common)
    counted = re.sub(rf"\b(?:{any_of(nothing)})\b", "0", note, flags=re.IGNORECASE)
    plain = _IN_BRACKETS.sub(" ", note)  # "0 (buffer blank), 25, 125 ug/ml"
    for levels in map(listed_levels, dict.fromkeys((note, counted, plain))):
        if len(levels) == len(set(levels)) == len(set(wells)) == len(wells) > 2:
            return levels
    return ()
