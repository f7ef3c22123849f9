"""Which wells hold the same liquid: by name, by load, and by how the run draws from them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ...instrumentation import OperationKind
from ..source import name_without_level, without_strength
from ..trace import Well

if TYPE_CHECKING:
    from .base import Case


def is_same_liquid(case: Case, one: Well, other: Well) -> bool:
    """Whether two wells hold the same liquid, as far as roles, names and their use say."""
    if one is other or one.ref == other.ref:
        return True
    if _laid_out_alike(case, one, other) or _rolls_over(case, one, other):
        return True
    if _is_one_of_a_recipe(case, one, other) or _fill_a_reservoir(case, one, other):
        return True
    if (
        one.liquids
        and one.liquids == other.liquids
        and any(map(str.isdigit, without_strength(one.liquids[0])))
        and case.level(one) == case.level(other)
    ):
        return True
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if {one.ref, other.ref} <= case.roles.unnamed and one.liquids == other.liquids:
        return one.ref not in case.roles.apart
    if mine is None or theirs is None or mine.role != theirs.role:
        return False
    if not case.family.roles[mine.role].one_liquid:
        return False
    return name_without_level(mine.text, case.common.undescriptive) == name_without_level(
        theirs.text, case.common.undescriptive
    )


def _laid_out_alike(case: Case, one: Well, other: Well) -> bool:
    """Whether one statement draws from both, which stand at one place of two reservoirs.

    Not where their names or labels tell them apart.
    """
    if one.ref.name != other.ref.name or case.level(one) != case.level(other):
        return False
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if mine and theirs and mine.role == theirs.role and mine.text != theirs.text:
        return False
    info, their_info = (case.trace.labware.get(well.ref.labware) for well in (one, other))
    if info is None or their_info is None or info.label != their_info.label:
        return False
    if not (info.centers_channels and their_info.centers_channels):
        return False
    return _by_one_statement(one, other)


def _rolls_over(case: Case, one: Well, other: Well) -> bool:
    """Whether one channel of a reservoir goes on where another one ran out.

    One statement draws from both, under one name, each for several wells of its own, and
    most of what the first channel can hold is drawn from it.
    """
    info = case.trace.labware.get(one.ref.labware)
    if info is None or not info.centers_channels or one.ref.labware != other.ref.labware:
        return False
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if (mine and mine.text) != (theirs and theirs.text):
        return False
    served, also = (set(case.destinations.get(well, ())) for well in (one, other))
    first = min(one, other, key=lambda well: well.visits[0].index)
    drawn = sum(v.volume for v in first.visits if v.kind is OperationKind.ASPIRATE)
    return (
        min(len(served), len(also)) > 1
        and 2 * drawn > first.capacity
        and len(served & also) <= 1
        and _by_one_statement(one, other)
    )


def _fill_a_reservoir(case: Case, one: Well, other: Well) -> bool:
    """Whether both are called as their whole reservoir is: ``glycerol`` of "50 % glycerol".

    Not by a plural, "antibodies", which may be a different one in each channel.
    """
    info = case.trace.labware.get(one.ref.labware)
    if info is None or not info.centers_channels or one.ref.labware != other.ref.labware:
        return False
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if mine is None or theirs is None or mine.text != theirs.text or mine.text.endswith("s"):
        return False
    if mine.whole or case.family.roles[mine.role].dosed or case.level(one) != case.level(other):
        return False  # "bortezomib" has another dose in each
    label = name_without_level(info.label, case.common.undescriptive)
    return label == name_without_level(mine.text, case.common.undescriptive) != ()


_NUMBERED = re.compile(r"(.+\[)['\"]?\d+['\"]?\]")
"""The name of an entry of a table whose keys are numbers: ``reagents['3']``."""


def _is_one_of_a_recipe(case: Case, one: Well, other: Well) -> bool:
    """Whether both are tubes of one numbered reagent, of which each well gets its share.

    They stand under one number of a table, no well is given both, and all wells that are given
    either are given things under other numbers too.
    """
    mine, theirs = case.roles.by_well.get(one.ref), case.roles.by_well.get(other.ref)
    if mine is None or theirs is None or mine.text != theirs.text:
        return False
    table = _NUMBERED.fullmatch(mine.text)
    served, also = (set(case.destinations.get(well, ())) for well in (one, other))
    if table is None or not served or not also or served & also:
        return False
    others = {
        ref
        for ref, assigned in case.roles.by_well.items()
        if assigned.text != mine.text and assigned.text.startswith(table[1])
    }
    return all(
        any(source.ref in others for source in case.meant.get(well, {})) for well in served | also
    )


def _by_one_statement(one: Well, other: Well) -> bool:
    """Whether some line of the protocol draws from both."""
    lines = {v.line for v in one.visits if v.kind is OperationKind.ASPIRATE}
    return any(v.line in lines for v in other.visits if v.kind is OperationKind.ASPIRATE)
