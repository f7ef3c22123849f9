"""A clue: one piece of evidence for a well's role, before any family says what it means."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property

from ...vocabulary import WellRef


class Strength(IntEnum):
    """How much a clue is worth; more beats less."""

    MODEL = 1
    COMMENT = 2
    LOOSE_NAME = 3
    DESCRIPTION = 4
    NAME = 5
    LIQUID = 6
    GIVEN = 7


@dataclass(frozen=True)
class Clue:
    """One piece of evidence.

    Attributes:
        strength: What kind it is.
        text: The words.
        wells: The wells it speaks of, in order.
        line: Where it stands in the source, if it does.
        said: For people: "name `ntc` at line 12".
        whole: Whether it speaks of a whole labware rather than of chosen wells.
        role: The role itself, where it was given outright.
        levels: Concentrations or doses beside the wells, if any.
        subject: Whether only the last word names the thing, as in ``sample_buffer``.
        step: For a comment beside a transfer: ``source`` or ``destination`` of the transfer.
        lone: Whether it speaks of its wells only if it names a single role.
        placed: Whether a comment says itself in which labware its wells are.
        copied_from: For evidence on other wells that these share a layout with: those, in order;
            it counts for those of them that it decided, or of which nothing is known.
    """

    strength: Strength
    text: str
    wells: tuple[WellRef, ...]
    line: int | None
    said: str
    whole: bool = False
    role: str = ""
    levels: tuple[float | None, ...] = ()
    subject: bool = True
    step: str = ""
    lone: bool = False
    placed: bool = False
    copied_from: tuple[WellRef, ...] = ()

    @cached_property
    def places(self) -> frozenset[WellRef]:
        """Each of its wells once; made once, for tables of thousands of rows."""
        return frozenset(self.wells)


def shortened(text: str) -> str:
    """A text that may be quoted in a clue."""
    text = " ".join(text.split())
    return text if len(text) <= 60 else text[:57] + "..."
