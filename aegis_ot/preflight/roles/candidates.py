"""All that speaks for each well in the eyes of one assay family, before one of it is chosen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..evidence import Clue, Strength, levels_of
from ..rules import Common
from ..text import Lexicon, concentration_in, concentrations_in, name_without_level
from ..trace import Sides, Trace, Usage, in_trough
from .choosing import A_FEW, Candidate
from .fitting import fitting_role, is_for_controls, named_by
from .labware_roles import called_after, named_apart, of_several, shared
from .phrases import (
    is_outright,
    joins_others,
    names_several,
    of_its_dict,
    says_only_a_place,
    says_only_the_side,
    what_all_are,
    without_differing,
)
from .roles import Roles

_SEVERAL = 3
"""Two wells may well hold one liquid."""

_PLURAL = ("s", "n")

_FEWEST_DOSES = 2


class Candidates:
    """Hears clues, one after the other, and keeps which roles they name for which wells.

    Args:
        roles: Where is noted which liquids have a name, and which have none.
        lexicon: The words for the family's roles.
        common: Words for levels.
        clues: All evidence; what some of it says of whole labware counts beside the rest.
        usage: How the run uses each well.
        trace: For the columns that multi-channel pipettes reach.

    Attributes:
        of_well: For each well what speaks for it: how much it is worth, the role, the clue and the
            level.
        for_controls: Wells which a name says to be for controls.
        untold: Clues that name no role.
        misplaced: Clues of which no role fits how the run uses any of their wells.
    """

    def __init__(
        self,
        roles: Roles,
        lexicon: Lexicon,
        common: Common,
        clues: Sequence[Clue],
        usage: Mapping[WellRef, Usage],
        trace: Trace,
    ) -> None:
        self.of_well: dict[WellRef, list[Candidate]] = {}
        self.untold: list[Clue] = []
        self.misplaced: list[Clue] = []
        self._roles, self._lexicon, self._common, self._trace = roles, lexicon, common, trace
        self._sides = Sides(usage)
        self._first_of = {
            ref: first
            for first, group in trace.groups.items()
            for ref in group
            if ref != first and not {ref, first} & trace.singles
        }
        self._named_outright: set[str] = set()
        self._for_controls: set[WellRef] = set()
        self._outright_liquids: set[WellRef] = set()
        self._loaded = {
            ref for clue in clues if clue.strength is Strength.LIQUID for ref in clue.wells
        }
        self._holding = of_several(clues, lexicon, common, roles)
        self._holding_of = called_after(clues, lexicon, common)
        self._apart = named_apart(clues, lexicon, common)

    @property
    def for_controls(self) -> set[WellRef]:
        """Wells which a name says to be for controls, and those of the same channel groups."""
        found = set(self._for_controls)
        for first, group in self._trace.groups.items():
            if first in found and first not in self._trace.singles:
                found.update(group)
        return found

    def hear(self, clue: Clue) -> None:
        """Note which roles a clue names for which of its wells."""
        named = named_by(self._lexicon, clue, self._common, self._roles)
        plural = clue.text.endswith(_PLURAL) and len(clue.wells) >= _SEVERAL
        if plural or (clue.whole and len(clue.wells) > 1):
            named = without_differing(self._lexicon, clue, named, self._roles.family)
        if not named:
            self.untold.append(clue)
            return
        meant = self._meant(clue, named)
        if meant is None or self._place(clue, meant, self._weighed(clue, meant)):
            return
        self.misplaced.append(clue)
        if clue.strength is Strength.LIQUID:
            self._roles.unnamed.update(clue.wells)

    def _meant(self, clue: Clue, named: list[str]) -> list[str] | None:
        """Which of the roles that a clue names it can mean; ``None`` where it tells none of its
        wells from the others.
        """
        roles, lexicon, common = self._roles, self._lexicon, self._common
        specs = roles.family.roles
        if all(self._sides(ref)[0] == "source" for ref in clue.wells):
            named = of_its_dict(lexicon, clue, named, common, roles)
        if clue.lone and names_several(lexicon, clue, common, roles):
            return None
        if clue.whole and any(not held.isdisjoint(named) for held in shared(clue, self._holding)):
            return None  # `bsa` holds "BSA strip + lysates"
        if clue.lone and clue.whole:
            named = what_all_are(named, roles)
        if clue.whole and clue.strength is Strength.COMMENT:
            # "Slot 2: samples and NTC" says of no well which it is.
            named = [role for role in named if not specs[role].parents]
        sentence = clue.lone and clue.strength is Strength.COMMENT
        if clue.whole and not sentence and joins_others(lexicon, clue.text, common):
            named = [role for role in named if not specs[role].implies_contents]
            if not named or len(clue.places) > 1:
                return None  # "vials and lysates": which are the lysates?
        return named

    def _weighed(self, clue: Clue, named: Sequence[str]) -> tuple[float, ...]:
        """How much a clue is worth, beside what was heard before; liquids with a name are noted."""
        lexicon, common = self._lexicon, self._common
        of_the_labware = clue.whole or says_only_a_place(clue, common)
        worth = _worth(clue, says_only_the_side(clue, common), of_the_labware)
        of_liquid = self._roles.of_liquid
        if clue.strength is Strength.LIQUID and not names_several(
            lexicon, clue, common, self._roles
        ):
            for ref in clue.wells:
                of_liquid.setdefault(ref, set()).update(named)
            if is_outright(lexicon, " ".join(name_without_level(clue.text, common))):
                self._outright_liquids.update(clue.wells)
        elif (
            clue.strength is Strength.DESCRIPTION
            and is_outright(lexicon, clue.text)
            and not any(named[0] in of_liquid.get(ref, ()) for ref in clue.wells)
            and self._outright_liquids.isdisjoint(clue.wells)
        ):
            # "steroid-free serum", described as "diluent"
            return (float(Strength.LIQUID), 2.0, *worth[2:])
        return worth

    def _place(self, clue: Clue, named: list[str], worth: tuple[float, ...]) -> bool:
        """Note the role that fits each well of a clue; whether one fits any of them."""
        roles, common, sides = self._roles, self._common, self._sides
        passing = clue.strength is Strength.LOOSE_NAME and says_only_the_side(clue, common)
        placed = False
        for ref, level in zip(clue.wells, levels_of(clue, common), strict=True):
            of_plate = self._holding_of.get(ref.labware, frozenset())
            role = fitting_role(named, roles, sides(ref), clue, common, of_plate)
            if role is None and not clue.whole and is_for_controls(named, sides(ref), roles):
                self._for_controls.add(ref)
            if role is None or (passing and in_trough(self._trace, ref.labware)):
                continue
            if clue.whole and ref in self._apart.get(clue.text, ()):
                continue
            placed = True
            if not clue.step:
                if clue.strength >= Strength.DESCRIPTION and not clue.whole:
                    self._named_outright.add(role)
            elif self._says_only_the_aim(ref, role):
                continue
            others = (roles.family.roles[other].level for other in named if other != role)
            if level is not None and not clue.levels and level in others:
                level = roles.family.roles[role].level  # that of the blank, not of all standards
            self.of_well.setdefault(ref, []).append((worth, role, clue, level))
        return placed

    def _says_only_the_aim(self, ref: WellRef, role: str) -> bool:
        """Whether a comment beside a step says what that is for, and not what its well holds."""
        spec = self._roles.family.roles[role]
        if role in self._named_outright and (spec.one_liquid or ref in self._loaded):
            # Which well holds that is said elsewhere, and this may be another one by mistake, of
            # another liquid.
            return True
        if self._is_beside_named(ref):
            return True  # its column is named by its first well
        # The step is called after what it is for, by mistake or not.
        return any(_is_of_a_layout(clue) for _, _, clue, _ in self.of_well.get(ref, ()))

    def _is_beside_named(self, ref: WellRef) -> bool:
        """Whether the first well of a well's channel group has a name of its own."""
        first = self._first_of.get(ref)
        return any(
            not clue.whole and not clue.step and clue.strength >= Strength.LOOSE_NAME
            for _, _, clue, _ in (self.of_well.get(first, ()) if first is not None else ())
        )

    def add_dosed(self, clues: Sequence[Clue]) -> None:
        """What is called by nothing but its concentration: "stauro 0.3 uM" beside "stauro 1 uM".

        Two supplements with a concentration each are no doses.
        """
        told: list[tuple[WellRef, tuple[str, ...], Clue, float]] = []
        series: dict[tuple[str, tuple[str, ...]], set[float]] = {}
        for clue in clues:
            if clue.whole or clue.step or not concentrations_in(clue.text):
                continue
            of_what = name_without_level(clue.text, self._common)
            doses = clue.levels or (concentration_in(clue.text),) * len(clue.wells)
            for ref, dose in zip(clue.wells, doses, strict=False):
                if dose is not None:
                    told.append((ref, of_what, clue, dose))
                    series.setdefault((ref.labware, of_what), set()).add(dose)
        for name, spec in self._roles.family.roles.items():
            for ref, of_what, clue, dose in told if spec.dosed else ():
                several = len(series[ref.labware, of_what]) >= _FEWEST_DOSES
                if several and self._sides(ref)[0] == spec.side:
                    worth = _worth(clue, False, False)
                    self.of_well.setdefault(ref, []).append((worth, name, clue, dose))


def _is_of_a_layout(clue: Clue) -> bool:
    """Whether this lists what stands where: "A2: stop solution"."""
    few = len(clue.places) <= A_FEW
    return few and clue.strength is Strength.COMMENT and not clue.whole and not clue.step


def _worth(clue: Clue, side_only: bool, of_the_labware: bool) -> tuple[float, ...]:
    return (
        float(clue.strength),
        0.0 if of_the_labware else 1.0,
        0.0 if side_only else 1.0,
        -float(len(clue.places)),
    )
