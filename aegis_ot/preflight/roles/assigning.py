"""Decides what each well is for, within one assay family, and keeps the evidence.

Stronger evidence beats weaker; among names, those of fewer wells beat those of many, and a
labware's name speaks only for wells that nothing else speaks for. What is not said stays
unsaid: a well without evidence has no role, and rules that need one are undecided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..evidence import Clue, Strength, are_one, levels_beside, levels_of, without_lone_middle
from ..rules import Common, Family
from ..text import Lexicon, Rank, concentration_in, concentrations_in, name_without_level, tokens
from ..trace import Sides, Trace, Usage, in_trough
from .channels import spread_over_channels
from .choosing import A_FEW, Candidate, choose
from .fed_to_controls import unsay_controls
from .fitting import fitting_role, is_for_controls, named_by
from .for_all import unsay_for_all
from .given_on import unsay_contents
from .labware_roles import called_after, held_before, named_apart, of_several, shared
from .phrases import (
    is_outright,
    joins_others,
    names_several,
    of_its_dict,
    roles_denied,
    says_only_a_place,
    says_only_the_side,
    what_all_are,
    without_differing,
)
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
    candidates: dict[WellRef, list[Candidate]] = {}
    sides = Sides(usage)
    first_of = {
        ref: first
        for first, group in trace.groups.items()
        for ref in group
        if ref != first and not {ref, first} & trace.singles
    }
    named_outright: set[str] = set()
    for_controls: set[WellRef] = set()
    outright_liquids: set[WellRef] = set()
    loaded = {ref for clue in clues if clue.strength is Strength.LIQUID for ref in clue.wells}
    untold: list[Clue] = []
    misplaced: list[Clue] = []
    holding = of_several(clues, lexicon, common, roles)
    holding_of = called_after(clues, lexicon, common)
    apart = named_apart(clues, lexicon, common)
    for clue in sorted(clues, key=lambda clue: bool(clue.step)):
        named = named_by(lexicon, clue, common, roles)
        plural = clue.text.endswith(_PLURAL) and len(clue.wells) >= _SEVERAL
        if plural or (clue.whole and len(clue.wells) > 1):
            named = without_differing(lexicon, clue, named, family)
        if not named:
            untold.append(clue)
            continue
        if all(sides(ref)[0] == "source" for ref in clue.wells):
            named = of_its_dict(lexicon, clue, named, common, roles)
        if clue.lone and names_several(lexicon, clue, common, roles):
            continue
        if clue.whole and any(not held.isdisjoint(named) for held in shared(clue, holding)):
            continue  # `bsa` holds "BSA strip + lysates"
        if clue.lone and clue.whole:
            named = what_all_are(named, roles)
        if clue.whole and clue.strength is Strength.COMMENT:
            # "Slot 2: samples and NTC" says of no well which it is.
            named = [role for role in named if not family.roles[role].parents]
        sentence = clue.lone and clue.strength is Strength.COMMENT
        if clue.whole and not sentence and joins_others(lexicon, clue.text, common):
            named = [role for role in named if not family.roles[role].implies_contents]
            if not named or len(clue.places) > 1:
                continue  # "vials and lysates": which are the lysates?
        side_only = says_only_the_side(clue, common)
        worth = _worth(clue, side_only, clue.whole or says_only_a_place(clue, common))
        if clue.strength is Strength.LIQUID and not names_several(lexicon, clue, common, roles):
            for ref in clue.wells:
                roles.of_liquid.setdefault(ref, set()).update(named)
            if is_outright(lexicon, " ".join(name_without_level(clue.text, common))):
                outright_liquids.update(clue.wells)
        elif (
            clue.strength is Strength.DESCRIPTION
            and is_outright(lexicon, clue.text)
            and not any(named[0] in roles.of_liquid.get(ref, ()) for ref in clue.wells)
            and outright_liquids.isdisjoint(clue.wells)
        ):
            # "steroid-free serum", described as "diluent"
            worth = (float(Strength.LIQUID), 2.0, *worth[2:])
        passing = side_only and clue.strength is Strength.LOOSE_NAME
        placed = False
        for ref, level in zip(clue.wells, levels_of(clue, common), strict=True):
            of_plate = holding_of.get(ref.labware, frozenset())
            role = fitting_role(named, roles, sides(ref), clue, common, of_plate)
            if role is None and not clue.whole and is_for_controls(named, sides(ref), roles):
                for_controls.add(ref)
            if role is None or (passing and in_trough(trace, ref.labware)):
                continue
            if clue.whole and ref in apart.get(clue.text, ()):
                continue
            placed = True
            if not clue.step and clue.strength >= Strength.DESCRIPTION and not clue.whole:
                named_outright.add(role)
            elif (
                clue.step
                and role in named_outright
                and (family.roles[role].one_liquid or ref in loaded)
            ):
                # The comment says what the step is for; which well holds that is said
                # elsewhere, and this may be another one by mistake, of another liquid.
                continue
            if clue.step and _is_beside_named(first_of.get(ref), candidates):
                continue  # its column is named by its first well
            if clue.step and any(_is_of_a_layout(c[2]) for c in candidates.get(ref, ())):
                continue  # the step is called after what it is for, by mistake or not
            if (
                level is not None
                and not clue.levels
                and any(family.roles[other].level == level for other in named if other != role)
            ):
                level = family.roles[role].level  # that of the blank, not of all standards
            candidates.setdefault(ref, []).append((worth, role, clue, level))
        if not placed:
            misplaced.append(clue)
            if clue.strength is Strength.LIQUID:
                roles.unnamed.update(clue.wells)
    _note_untold(roles, lexicon, untold)
    roles.told_levels = _levels_beside([*untold, *(c for c in misplaced if c.levels)], common)
    roles.untold = [*untold, *misplaced]
    _add_dosed(roles, candidates, sides, roles.untold, common)
    for first, group in trace.groups.items():
        if first in for_controls and first not in trace.singles:
            for_controls.update(group)
    # What other wells share their layout with first.
    for ref in sorted(candidates, key=lambda ref: any(c[2].copied_from for c in candidates[ref])):
        found = [c for c in candidates[ref] if _agrees_with_what_it_copies(roles, ref, c[2])]
        assignment = choose(roles, ref, found) if found else None
        if assignment is not None and not (ref in for_controls and assignment.whole):
            told = roles.told_levels.get(ref)
            if assignment.level is None or (
                told is not None and isinstance(assignment.level, Rank)
            ):
                assignment.level = told
            spec = family.roles[assignment.role]
            if spec.dosed and assignment.level == 0 and _is_said_to_be_none(found):
                continue  # "sorafenib 0 uM" is none
            roles.by_well[ref] = assignment
            counted = any(map(str.isdigit, assignment.text))
            if told and counted and spec.level is not None and spec.parents:
                assignment.role, assignment.level = spec.parents[0], told  # "S0 1.6 mg/ml"
    unsay_strengths(roles, common)
    settle_scales(roles)
    unsay_contents(roles, trace, held_before(roles, candidates))
    spread_over_channels(roles, trace, candidates)
    unsay_controls(roles, trace)
    unsay_for_all(roles, trace)
    spread_over_replicates(roles, trace)
    return roles


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


_SEVERAL = 3
"""Two wells may well hold one liquid."""

_PLURAL = ("s", "n")

_FEWEST_DOSES = 2


def _add_dosed(
    roles: Roles,
    candidates: dict[WellRef, list[Candidate]],
    sides: Sides,
    clues: Sequence[Clue],
    common: Common,
) -> None:
    """What is called by nothing but its concentration: "stauro 0.3 uM" beside "stauro 1 uM".

    Two supplements with a concentration each are no doses.
    """
    told: list[tuple[WellRef, tuple[str, ...], Clue, float]] = []
    series: dict[tuple[str, tuple[str, ...]], set[float]] = {}
    for clue in clues:
        if clue.whole or clue.step or not concentrations_in(clue.text):
            continue
        of_what = name_without_level(clue.text, common)
        doses = clue.levels or (concentration_in(clue.text),) * len(clue.wells)
        for ref, dose in zip(clue.wells, doses, strict=False):
            if dose is not None:
                told.append((ref, of_what, clue, dose))
                series.setdefault((ref.labware, of_what), set()).add(dose)
    for name, spec in roles.family.roles.items():
        for ref, of_what, clue, dose in told if spec.dosed else ():
            if sides(ref)[0] == spec.side and len(series[ref.labware, of_what]) >= _FEWEST_DOSES:
                worth = _worth(clue, False, False)
                candidates.setdefault(ref, []).append((worth, name, clue, dose))


def _is_said_to_be_none(found: Sequence[Candidate]) -> bool:
    """Whether what speaks for a well says "0"; the first of a rising list counts from 0 as well."""
    return any(level == 0 and "0" in tokens(clue.text) for _, _, clue, level in found)


def _is_of_a_layout(clue: Clue) -> bool:
    """Whether this lists what stands where: "A2: stop solution"."""
    few = len(clue.places) <= A_FEW
    return few and clue.strength is Strength.COMMENT and not clue.whole and not clue.step


def _is_beside_named(
    first: WellRef | None, candidates: Mapping[WellRef, Sequence[Candidate]]
) -> bool:
    """Whether the first well of a channel group has a name of its own."""
    named = candidates.get(first, ()) if first is not None else ()
    return any(
        not clue.whole and not clue.step and clue.strength >= Strength.LOOSE_NAME
        for _, _, clue, _ in named
    )


def _worth(clue: Clue, side_only: bool, of_the_labware: bool) -> tuple[float, ...]:
    return (
        float(clue.strength),
        0.0 if of_the_labware else 1.0,
        0.0 if side_only else 1.0,
        -float(len(clue.places)),
    )
