"""What must not be given to some wells as a measured volume."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...vocabulary import Site
from ..trace import Well
from .case import Case, RoleSet, delivered
from .check import Check, Doubt, Result, Violation, at, place, role_field


@dataclass(frozen=True)
class NeverReceives(Check):
    """No measured volume of ``liquid`` is dispensed into a well of ``wells``.

    Where nothing says what such a well is given, that may be ``liquid``, too, if it stands in
    the place of that in some other wells.

    Attributes:
        wells: Roles of the wells.
        liquid: Roles of the liquid.
    """

    name: ClassVar[str] = "never_receives"
    wells: tuple[str, ...] = role_field()
    liquid: tuple[str, ...] = role_field()

    def find(self, case: Case) -> Iterator[Result]:
        """Look at what each such well is given."""
        wanted, liquid = frozenset(self.wells), frozenset(self.liquid)
        for well in case.wells(wanted):
            seen: set[int] = set()
            for visit in case.trace.deliveries(well):
                for origin, volume, source, line in delivered(visit):
                    if volume <= 1e-6 or id(origin) in seen:
                        continue
                    if not case.of(origin) and self._may_be(case, origin, well, liquid):
                        seen.add(id(origin))
                        yield Doubt(
                            f"nothing says what {place(origin)} holds, which goes into the "
                            f"{case.title(well)} {place(well)} as well"
                        )
                        continue
                    if not case.has(origin, liquid) or case.has(origin, wanted):
                        continue
                    seen.add(id(origin))
                    what = case.title(origin)
                    yield Violation(
                        f"{visit.volume:.4g} µL drawn from {what} in {place(source)} "
                        f"{at(line)} are dispensed into the {case.title(well)} {place(well)} "
                        f"{at(visit.line)}.",
                        (
                            Site(line, source.ref, f"drew {what}"),
                            Site(visit.line, well.ref, f"gave it to the {case.title(well)}"),
                        ),
                        well,
                        (visit.line, line, what, case.title(well)),
                        (origin, well),
                    )

    def _may_be(self, case: Case, source: Well, well: Well, liquid: RoleSet) -> bool:
        """Whether some other wells of a plate, but not most, get a source and no ``liquid``."""
        wanted = frozenset(self.wells)
        others = {
            other: origins
            for other, origins in case.meant.items()
            if other.ref.labware == well.ref.labware and not case.has(other, wanted)
        }
        served = [origins for other, origins in others.items() if source in origins]
        in_its_place = any(not any(case.has(o, liquid) for o in origins) for origins in served)
        return in_its_place and 2 * len(served) < len(others)
