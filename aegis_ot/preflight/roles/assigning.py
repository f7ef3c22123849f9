"""Decides what each well is for, within one assay family, and keeps the evidence.

Stronger evidence beats weaker; among names, those of fewer wells beat those of many, and a
labware's name speaks only for wells that nothing else speaks for. What is not said stays
unsaid: a well without evidence has no role, and rules that need one are undecided.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from ...vocabulary import WellRef
from ..evidence import Evidence, Kind
from ..rules import Common, Family
from ..source import level_in
from ..trace import Trace
from .naming import FamilyWords
from .roles import Assignment, Roles


class RoleCandidate(NamedTuple):
    """A role that a piece of evidence names for a well, and how much that is worth."""

    worth: tuple[float, ...]
    role: str
    evidence: Evidence
    level: float | None


def assign_roles(
    words: FamilyWords, common: Common, evidence: Iterable[Evidence], trace: Trace
) -> Roles:
    """Give each well the role that the strongest evidence names, and that its use allows."""
    family = words.family
    roles = Roles(family)
    candidates: dict[WellRef, list[RoleCandidate]] = {}
    for one in evidence:
        named = words.of(one)
        placed = False
        if named:
            worth, control = _worth(one, words), words.has_word_of_control(one.text)
            fitting = functools.cache(partial(_fitting, named, family, one))
            fits = {fitting(trace.sides(ref)) for ref in one.wells} if one.whole else set()
            is_filled = any(role and family.roles[role].side == "destination" for role in fits)
        for ref, level in zip(one.wells, _levels(one, common), strict=True) if named else ():
            role = fitting(trace.sides(ref))
            if role and is_filled and family.roles[role].one_liquid:
                role = None  # `dil` on a plate that is filled in the run is no diluent
            if role and level and family.roles[role].level == 0:
                if one.levels:  # `standards[0]` is no blank
                    role = next(iter(family.roles[role].parents), None)
                else:  # "blank (5 mg/mL sucrose)" holds none of what is measured
                    level = 0.0
            if role is not None and family.roles[role].one_liquid:
                level = None  # "buffer 4x" is no dose
            if not one.whole:
                roles.marked.update([ref] if control else ())
                said = roles.also.setdefault(ref, {})
                said.update({name: max(one.kind, said.get(name, one.kind)) for name in named})
            if role is not None and not (family.roles[role].dosed and level == 0):
                placed = True
                candidates.setdefault(ref, []).append(RoleCandidate(worth, role, one, level))
        if not placed:
            roles.unread.append(one)
            if one.kind is Kind.LIQUID:
                roles.unnamed.update(one.wells)
    for ref, found in candidates.items():
        assigned = _chosen(roles, ref, found, is_filled=trace.sides(ref)[0] == "destination")
        if assigned is not None:
            roles.by_well[ref] = assigned
    _spread_over_channels(roles, trace)
    return roles


def _worth(one: Evidence, words: FamilyWords) -> tuple[float, ...]:
    kind = float(one.kind)
    if one.kind is Kind.DESCRIPTION and words.is_outright(one.text):
        kind = Kind.LIQUID + 0.5  # "steroid-free serum", described as "diluent"
    return (kind, 0.0 if one.whole else 1.0, -float(len(one.wells)))


def _levels(evidence: Evidence, common: Common) -> tuple[float | None, ...]:
    count = len(evidence.wells)
    if len(evidence.levels) == count:
        return evidence.levels
    if evidence.whole and count > 1:
        return (None,) * count
    said = level_in(evidence.text, common.levels, plain_numbers=evidence.is_name)
    return (said,) * count


def _fitting(
    named: Sequence[str], family: Family, evidence: Evidence, sides: tuple[str, bool]
) -> str | None:
    """The first named role whose side agrees with how the run uses the well."""
    if evidence.kind is Kind.GIVEN:
        return named[0]
    specs = family.roles
    side, passes_on = sides
    fitting = [role for role in named if specs[role].side in ("any", side)]
    if evidence.whole and side == "destination" and not passes_on:
        # "TaqMan" on a plate of reactions names the assay; the mix would be given on.
        fitting = [role for role in fitting if not specs[role].one_liquid]
    if not fitting:  # a tube called "DMSO vehicle control" holds the vehicle
        liquids = [liquid for role in named for liquid in specs[role].follows]
        fitting = [liquid for liquid in liquids if specs[liquid].side == side]
    if passes_on and any(specs[role].side == "source" for role in named):
        # A plate of doses that is made here and given on is no plate of treated cells.
        plates = {r for r in fitting if specs[r].implies_contents and specs[r].side == side}
        fitting = [role for role in fitting if role not in plates]
        if not fitting and not evidence.whole:
            fitting = [role for role in named if specs[role].side == "source"]
    # The vehicle control in "vehicle (mock)": of a kind and its parent, the kind; and the vehicle
    # in "PBS (vehicle)": what a medium is used as, where both are said.
    for role in fitting[:1]:
        finer = [r for r in fitting if role in family.closure(r) - {r} or r in specs[role].may_be]
        fitting = finer or fitting
    return fitting[0] if fitting else None


def _chosen(
    roles: Roles, ref: WellRef, found: list[RoleCandidate], is_filled: bool
) -> Assignment | None:
    """What a well is for; ``None`` where weak evidence says two things that nothing settles."""
    closure, are_kin = roles.family.closure, roles.family.are_kin
    found.sort(key=lambda candidate: candidate.worth, reverse=True)
    best = found[0]
    for other in found[1:]:
        # Weaker evidence may say more exactly what the stronger leaves open: the liquid says
        # "cells", the name says "vehicle_controls".
        finer = best.role in closure(other.role) - {other.role}
        if finer and not other.evidence.whole and other.evidence.kind is not Kind.PASSING_NAME:
            best = other
    rivals = [o for o in found if o.worth == best.worth and not are_kin(best.role, o.role)]
    conflict = ""
    if rivals:
        conflict = f"{best.evidence.citation} against {rivals[0].evidence.citation}"
        roles.conflicts.setdefault(conflict, []).append(ref)
        agreed = [other for other in found if other.worth < best.worth]
        # Of two lists that share a well by mistake, the one of controls says what it is: the other
        # one says what is given to it.
        declared = [one for one in (best, *rivals) if is_filled and roles.is_declared(one.role)]
        for one in declared or (best, *rivals):
            if declared or any(are_kin(one.role, other.role) for other in agreed):
                best = one
                break
        else:
            if best.evidence.kind <= Kind.PASSING_NAME:
                return None
    agreeing = [best, *(other for other in found if are_kin(best.role, other.role))]
    # By identity: each piece is there once, and comparing pieces of many wells is dear.
    evidence = {id(one.evidence): one.evidence for one in agreeing}
    level = next((one.level for one in agreeing if one.level is not None), None)
    return Assignment(best.role, tuple(evidence.values()), level, conflict)


def _spread_over_channels(roles: Roles, trace: Trace) -> None:
    """A name for the well that a multi-channel pipette is aimed at names its whole column.

    Only where the named well is never used alone, and the others have no better evidence; and not
    where several wells of the column are named alike: those that are left out are left empty.
    """
    named = {ref: one for ref, one in roles.by_well.items() if not one.whole}
    for first, group in trace.groups.items():
        assigned = roles.by_well.get(first)
        if assigned is None or first in trace.singles:
            continue
        alike = (named[ref].role for ref in group[1:] if first in named and ref in named)
        if any(roles.family.are_kin(role, assigned.role) for role in alike):
            continue
        for ref in group:
            other = roles.by_well.get(ref)
            weaker = other is None or (other.whole and not assigned.whole)
            if ref != first and ref not in trace.singles and weaker:
                roles.by_well[ref] = replace(assigned, conflict="")
