"""The check on wells of one assay that should get the same volumes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...vocabulary import Site
from ..rules import role_names
from ..trace import Well
from .check import Check, Result, Violation, microlitres
from .receiving import came_from, filled, is_made_of, received
from .rule_context import RuleContext, at

Member = tuple[Well, float, float]
"""A well, the µL of the liquid that it received, and those that it received in all."""


@dataclass(frozen=True)
class UniformVolume(Check):
    """All wells of ``wells`` that received the same ``liquid`` received as much of it, and end
    at the same volume.

    Wells that received different liquids of ``liquid`` are different assays and are compared
    apart. Where it comes out of several tubes, each of which gives as much to all its wells, and
    no declared liquid says that they hold the same, each tube may be an assay of its own.
    End volumes are compared only where the run brings everything. A well that is shared out to
    others beside it is left out, and one that gets nothing but what such wells held. So is a
    control that only its tube tells: what it should get in the place of others' liquids, nothing
    says.

    Attributes:
        wells: Roles of the wells.
        liquid: Roles of the liquid.
    """

    wells: tuple[str, ...] = role_names(required=True)
    liquid: tuple[str, ...] = role_names(required=True)

    def find(self, case: RuleContext) -> Iterator[Result]:
        groups: dict[tuple[str, ...], list[Member]] = {}
        for well in case.wells(self.wells):
            if well.prefilled or case.is_drawn_first(well):
                continue
            if self._is_shared_out(case, well) or is_made_of(case, well, self.wells):
                continue
            got, _ = received(case, well, self.liquid)
            if got > 0:
                total, _ = filled(well)
                groups.setdefault(self._assay(case, well), []).append((well, got, total))
        for members in groups.values():
            yield from self._compare(case, members)

    def _is_shared_out(self, case: RuleContext, well: Well) -> bool:
        """Whether it got more on purpose: other such wells beside it are filled from it."""
        return any(
            other.ref.labware == well.ref.labware and case.has(other, self.wells)
            for other in case.destinations.get(well, {})
        )

    def _assay(self, case: RuleContext, well: Well) -> tuple[str, ...]:
        tubes, named = came_from(case, well, self.liquid), case.roles.by_well
        names = {(t.ref in named and named[t.ref].text) or t.ref.address for t in tubes}
        return (well.ref.labware, str(well.generation), *sorted(names))

    def _compare(self, case: RuleContext, members: list[Member]) -> Iterator[Result]:
        title = case.titles(self.liquid)
        usual_got = _usual([got for _, got, _ in members])
        usual_total = _usual([total for _, _, total in members])
        # Where a good part of the wells ends elsewhere, several kinds of reactions are meant; and
        # where such a part gets this and that much.
        few = _are_few([total for _, _, total in members], usual_total)
        odd = {f"{got:.3g}" for _, got, _ in members if _differs(got, usual_got)}
        if len(odd) > 1 and not _are_few([got for _, got, _ in members], usual_got):
            return
        for well, got, total in members:
            if well.ref in case.roles.followed:
                continue
            if _differs(got, usual_got):
                what = f"receives {microlitres(got)} of {title}; the others receive "
                what += microlitres(usual_got)
                line = received(case, well, self.liquid)[1]
            elif _differs(total, usual_total) and few:
                what = f"ends at {microlitres(total)}; the others end at {microlitres(usual_total)}"
                line = filled(well)[1]
            else:
                continue
            yield Violation(
                f"The {case.title(well)} {well.ref} {what} ({at(line)}).",
                (Site(line, well.ref, what),),
                (line, case.title(well), what),
            )


def _differs(volume: float, typical: float) -> bool:
    """Whether a volume is off the typical one, µL, by more than 1 % and more than rounding is."""
    return abs(volume - typical) > max(0.01 * typical, 0.01)


def _are_few(values: list[float], usual: float) -> bool:
    """Whether few of the wells are off the usual volume, or there are few wells in all."""
    return 3 * sum(_differs(one, usual) for one in values) <= len(values) or len(values) < 6


def _usual(values: list[float]) -> float:
    """The most frequent value (to 0.1 %), the larger one of equals."""
    counts: dict[str, list[float]] = {}
    for value in values:
        counts.setdefault(f"{value:.3g}", []).append(value)
    return max(counts.values(), key=lambda same: (len(same), same[0]))[0]
