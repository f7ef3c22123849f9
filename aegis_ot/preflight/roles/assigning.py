"""Decides what each well is for, within one assay family, and keeps the evidence.

Stronger evidence beats weaker; among names, those of fewer wells beat those of many, and a
labware's name speaks only for wells that nothing else speaks for. What is not said stays
unsaid: a well without evidence has no role, and rules that need one are undecided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..evidence import Clue, Strength, are_one, levels_beside, without_lone_middle
from ..rules import Common, Family
from ..text import Lexicon, Rank, tokens
from ..trace import Trace, Usage
from .candidates import Candidates
from .channels import spread_over_channels
from .choosing import Candidate, choose
from .fed_to_controls import unsay_controls
from .for_all import unsay_for_all
from .given_on import unsay_contents
from .labware_roles import held_before
from .phrases import roles_denied
from .replicates import spread_over_replicates
from .role_words import role_words
from .roles import Roles
from .strengths import settle_scales, unsay_strengths


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
    common = without_lone_middle(common, clues)
    roles = Roles(family)
    lexicon = role_words(family, common)
    heard = Candidates(roles, lexicon, common, clues, usage, trace)
    for clue in sorted(clues, key=lambda clue: bool(clue.step)):
        heard.hear(clue)
    _note_untold(roles, lexicon, heard.untold)
    with_levels = [clue for clue in heard.misplaced if clue.levels]
    roles.told_levels = _levels_beside([*heard.untold, *with_levels], common)
    roles.untold = [*heard.untold, *heard.misplaced]
    heard.add_dosed(roles.untold)
    _decide(roles, heard)
    unsay_strengths(roles, common)
    settle_scales(roles)
    unsay_contents(roles, trace, held_before(roles, heard.of_well))
    spread_over_channels(roles, trace, heard.of_well)
    unsay_controls(roles, trace)
    unsay_for_all(roles, trace)
    spread_over_replicates(roles, trace)
    return roles


def _decide(roles: Roles, heard: Candidates) -> None:
    """Give each well what speaks loudest for it, with its level."""
    of_well, for_controls = heard.of_well, heard.for_controls
    # What other wells share their layout with first.
    for ref in sorted(of_well, key=lambda ref: any(c[2].copied_from for c in of_well[ref])):
        found = [c for c in of_well[ref] if _agrees_with_what_it_copies(roles, ref, c[2])]
        assignment = choose(roles, ref, found) if found else None
        if assignment is None or (ref in for_controls and assignment.whole):
            continue
        told = roles.told_levels.get(ref)
        if assignment.level is None or (told is not None and isinstance(assignment.level, Rank)):
            assignment.level = told
        spec = roles.family.roles[assignment.role]
        if spec.dosed and assignment.level == 0 and _is_said_to_be_none(found):
            continue  # "sorafenib 0 uM" is none
        roles.by_well[ref] = assignment
        counted = any(map(str.isdigit, assignment.text))
        if told and counted and spec.level is not None and spec.parents:
            assignment.role, assignment.level = spec.parents[0], told  # "S0 1.6 mg/ml"


def _agrees_with_what_it_copies(roles: Roles, ref: WellRef, clue: Clue) -> bool:
    """Whether evidence that is copied from other wells is what decided these, if anything did.

    They may also hold the reagent that makes it: water makes an NTC.
    """
    specs = roles.family.roles
    of = [one for one, copy in zip(clue.copied_from, clue.wells, strict=False) if copy == ref]
    known = [roles.by_well[one] for one in of if one in roles.by_well]
    return all(
        specs[assigned.role].one_liquid or any(map(clue.said.startswith, assigned.evidence))
        for assigned in known
    )


def _note_untold(roles: Roles, lexicon: Lexicon, untold: Sequence[Clue]) -> None:
    """What clues that name no role still say: that a liquid is unknown, or what it is not."""
    for clue in untold:
        if clue.strength is Strength.LIQUID:
            roles.unnamed.update(clue.wells)
        if clue.strength >= Strength.DESCRIPTION and not clue.whole:
            for denied in roles_denied(lexicon, clue.text):
                roles.denied.setdefault(denied, set()).update(clue.wells)


def _levels_beside(untold: Sequence[Clue], common: Common) -> dict[WellRef, float]:
    """The one level that clues without a word for what they hold give each of their wells.

    What is said of several at once ("11x A1-B1") gives way to what is said of each, a place in a
    rising row to an amount.
    """
    of_each: dict[WellRef, set[float]] = {}
    of_several: dict[WellRef, set[float]] = {}
    for clue in untold:
        levels = of_each if clue.levels or len(clue.places) == 1 else of_several
        for ref, level in zip(clue.wells, levels_beside(clue, common), strict=False):
            if level is not None:
                levels.setdefault(ref, set()).add(level)
    told = {
        ref: {level for level in levels if not isinstance(level, Rank)} or levels
        for ref, levels in {**of_several, **of_each}.items()
    }
    return {ref: min(levels) for ref, levels in told.items() if are_one(levels)}


def _is_said_to_be_none(found: Sequence[Candidate]) -> bool:
    """Whether what speaks for a well says "0"; the first of a rising list counts from 0 as well."""
    return any(level == 0 and "0" in tokens(clue.text) for _, _, clue, level in found)
