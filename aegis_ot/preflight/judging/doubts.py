"""What an undecided rule lacks, and what the protocol's author can write to decide it."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import islice

from ...vocabulary import Undecided, WellRef
from ..checks import Doubt, RuleContext
from ..roles import Roles
from ..rules import RuleSpec
from ..trace import places
from .interpretation import Interpretation

UNKNOWN_ASSAY = Doubt("the assay is not known")
"""What is open in a family that is no more than a guess."""

RIGHT_WELLS = "write, with the right wells only"

_MOST_SHOWN = 3
"""Labware that are offered for one role."""


def missing_needs(rule: RuleSpec, roles: Roles) -> list[str]:
    """The needs of a rule that no well is known for; ``"a|b"`` for either."""
    return [need for need in rule.needs if not any(map(roles.known, need.split("|")))]


def missing_roles(rule: RuleSpec, case: RuleContext, needs: Sequence[str]) -> Undecided:
    """A rule that ``needs`` roles which no well is known for, with the roles to be given."""
    names = [case.titles(need.split("|")) for need in needs]
    reason = f"nothing says which well is the {' and which the '.join(names)}"
    first = [need.split("|")[0] for need in needs]
    offered = pasted({role: _offered(role, case) for role in first})
    return Undecided(rule.id, reason, offered, RIGHT_WELLS)


def undecided_by(doubt: Doubt, rule: RuleSpec, case: RuleContext) -> Undecided:
    """What a check could not judge, with the roles or levels that would decide it."""
    if doubt is UNKNOWN_ASSAY:
        guess = f'@guard(assay="{case.family.family}")'
        return Undecided(rule.id, doubt.reason, guess, "write, if it is that")
    if doubt.roles_of:
        specs = case.family.roles.items()
        fitting = [role for role, spec in specs if spec.side in (doubt.side, "any")]
        finer = {role for role in fitting if case.family.closure(role) & set(fitting) - {role}}
        offered = (doubt.role,) if doubt.role else [role for role in fitting if role not in finer]
        how = RIGHT_WELLS if doubt.role else "write, with each of these wells in its one role"
        wells = spelled(well.ref for well in doubt.roles_of if well.ref not in case.roles.by_well)
        return Undecided(rule.id, doubt.reason, pasted(dict.fromkeys(offered, wells)), how)
    leveled: dict[str, dict[str, None]] = {}
    for well in doubt.levels_of:
        assigned = case.roles.by_well.get(well.ref)
        if assigned is not None:
            leveled.setdefault(assigned.role, {})[f"{places([well.ref])} = ..."] = None
    how = "write, with their concentrations" if leveled else "write"
    return Undecided(rule.id, doubt.reason, pasted(leveled), how)


def pasted(roles: Mapping[str, Collection[str]]) -> str:
    """The decorator that gives places their roles; empty without any."""
    # Texts and lists of texts in JSON are such as Python writes them as well.
    told = {role: list(wells) for role, wells in roles.items() if wells}
    return f"@guard(roles={json.dumps(told, ensure_ascii=False)})" if told else ""


def unnamed_wells(reading: Interpretation) -> tuple[WellRef, ...]:
    """Wells that the run uses and of which nothing says what they hold, in order."""
    roles = reading.roles[0] if reading.roles else None
    found = (well.ref for well in reading.trace.wells.values() if well.visits)
    return tuple(dict.fromkeys(ref for ref in found if roles is None or ref not in roles.by_well))


def _offered(role: str, case: RuleContext) -> list[str]:
    """Wells on the role's side of which nothing is known, as a guard takes them: to be cut down to
    the right ones. Where there are none, some well is called what it is not: that is no line to
    paste.
    """
    roles, family = case.roles, case.family
    side = family.roles[role].side
    used = (well.ref for well in case.trace.wells.values() if well.visits)
    fitting = [ref for ref in dict.fromkeys(used) if side in ("any", case.trace.sides(ref)[0])]
    unknown = [r for r in fitting if not roles.is_known(r) and r not in case.waste]
    return spelled(unknown, _MOST_SHOWN)


def spelled(wells: Iterable[WellRef], most: int | None = None) -> list[str]:
    """Wells as a guard's ``roles`` take them, ``"2:A1-H1,A3"``, a text for each labware."""
    by_labware: dict[str, dict[WellRef, None]] = {}
    for ref in wells:
        by_labware.setdefault(ref.labware, {})[ref] = None
    return [places(list(refs)) for refs in islice(by_labware.values(), most)]
