"""What every check is, and what it finds."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

from ...vocabulary import Site, WellRef
from ..trace import Contact, Met, Visit, Well
from .rule_context import RuleContext


@dataclass(eq=False, slots=True)
class Violation:
    """One place where a rule is broken, before places of one cause are joined.

    Of one tip for a whole plate there are thousands, so they are cheap to make.

    Attributes:
        message: One sentence in plain words about this place.
        sites: Both ends; the well that suffers stands last.
        cause: Violations of one cause become one finding.
        tip: What one tip does in one way: that is one finding as well.
        rests_on: Wells without whose roles nothing would be wrong.
        contact: How surely the tips touched what it rests on.
        warning: Why it is a warning at most, in a sentence; empty for what surely ruins the assay.
        told_by: A rule that, where it finds something in the same well, says this better.
        in_any_assay: Whether it holds by what happened and by names alone, whatever the assay is.
        shown: Whether names that differ, and the run's use of the wells, agree on what they hold.
    """

    message: str
    sites: tuple[Site, ...]
    cause: tuple[Any, ...]
    rests_on: tuple[Well, ...] = ()
    contact: Contact = Contact.WET
    warning: str = ""
    told_by: str = ""
    in_any_assay: bool = False
    shown: bool = False
    tip: tuple[Any, ...] = ()

    @property
    def well(self) -> WellRef:
        """The well that suffers."""
        well = self.sites[-1].well
        assert well is not None
        return well


@dataclass(frozen=True)
class Doubt:
    """A place that a check cannot judge.

    Attributes:
        reason: Why, in a sentence.
        levels_of: Wells whose concentration or dose would decide it.
        roles_of: Wells whose role would decide it.
        role: The role that one of these has; ``""`` for any on their ``side``.
        side: ``source`` or ``destination``.
    """

    reason: str
    levels_of: tuple[Well, ...] = ()
    roles_of: tuple[Well, ...] = ()
    role: str = ""
    side: str = "source"


Result = Violation | Doubt


def surest(found: dict[Any, Any], key: object, result: Result) -> None:
    """Keep the result of one place, the first of those with the surest contact."""
    told = found.setdefault(key, result)
    if getattr(told, "contact", Contact.WET) < getattr(result, "contact", Contact.CLEAR):
        found[key] = result


def site_of(one: Visit | Met, action: str) -> Site:
    """Where a visit, or a first contact, was, and what was done there."""
    return Site(one.line, one.well.ref, action, one.index)


def microlitres(volume: float) -> str:
    """A volume in a message: "2.5 µL", "15170 µL"."""
    return f"{volume:.0f} µL" if volume >= 1000 else f"{volume:.4g} µL"


@dataclass(frozen=True)
class Check:
    """A predicate over trace and roles, with its parameters as fields.

    Attributes:
        lasting: Whether nothing that may follow mends what it finds.
    """

    lasting: ClassVar[bool] = False

    def demanded(self, case: RuleContext) -> Collection[str]:
        """Roles without which it does not hold; what else is not there cannot break it."""
        return ()

    def claims(self, case: RuleContext, origin: Well, well: Well) -> bool | None:
        """Whether it judges what a tip brings from one well into another: then that is right or
        wrong by its family's rule, and not by composition. ``None``: it may, were it known what
        these wells are for.
        """
        return False

    def find(self, case: RuleContext) -> Iterable[Result]:
        """Places where it does not hold, and places that it cannot judge."""
        raise NotImplementedError
