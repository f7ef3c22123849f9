"""Which of the roles that a text names fits how the run uses a well."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import pairwise

from ..evidence import Clue, Strength
from ..rules import Common
from ..text import Lexicon, first_words, lexicon_of, listed_levels, tokens, words_of
from .phrases import names_any, parts_joined, roles_named, unlike
from .roles import Roles


def _joins(clue: Clue, common: Common) -> bool:
    """Whether a word of a clue joins several things."""
    return not first_words(common.joining).isdisjoint(tokens(clue.text))


def _ambiguous(fitting: Sequence[str], roles: Roles, clue: Clue, common: Common) -> bool:
    """A text that joins several different things speaks of none of them in particular.

    In a name the last word is the head, unless the name joins several with "and".
    """
    if clue.subject and not _joins(clue, common):
        return False
    return unlike(fitting, roles)


def _made_of_a_reagent(
    fitting: Sequence[str], roles: Roles, side: str, clue: Clue, common: Common
) -> str | None:
    """The NTC in "H3: water (NTC)": what the well is, beside the reagent that it is made of."""
    specs = roles.family.roles
    passed_on = [role for role in fitting if specs[role].passed_on]
    # One well is one thing, "H12 is left for the NTC and is filled with water", but a tube may be
    # drawn from for several: "water and NTC".
    one = len(clue.places) == 1 and (side != "source" or _goes_on(clue, common))
    several = not one and _joins(clue, common)
    if clue.subject or clue.step or len(passed_on) != 1 or several:
        return None
    reagents = all(specs[role].one_liquid for role in fitting if role not in passed_on)
    return passed_on[0] if reagents else None


def _goes_on(clue: Clue, common: Common) -> bool:
    """Whether a clause about the same thing follows a word that joins: "... and is filled"."""
    words, joining, verbs = tokens(clue.text), first_words(common.joining), words_of(common.means)
    return any(one in joining and other in verbs for one, other in pairwise(words))


_A_PLATE = 6


def _is_plate_of(clue: Clue) -> bool:
    """Whether a liquid stood in so many wells before the run that it was in a plate, not tubes."""
    return clue.strength is Strength.LIQUID and len(clue.places) >= _A_PLATE


def fitting_role(
    named: Iterable[str],
    roles: Roles,
    sides: tuple[str, bool],
    clue: Clue,
    common: Common,
    of_plate: frozenset[str] = frozenset(),
) -> str | None:
    """The first named role whose side agrees with how the run uses the well.

    ``of_plate``: what its plate is called after, cells say.
    """
    named = list(dict.fromkeys(named))
    if clue.strength is Strength.GIVEN:
        return named[0]
    specs = roles.family.roles
    side, passes_on = sides
    if clue.step and clue.step != side:
        return None
    fitting = [role for role in named if specs[role].side in ("any", side)]
    if clue.whole and side == "destination" and not passes_on:
        # "TaqMan" on a plate of reactions names the assay; the mix would be given on.
        fitting = [role for role in fitting if not specs[role].one_liquid]
    if passes_on and not _is_plate_of(clue) and any(specs[role].side == "source" for role in named):
        # A plate of doses that is made here and given on is no plate of treated cells; a plate
        # of samples that is given on was one of samples before, and only gets buffer here.
        fitting = [
            role
            for role in fitting
            if not specs[role].implies_contents
            or not of_plate.isdisjoint(roles.closure(role) - {role})  # cells, to be harvested
            or (specs[role].side == side and role in specs[role].filled_by)
        ]
    of_wells = not clue.whole or _is_dried(clue, common)
    if not fitting and passes_on and of_wells and clue.strength is not Strength.COMMENT:
        fitting = [role for role in named if specs[role].side == "source"]
    if made_of := _made_of_a_reagent(fitting, roles, side, clue, common):
        return made_of
    if blank := _said_beside_brackets(fitting, roles, clue):
        return blank
    said, fitting = fitting, _finer(fitting, roles)
    if not fitting or _ambiguous(fitting, roles, clue, common):
        return None
    if clue.subject and is_for_controls(named, sides, roles) and _treats(fitting[0], roles):
        return None
    return _general(fitting[0], said, roles, clue) if _is_of_a_series(clue) else fitting[0]


def _is_dried(clue: Clue, common: Common) -> bool:
    """Whether a text speaks of what is there without liquid: "lyophilised oligos"."""
    return bool(lexicon_of({"dried": common.dried}).find(clue.text))


def is_for_controls(named: Sequence[str], sides: tuple[str, bool], roles: Roles) -> bool:
    """Whether a source is named as what controls are given: a control siRNA is no treatment."""
    specs = roles.family.roles
    return sides[0] == "source" and specs[named[0]].replicated and not specs[named[0]].receives


def _said_beside_brackets(fitting: Sequence[str], roles: Roles, clue: Clue) -> str | None:
    """The blank in "blank (elution buffer)", which says in brackets what it is made of, and the
    one in "elution buffer (blank)".
    """
    said = [tokens(part) for part in re.split(r"[()]", clue.text) if tokens(part)]
    for role in fitting if len(said) == 2 and "(" in clue.text else ():
        spec = roles.family.roles[role]
        if spec.level is not None and any(part in map(tokens, spec.words) for part in said):
            return role
    return None


def _finer(fitting: list[str], roles: Roles) -> list[str]:
    """The vehicle in "PBS (vehicle)": what a medium is used as, where both are said.

    And the vehicle control in "vehicle (mock)": of a kind and its parent, the kind.
    """
    kinds = [role for role in fitting[1:] if fitting[0] in roles.closure(role)]
    uses = [
        (role, use) for role in fitting for use in roles.family.roles[role].may_be if use in fitting
    ]
    pairs = (*uses, *((fitting[0], kind) for kind in kinds))
    if not pairs:
        return fitting
    role, finer = pairs[0]
    return [finer, *(r for r in fitting if r not in (role, finer))]


def _treats(role: str, roles: Roles) -> bool:
    """Whether wells that receive this are called after that."""
    return any(role in spec.receives for spec in roles.family.roles.values() if spec.replicated)


_A_SERIES = 3


def _is_of_a_series(clue: Clue) -> bool:
    """Whether a comment speaks of so many wells that they are not all its one blank."""
    return clue.strength is Strength.COMMENT and len(clue.places) >= _A_SERIES


def _general(first: str, said: Sequence[str], roles: Roles, clue: Clue) -> str:
    """The role that all of a series have: "standards, H1 = blank" are standards, and so are
    those of "BSA 0, 0.5, 1 mg/ml".
    """
    if roles.family.roles[first].level is None:
        return first
    above = [role for role in said if role in roles.closure(first) - {first}]
    if not above and len(listed_levels(clue.text)) > 1:
        above = list(roles.family.roles[first].parents)
    return above[0] if above else first


def named_by(lexicon: Lexicon, clue: Clue, common: Common, roles: Roles) -> list[str]:
    """The roles that a clue may give its wells, the likeliest first."""
    if clue.role in roles.family.roles:
        return [clue.role]
    named = roles_named(lexicon, clue, common)
    named = _without_partly_undosed(lexicon, clue, named, common, roles)
    if clue.step and len(clue.wells) > 1:
        named = _said_of_all_drawn(lexicon, clue, named, common, roles)
    return named


def _without_partly_undosed(
    lexicon: Lexicon, clue: Clue, named: Sequence[str], common: Common, roles: Roles
) -> list[str]:
    """The roles without that of an undosed well where a text lacks one drug and has another:
    "cisplatin, no nutlin".
    """
    found = list(lexicon.find(clue.text))
    lacking, free = first_words(common.lacking), first_words(common.free_of)
    undosed: set[str] = set()
    for name, spec in roles.family.roles.items():
        dosing = {name, *spec.receives}
        for role in spec.undosed:
            said = [tokens(match.phrase) for match in found if match.topic == role]
            in_part = any(words[0] in lacking or words[-1] in free for words in said)
            if in_part and any(match.topic in dosing for match in found):
                undosed.update(other for other in named if role in roles.closure(other))
    return [role for role in named if role not in undosed]


def _said_of_all_drawn(
    lexicon: Lexicon, clue: Clue, named: Sequence[str], common: Common, roles: Roles
) -> list[str]:
    """What a comment beside a step says of all that is drawn there.

    "Standards, blank upwards" are not all blanks, and "controls and water" is not all water.
    """
    controls = lexicon_of({"control": common.controls}, common.aliases, common.endings)
    parts = parts_joined(clue.text, common, lambda piece: piece.strip() in ("/", "+", "&"))
    if any(controls.find(part) and not names_any(lexicon, part) for part in parts):
        return []
    specs = roles.family.roles
    return [
        role
        for role in named
        if specs[role].level is None or roles.closure(role).isdisjoint({*named} - {role})
    ]
