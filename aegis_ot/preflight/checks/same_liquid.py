"""Which wells hold the same liquid: by name, by load, and by how the run draws from them."""

from __future__ import annotations

from collections.abc import Mapping

from ...instrumentation import OperationKind
from ..roles import Roles
from ..rules import Common
from ..source import name_without_level, without_strength
from ..trace import Trace, Well


class SameLiquid:
    """Tells whether two wells hold the same liquid, as far as roles, names and their use say."""

    def __init__(
        self,
        trace: Trace,
        roles: Roles,
        common: Common,
        destinations: Mapping[Well, Mapping[Well, int]],
    ) -> None:
        self._trace = trace
        self._roles = roles
        self._common = common
        self._destinations = destinations
        self._known: dict[tuple[Well, Well], bool] = {}

    def __call__(self, one: Well, other: Well) -> bool:
        """Whether both hold the same liquid."""
        known = self._known.get((one, other))
        if known is None:
            known = self._known[one, other] = self._tell(one, other)
        return known

    def _tell(self, one: Well, other: Well) -> bool:
        if one is other or one.ref == other.ref or self._is_one_source(one, other):
            return True
        roles = self._roles
        if (
            one.liquids
            and one.liquids == other.liquids
            and any(map(str.isdigit, without_strength(one.liquids[0])))
            and roles.level(one.ref) == roles.level(other.ref)
        ):
            return True
        if {one.ref, other.ref} <= roles.unnamed and one.liquids == other.liquids:
            return one.ref not in roles.apart
        mine, theirs = roles.by_well.get(one.ref), roles.by_well.get(other.ref)
        if mine is None or theirs is None or mine.role != theirs.role:
            return False
        if not roles.family.roles[mine.role].one_liquid:
            return False
        dull = self._common.undescriptive
        return name_without_level(mine.text, dull) == name_without_level(theirs.text, dull)

    def _is_one_source(self, one: Well, other: Well) -> bool:
        """Whether one list or loop uses two wells of reservoirs as one liquid.

        One statement draws from both, under one name, each for wells of its own. What is given to
        the same wells one after the other is two liquids, and doses have a well each.
        """
        infos = [self._trace.labware.get(well.ref.labware) for well in (one, other)]
        if any(info is None or not info.centers_channels for info in infos):
            return False
        mine, theirs = (self._roles.by_well.get(well.ref) for well in (one, other))
        if (mine and mine.text) != (theirs and theirs.text):
            return False
        if mine and self._roles.family.roles[mine.role].dosed:
            return False
        if one.liquids != other.liquids or self._roles.level(one.ref) != self._roles.level(
            other.ref
        ):
            return False
        served, also = (self._destinations.get(well, {}).keys() for well in (one, other))
        # A channel that runs dry may go half and half with the next one into one well.
        return len(served & also) <= 1 and not _drawing_lines(one).isdisjoint(_drawing_lines(other))


def _drawing_lines(well: Well) -> set[int | None]:
    return {visit.line for visit in well.visits if visit.kind is OperationKind.ASPIRATE}
