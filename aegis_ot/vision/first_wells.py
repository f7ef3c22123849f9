"""A run's first wells, on which it calibrates, held against what is known without them.

What a run learns it learns from wells that nobody has judged. If all of them go wrong in the same
way they agree with each other, so agreement proves nothing. A first well counts as normal if its
own frames show the liquid leave the tip, or if the operator says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..vocabulary import Keyframe
from .delivery import Delivery, Shown
from .gates import GateInput

Liquid = tuple[str, float, str]
"""Mount and pipette, working volume of the tip, µL, and reagent: wells that are compared."""

_MISSING_SHARE = 0.3
"""A liquid that shows this much less than in the wells before was not there, or did not leave."""

_KNOWN = 12
"""Wells that showed the liquid leave, after which no more is learned of how it shows."""

_BROKEN, _TELLING = 0.48, 4
"""Median of the wells' least changed stretches below which air seems to be enclosed in all of them,
and the wells from which a median tells. A single well in which a speck on the wall takes the place
of a gap says little; on simulated development runs of a dye the medians were 0.63 at least without
air and 0.33 at most with 8 % of it in every column, but for one camera with 0.62."""

_AIR_SEEN = (
    "Air seems to be enclosed in the column of every well of this liquid so far: in each a stretch "
    "of it does not change when the liquid leaves. Please look at the source and at the tip after "
    "the next aspirate. If they are right, resume; this is asked once."
)

_SPOILED_MOST = 1
"""First wells of a run that may pass unproven because one of their frames was spoiled."""


class FirstWells:
    """What a run's wells have proven of their liquids.

    Args:
        ask: Whether the operator is asked where the frames prove nothing; else the first wells
            are taken for normal, as on simulated frames, where nobody is there to be asked.
    """

    def __init__(self, ask: bool = True) -> None:
        self._ask = ask
        self._strengths: dict[Liquid, list[float]] = {}
        self._unseen: dict[Liquid, int] = {}
        self._unbroken: dict[Liquid, list[float]] = {}
        self._asked_for_air: set[Liquid] = set()
        self._spoiled = 0
        self.vouched = False
        """Whether the operator said that wells in which no liquid is seen to leave are right."""

    def question(self, liquid: Liquid, delivery: Delivery | None, found_in: str = "") -> str:
        """What to ask the operator before a first well counts as normal; empty: nothing.

        Args:
            liquid: Of the well.
            delivery: What its frames show.
            found_in: Where the pipette's sensor found liquid before the draw. That is no proof:
                the tip may have drawn none of it, or delivered none.
        """
        shown = Shown.UNKNOWN if delivery is None else delivery.shown
        if self._ask and delivery is not None and self._all_enclose_air(liquid, delivery):
            return _AIR_SEEN
        if not self._ask or self.vouched or shown is Shown.EMPTIED:
            return ""
        if self.proven(liquid):
            return ""  # it shows, and what did not here is for the gate
        if delivery is not None and delivery.spoiled and self._spoiled < _SPOILED_MOST:
            self._spoiled += 1
            return ""  # a lamp or a hand: the next well tells
        return _nothing_seen(found_in)

    def vouch(self, delivery: Delivery | None) -> None:
        """The operator found a well right that was asked about."""
        if delivery is None or delivery.shown is not Shown.EMPTIED:
            self.vouched = True

    def proven(self, liquid: Liquid) -> bool:
        """Whether most wells of this run showed the liquid leave the tip, of those that could.

        One alone may show it by chance: something passes behind the tip.
        """
        return len(self._strengths.get(liquid, ())) > self._unseen.get(liquid, 0)

    def held_against(self, liquid: Liquid, delivery: Delivery) -> Delivery:
        """``delivery`` in the light of earlier wells: where the liquid was seen to leave them,
        nothing to be seen is a sign, and else it is none."""
        if delivery.shown is not Shown.NOTHING:
            return delivery
        known = self._strengths.get(liquid, [])
        if self.proven(liquid) and delivery.strength < _MISSING_SHARE * float(np.median(known)):
            return delivery
        return replace(delivery, shown=Shown.FAINT)

    def learn(self, liquid: Liquid, case: GateInput) -> None:
        """A well was judged normal."""
        if case.delivery is not None:
            self.note(liquid, case.delivery)

    def note(self, liquid: Liquid, delivery: Delivery) -> None:
        """A normal well of this liquid showed so much of its delivery."""
        if delivery.shown is Shown.EMPTIED:
            self.restore(liquid, delivery.strength, delivery.unbroken)
        elif delivery.unseen:
            self.restore_unseen(liquid)

    def restore_unseen(self, liquid: Liquid) -> None:
        """No liquid was seen to leave a normal well of this liquid."""
        if len(self._strengths.get(liquid, ())) < _KNOWN:
            self._unseen[liquid] = self._unseen.get(liquid, 0) + 1

    def restore(self, liquid: Liquid, strength: float, unbroken: float | None = None) -> None:
        """A normal well of this liquid showed it so plainly, and its column so whole."""
        known = self._strengths.setdefault(liquid, [])
        known.append(strength)
        # The first ones stay: what drifts slowly must not take the measure with it.
        del known[_KNOWN:]
        if unbroken is not None:
            stretches = self._unbroken.setdefault(liquid, [])
            stretches.append(unbroken)
            del stretches[_KNOWN:]
            if _are_broken(stretches):
                self._asked_for_air.add(liquid)  # or it would not have been judged normal

    def _all_enclose_air(self, liquid: Liquid, delivery: Delivery) -> bool:
        if liquid in self._asked_for_air or delivery.unbroken is None:
            return False
        return _are_broken([*self._unbroken.get(liquid, ()), delivery.unbroken])


def _are_broken(stretches: Sequence[float]) -> bool:
    return len(stretches) >= _TELLING and float(np.median(stretches)) < _BROKEN


def _nothing_seen(found_in: str) -> str:
    why = ": none was drawn or dispensed, "
    if found_in:
        why = (
            f", though the pipette's pressure sensor found some in {found_in}: a clogged or "
            "loose tip drew none, none was dispensed, "
        )
    return (
        f"No liquid is seen to leave the tip{why}or it is too clear to be seen in this view. "
        "Please look at the tip and the well. If they are right, resume: the wells after it "
        "are then compared with this one."
    )


def liquid_of(keyframe: Keyframe) -> Liquid:
    """What wells are compared with each other: one pipette and tip, one liquid."""
    return f"{keyframe.mount} {keyframe.pipette}", keyframe.capacity_ul, keyframe.reagent or ""
