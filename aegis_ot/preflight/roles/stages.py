"""In which wells an assay is put together, and which only get what was made there."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from ...vocabulary import WellRef
from ..trace import Trace
from .roles import Roles


@dataclass(frozen=True)
class Stage:
    """The wells that get a reagent straight from where it stands, and those beside them.

    A product that goes on into a gel's plate or into a pool makes no reaction there; a mix that
    is made in one well and shared out to replicates does. Where wells that products go into are
    named for the role themselves, no stage is plain.

    Attributes:
        labware: Keys of the labware in which they stand; none if no stage is plain.
        given: The wells that get the reagent.
        served: For each well those that it is given on to.
    """

    labware: frozenset[str]
    given: frozenset[WellRef]
    served: Mapping[WellRef, set[WellRef]]

    def holds(self, ref: WellRef) -> bool:
        """Whether a well is of this stage, though it is given on.

        A dilution of template that goes on to where the reagent is, is none.
        """
        into = self.served.get(ref, set())
        goes_on_to_it = ref not in self.given and not self.given.isdisjoint(into)
        return ref.labware in self.labware and not goes_on_to_it and not is_shared_out(into)


def stage_of(roles: Roles, trace: Trace, role: str, reagent: frozenset[str]) -> Stage:
    """The stage at which wells for ``role`` get a liquid of the roles ``reagent``."""
    if not reagent:
        return Stage(frozenset(), frozenset(), {})
    served = trace.served()
    given = {
        well
        for ref, wells in served.items()
        if roles.has(ref, reagent)
        for well in wells
        if not roles.has(well, reagent) and not is_shared_out(served.get(well, set()))
    }
    keys = {ref.labware for ref in given}
    goes_on = {well for ref in given for well in served.get(ref, ()) if well not in given}
    named = any(
        role in roles.closure(roles.by_well[ref].role) for ref in goes_on & roles.by_well.keys()
    )
    return Stage(frozenset() if named else frozenset(keys), frozenset(given), served)


def is_shared_out(wells: set[WellRef]) -> bool:
    """Whether several of these stand in one labware: replicates of one mix."""
    return any(count > 1 for count in Counter(ref.labware for ref in wells).values())
