"""Checks on volumes that do not add up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...instrumentation import OperationKind
from ...vocabulary import Site
from ..trace import Imbalance, Well
from .base import Case, Check, Doubt, Result, Violation, at, place

_FAR_SHORT = 2.0
"""Where so many times more is drawn than the run has put in, the plate was filled by hand."""


@dataclass(frozen=True)
class VolumeBookkeeping(Check):
    """No well is filled beyond its capacity or drawn below what it holds.

    Wells of unknown volume are judged only by what the run put into them; so are plates from
    which so much is drawn that someone must have filled them by hand. A pause that does not say
    what is done in it leaves open whether someone filled or emptied wells.
    """

    name: ClassVar[str] = "volume_bookkeeping"

    def find(self, case: Case) -> Iterator[Result]:
        """Report the first imbalance of each kind in each well."""
        by_hand = {
            imbalance.well.ref.labware
            for imbalance in case.trace.imbalances
            if not imbalance.overfilled and _is_far_short(imbalance.well)
        }
        seen: set[tuple[int, bool]] = set()
        for imbalance in case.trace.imbalances:
            well = imbalance.well
            key = (id(well), imbalance.overfilled)
            if key in seen or (imbalance.overfilled and well.ref in case.waste):
                continue
            undeclared = not imbalance.overfilled and well.declared is None
            if undeclared and (
                well.ref in case.unsure
                or well.ref.labware in by_hand
                or well.generation  # brought by hand in a pause: nobody says what it holds
            ):
                continue  # it may have held what nobody declared
            seen.add(key)
            if undeclared and _is_mix(imbalance):
                yield Doubt(
                    f"{place(well)} is mixed with {imbalance.volume:.4g} µL {at(imbalance.line)}, "
                    f"and the run has put {imbalance.limit:.4g} µL there: it may have held more"
                )
                continue
            yield _violation(imbalance)


def _is_far_short(well: Well) -> bool:
    """Whether the run draws far more from a well than it puts there, mixing apart."""
    moved = [visit for visit in well.visits if not visit.mixing]
    given = sum(visit.volume for visit in moved if visit.kind is OperationKind.DISPENSE)
    drawn = sum(visit.volume for visit in moved if visit.kind is OperationKind.ASPIRATE)
    return given * _FAR_SHORT <= drawn


def _is_mix(imbalance: Imbalance) -> bool:
    """Whether what was drawn went straight back."""
    return any(visit.mixing for visit in imbalance.well.visits if visit.index == imbalance.index)


def _violation(imbalance: Imbalance) -> Violation:
    well = imbalance.well
    if imbalance.overfilled:
        message = (
            f"{place(well)} is filled to {imbalance.volume:.4g} µL {at(imbalance.line)}; "
            f"it holds {imbalance.limit:.4g} µL."
        )
        sites = [Site(imbalance.line, well.ref, f"filled to {imbalance.volume:.4g} µL")]
    else:
        message = (
            f"{imbalance.volume:.4g} µL are drawn from {place(well)} {at(imbalance.line)}, "
            f"which holds {imbalance.limit:.4g} µL then."
        )
        sites = [
            Site(
                imbalance.line,
                well.ref,
                f"drew {imbalance.volume:.4g} µL of {imbalance.limit:.4g} µL",
            )
        ]
    lines = [v.line for v in well.visits if v.index < imbalance.index and v.parts]
    if lines and lines[-1] != imbalance.line:
        sites.insert(0, Site(lines[-1], well.ref, "last filled here"))
    return Violation(message, tuple(sites), well, (imbalance.line, imbalance.overfilled))
