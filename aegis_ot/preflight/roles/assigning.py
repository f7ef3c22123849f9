"""Decides what each well is for, within one assay family, and keeps the evidence.

Stronger evidence beats weaker; among names, those of fewer wells beat those of many, and a
labware's name speaks only for wells that nothing else speaks for. What is not said stays
unsaid: a well without evidence has no role, and rules that need one are undecided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..rules import Common, Family
from ..trace import Trace
from .channels import spread_over_channels
from .clues import Clue, Strength
from .given_on import unsay_contents
from .helpers import unsay_controls
from .levels import levels_beside, levels_of
from .phrases import (
    fitting_role,
    is_for_controls,
    is_outright,
    joins_others,
    names_several,
    role_words,
    roles_denied,
    roles_named,
    says_only_a_place,
    says_only_the_side,
)
from .replicates import spread_over_replicates
from .roles import Assignment, Roles
from .usage import Sides, Usage

Candidate = tuple[tuple[float, ...], str, Clue, "float | None"]


def assign_roles(
    family: Family,
    common: Common,
    clues: Sequence[Clue],
    usage: Mapping[WellRef, Usage],
    trace: Trace,
) -> Roles:
    """Give each well the role that the strongest evidence names.

    Args:
        family: Whose roles and words.
        common: Words for levels.
        clues: All evidence.
        usage: How the run uses each well.
        trace: For the columns that multi-channel pipettes reach.
    """
    roles = Roles(family)
    lexicon = role_words(family, common)
    candidates: dict[WellRef, list[Candidate]] = {}
    sides = Sides(usage)
    first_of = {
        ref: first
        for first, group in trace.groups.items()
        for ref in group
        if ref != first and not {ref, first} & trace.singles
    }
    named_outright: set[str] = set()
    doubtful: set[WellRef] = set()
    for_controls: set[WellRef] = set()
    levels: dict[WellRef, set[float]] = {}
    for clue in sorted(clues, key=lambda clue: bool(clue.step)):
        named = [clue.role] if clue.role in family.roles else roles_named(lexicon, clue, common)
        if not named:
            if clue.strength is Strength.LIQUID:
                roles.unnamed.update(clue.wells)
            if clue.strength >= Strength.DESCRIPTION and not clue.whole:
                for denied in roles_denied(lexicon, clue.text):
                    roles.denied.setdefault(denied, set()).update(clue.wells)
            for ref, level in zip(clue.wells, levels_beside(clue, common), strict=False):
                if level is not None:
                    levels.setdefault(ref, set()).add(level)
            continue
        if clue.lone and names_several(lexicon, clue, common, roles):
            continue
        if clue.whole and joins_others(lexicon, clue.text):
            named = [role for role in named if not family.roles[role].implies_contents]
            if not named:
                continue
        side_only = says_only_the_side(clue, common)
        worth = _worth(clue, side_only, clue.whole or says_only_a_place(clue, common))
        if clue.strength is Strength.LIQUID and names_several(lexicon, clue, common, roles):
            doubtful.update(clue.wells)
        elif (
            clue.strength is Strength.DESCRIPTION
            and doubtful.issuperset(clue.wells)
            and is_outright(lexicon, clue.text)
        ):
            worth = (float(Strength.LIQUID), 2.0, *worth[2:])
        passing = side_only and clue.strength is Strength.LOOSE_NAME
        for ref, level in zip(clue.wells, levels_of(clue, common), strict=True):
            role = fitting_role(named, roles, sides(ref), clue)
            if role is None and not clue.whole and is_for_controls(named, sides(ref), roles):
                for_controls.add(ref)
            if role is None or (passing and _is_trough(trace, ref)):
                continue
            if not clue.step and clue.strength >= Strength.DESCRIPTION and not clue.whole:
                named_outright.add(role)
            elif clue.step and role in named_outright and family.roles[role].one_liquid:
                # The comment says what the step is for; which well holds that is said
                # elsewhere, and this may be another one by mistake.
                continue
            if clue.step and _is_beside_named(first_of.get(ref), candidates):
                continue  # its column is named by its first well
            if level is not None and any(
                family.roles[other].level == level for other in named if other != role
            ):
                level = family.roles[role].level  # that of the blank, not of all standards
            candidates.setdefault(ref, []).append((worth, role, clue, level))
    for first, group in trace.groups.items():
        if first in for_controls and first not in trace.singles:
            for_controls.update(group)
    for ref, found in candidates.items():
        assignment = _choose(roles, ref, found)
        if assignment is not None and not (ref in for_controls and assignment.whole):
            roles.by_well[ref] = assignment
            told = levels.get(ref, set())
            if assignment.level is None and len(told) == 1:
                assignment.level = told.pop()
    unsay_contents(roles, trace, _holding(roles, candidates))
    spread_over_channels(roles, trace)
    unsay_controls(roles, trace)
    spread_over_replicates(roles, trace)
    return roles


def _is_beside_named(
    first: WellRef | None, candidates: Mapping[WellRef, Sequence[Candidate]]
) -> bool:
    """Whether the first well of a channel group has a name of its own."""
    named = candidates.get(first, ()) if first is not None else ()
    return any(
        not clue.whole and not clue.step and clue.strength >= Strength.LOOSE_NAME
        for _, _, clue, _ in named
    )


def _holding(roles: Roles, candidates: Mapping[WellRef, Sequence[Candidate]]) -> set[str]:
    """Labware that its label, its name or a liquid says to have held something before the run."""
    return {
        ref.labware
        for ref, found in candidates.items()
        if any(
            roles.family.roles[role].implies_contents
            and (clue.whole or clue.strength is Strength.LIQUID)
            for _, role, clue, _ in found
        )
    }


def _is_trough(trace: Trace, ref: WellRef) -> bool:
    """Whether a well belongs to a reservoir, where reagents stand rather than samples."""
    info = trace.labware.get(ref.labware)
    return info is not None and info.centers_channels


def _worth(clue: Clue, side_only: bool, of_the_labware: bool) -> tuple[float, ...]:
    return (
        float(clue.strength),
        0.0 if of_the_labware else 1.0,
        0.0 if side_only else 1.0,
        -float(len(set(clue.wells))),
    )


def _put_declared_first(roles: Roles, found: list[Candidate]) -> None:
    """Of two lists that have a well in common by mistake, the one of controls says what it is.

    The other one says what is given to it. A list within the other says more exactly.
    """
    specs = roles.family.roles
    worth, role, clue, _ = found[0]
    if not specs[role].receives or clue.strength < Strength.NAME:
        return
    for at, (other_worth, other, hint, _) in enumerate(found[1:], 1):
        mine, theirs = set(clue.wells), set(hint.wells)
        if (
            other_worth[:-1] == worth[:-1]
            and specs[other].parents
            and not specs[other].receives
            and not (mine <= theirs or theirs <= mine)
        ):
            found.insert(0, found.pop(at))
            return


def _put_agreed_first(roles: Roles, found: list[Candidate]) -> bool:
    """Of names that are worth the same, the one that weaker evidence agrees with counts, if any.

    A helper's ``diluent`` was the stock once, by mistake: the deck's list says what stands there.
    """
    tied = [candidate for candidate in found if candidate[0] == found[0][0]]
    if len({role for _, role, _, _ in tied}) < 2:
        return False
    for _, role, clue, _ in found[len(tied) :]:
        agreed = [c for c in tied if c[1] in roles.closure(role) or role in roles.closure(c[1])]
        if agreed and not clue.whole and clue.strength < tied[0][2].strength:
            found[: len(tied)] = agreed + [c for c in tied if c not in agreed]
            return True
    return False


def _choose(roles: Roles, ref: WellRef, found: list[Candidate]) -> Assignment | None:
    found.sort(key=lambda candidate: candidate[0], reverse=True)
    _put_declared_first(roles, found)
    settled = _put_agreed_first(roles, found)
    worth, role, clue, _ = found[0]
    decisive = clue
    for _, other, hint, _ in found[1:]:
        # Weaker evidence may say more exactly what the stronger leaves open: the liquid says
        # "cells", the name says "vehicle_controls".
        exact = not hint.whole and hint.strength is not Strength.LOOSE_NAME
        said = exact or hint.strength == clue.strength
        if said and role != other and role in roles.closure(other):
            role, decisive = other, hint
    rivals = [
        candidate
        for candidate in found[1:]
        if candidate[0] == worth
        and candidate[1] != role
        and candidate[1] not in roles.closure(role)
        and role not in roles.closure(candidate[1])
    ]
    conflict = ""
    if rivals:
        conflict = f"{clue.said} against {rivals[0][2].said}"
        roles.conflicts.setdefault(conflict, []).append(ref)
        if clue.strength <= Strength.LOOSE_NAME and not settled:
            return None
    agreeing = [c for c in found if role in roles.closure(c[1]) or c[1] in roles.closure(role)]
    level = next((c[3] for c in agreeing if c[3] is not None), None)
    return Assignment(
        role,
        list(dict.fromkeys([decisive.said, *(c[2].said for c in agreeing)])),
        decisive.strength,
        clue.text,
        level,
        conflict,
        whole=all(c[2].whole for c in agreeing),
    )
