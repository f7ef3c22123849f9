"""Of all that speaks for a well, the evidence that decides what it is for, and at which level."""

from __future__ import annotations

from collections.abc import Sequence

from ...vocabulary import WellRef
from ..evidence import Clue, Strength
from ..text import Rank
from .roles import Assignment, Roles

A_FEW = 3
"""As many wells are named one by one; a layout's columns may be those of another plate."""

_WIDER = 1.5
"""A comment on a row may count wells at its edge that a list of the same wells leaves out."""

Candidate = tuple[tuple[float, ...], str, Clue, "float | None"]
"""How much a clue is worth, the role that it names, the clue, and the level that it gives."""


def choose(roles: Roles, ref: WellRef, found: list[Candidate]) -> Assignment | None:
    """What a well is for; ``None`` where weak evidence says two things that nothing settles.

    Args:
        roles: For the kinds of roles; contradictions are noted there.
        ref: The well.
        found: All that speaks for it; put in order, what decides first.
    """
    found.sort(key=lambda candidate: candidate[0], reverse=True)
    _put_exact_first(roles, found)
    _put_declared_first(roles, found)
    settled = _put_agreed_first(roles, found)
    worth, role, clue, _ = found[0]
    decisive = clue
    for _, other, hint, _ in found[1:]:
        # Weaker evidence may say more exactly what the stronger leaves open: the liquid says
        # "cells", the name says "vehicle_controls".
        exact = not hint.whole and hint.strength is not Strength.LOOSE_NAME
        if hint.strength is Strength.COMMENT and not clue.whole:
            exact = len(hint.places) <= _WIDER * len(clue.places)  # not of more than this
        said = exact or hint.strength == clue.strength
        finer = role in roles.closure(other) or other in roles.family.roles[role].may_be
        if said and role != other and finer:
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
    level = _level(agreeing)
    return Assignment(
        role,
        list(dict.fromkeys([decisive.said, *(c[2].said for c in agreeing)])),
        decisive.strength,
        _telling(clue, agreeing).text,
        level,
        conflict,
        whole=any(c[2].whole for c in agreeing) and all(_is_of_many(c[2]) for c in agreeing),
        named=found[0][1] if clue.strength > Strength.COMMENT else "",
    )


def _telling(clue: Clue, agreeing: Sequence[Candidate]) -> Clue:
    """What calls a well by its own name, where the name of its whole labware decides.

    Of a rack of "compounds", "row A = AZD (ATR inhibitor)".
    """
    own = (
        hint
        for _, _, hint, _ in agreeing
        if not (hint.whole or hint.step or hint.strength is Strength.LOOSE_NAME)
    )
    return next(own, clue) if clue.whole else clue


def _is_of_many(clue: Clue) -> bool:
    """Whether this is the name of a whole labware, or what is said beside many draws at once."""
    return clue.whole or (bool(clue.step) and len(clue.places) > 1)


def _put_declared_first(roles: Roles, found: list[Candidate]) -> None:
    """Of two lists that have a well in common by mistake, the one of controls says what it is.

    The other one says what is given to it. A list within the other says more exactly, and so
    does a comment that sets some of its wells apart as controls; doses of rows give way to a
    column of controls across them.
    """
    specs = roles.family.roles
    # The liquid's "cells" leaves open what a list of doses says of them.
    first = next((at for at, c in enumerate(found) if specs[c[1]].receives), 0)
    worth, role, clue, _ = found[first]
    general = all(c[1] in roles.closure(role) for c in found[:first])
    if not specs[role].receives or clue.strength < Strength.NAME or not general:
        return
    for at, (other_worth, other, hint, _) in enumerate(found[first + 1 :], first + 1):
        if not specs[other].parents or specs[other].receives:
            continue  # no control
        mine, theirs = clue.places, hint.places
        listed = other_worth[:-1] == worth[:-1] and not (mine <= theirs or theirs <= mine)
        remark = hint.strength is Strength.COMMENT and not hint.step
        set_apart = remark and hint.placed and theirs < mine
        across = remark and bool(clue.levels) and not (mine <= theirs or theirs <= mine)
        if listed or set_apart or across:
            found.insert(first, found.pop(at))
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


def _put_exact_first(roles: Roles, found: list[Candidate]) -> None:
    """What a layout says of one well ("H3: water, NTC") goes before its labware's other name.

    And before the name that a loop or a helper gives to several wells in turn.
    """
    _, role, clue, _ = found[0]
    in_turn = clue.strength is Strength.LOOSE_NAME and len(clue.places) > 1
    if clue.whole or in_turn:
        other = [
            c
            for c in found
            if not (c[2].whole or c[2].step or c[1] in roles.closure(role))
            and role not in roles.closure(c[1])
            and (_is_described(c[2]) or c[2].placed or len(c[2].places) <= A_FEW)
            and (clue.whole or len(c[2].places) == 1)
        ]
        found[:] = other + [c for c in found if c not in other]


def _is_described(clue: Clue) -> bool:
    """Whether the run itself says what stands in these very wells."""
    return clue.strength is Strength.DESCRIPTION


def _level(agreeing: Sequence[Candidate]) -> float | None:
    """The level that the strongest evidence gives.

    What is said of several wells at once ("vemurafenib 10x") gives way to what is said of each,
    and places in a list to amounts.
    """
    known = [(clue, level) for _, _, clue, level in agreeing if level is not None]
    each = [level for clue, level in known if clue.levels or len(clue.places) == 1]
    found = each or [level for _, level in known]
    return next((level for level in found if not isinstance(level, Rank)), next(iter(found), None))
