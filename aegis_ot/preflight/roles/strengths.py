"""On which scale the levels of one role are, and what is none of them.

What is said of all doses alike is no dose: "inhibitor (6x)" is how strong each solution is.
"""

from __future__ import annotations

from ..rules import Common
from ..text import Concentration, level_in, without_strength
from .roles import Roles


def unsay_strengths(roles: Roles, common: Common) -> None:
    """Take the strength of working solutions for no dose, where all dosed liquids have the same.

    What else is told of their wells then counts.
    """
    for name, spec in roles.family.roles.items():
        found = {ref: one for ref, one in roles.by_well.items() if one.role == name}
        if not spec.dosed or len({one.level for one in found.values()}) != 1:
            continue
        if all(_is_a_strength(one.text, one.level, common) for one in found.values()):
            for ref, assigned in found.items():
                assigned.level = roles.told_levels.get(ref)


def settle_scales(roles: Roles) -> None:
    """Take the plain numbers of a table where it has them all, and amounts are told of some.

    ``("A2", 0.0625)`` beside "standard 0.125 mg/mL".
    """
    for name in roles.family.roles:
        found = [
            (ref, one) for ref, one in roles.by_well.items() if name in roles.closure(one.role)
        ]
        kinds = {type(one.level) for _, one in found if one.level}
        if kinds != {Concentration, float}:
            continue
        plain = {ref: roles.told_levels.get(ref) for ref, _ in found}
        if all(type(number) is float for number in plain.values()):
            for ref, one in found:
                one.level = plain[ref]


def _is_a_strength(text: str, level: float | None, common: Common) -> bool:
    """Whether a level stands in a text as "6x", and nothing else there says one."""
    plain = without_strength(text)
    return plain != text and level_in(text, common) == level != level_in(plain, common)
