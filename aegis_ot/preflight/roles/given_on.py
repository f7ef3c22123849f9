"""Wells that are filled in the run and given on to cells hold no cells themselves.

``{"siCtrl": prep["A1"]}`` on a plate of complexes names what is made there, not a control well.
"""

from __future__ import annotations

from collections.abc import Collection

from ..evidence import Strength
from ..trace import Trace
from .roles import Roles


def unsay_contents(roles: Roles, trace: Trace, holding: Collection[str]) -> None:
    """Forget what names a well as one of a plate of cells, say, where other plates are those.

    Unless it is more than a comment that says so, and nothing of it goes to those plates.

    Args:
        roles: Of one family.
        trace: For what is given on.
        holding: Keys of the labware that a label, a name or a liquid says to hold it.
    """
    specs = roles.family.roles
    named = {
        ref: assigned.strength
        for ref, assigned in roles.by_well.items()
        if specs[assigned.role].implies_contents
        and specs[assigned.role].replicated
        and ref.labware not in holding
    }
    if not holding or not named:
        return
    given_on = {
        source.ref
        for source, well, _ in trace.feedings()
        if source.ref in named and well.ref.labware in holding
    }
    for ref, strength in named.items():
        if ref in given_on or strength <= Strength.COMMENT:
            del roles.by_well[ref]
