"""One piece of evidence for what wells are for, before any family says what it means."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from ...vocabulary import WellRef


class Kind(IntEnum):
    """Where evidence comes from; more beats less (``spec/rules.md``, *Role*)."""

    MODEL = 1
    """A model's reading, verified."""
    WRITTEN = 2
    """Wells written out in a comment or docstring."""
    PASSING_NAME = 3
    """The name of a loop variable or parameter, which holds many things in turn."""
    NAME = 4
    """A name, key or field that held wells; a plate map; a labware's label."""
    DESCRIPTION = 5
    """The description of a loaded liquid."""
    LIQUID = 6
    """The name of a loaded liquid."""
    GIVEN = 7
    """The guard's own arguments."""


DOUBTFUL = frozenset({Kind.MODEL, Kind.WRITTEN})
"""Kinds that help to decide and never make an error."""

LONGEST_QUOTE = 60
"""So many characters of a text are quoted in a citation."""


@dataclass(frozen=True)
class Evidence:
    """One piece of evidence.

    Attributes:
        kind: Where it comes from.
        text: The words that may name a role.
        wells: The wells it speaks of, in order.
        citation: For people: "name `ntc` at line 12".
        whole: Whether it speaks of a whole labware rather than of chosen wells.
        role: The role itself, where it was given outright.
        levels: Concentration or dose of each of its wells, where it gives them one by one.
        variable: Whether it is no more than what a variable is called.
    """

    kind: Kind
    text: str
    wells: tuple[WellRef, ...]
    citation: str
    whole: bool = False
    role: str = ""
    levels: tuple[float | None, ...] = ()
    variable: bool = False

    @property
    def is_name(self) -> bool:
        """Whether it is a noun phrase whose last word is its head: ``sample_buffer``."""
        return self.kind not in (Kind.DESCRIPTION, Kind.WRITTEN, Kind.MODEL)
