"""What ``common.json`` may say: the words of no assay in particular."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

SCHEMA_VERSION = 2
READABLE = (1, SCHEMA_VERSION)
"""Schema 1 without the fields that are gone is schema 2."""


@dataclass(frozen=True)
class Common:
    """``common.json``: word lists that belong to no family.

    Attributes:
        pauses: What a pause's message says may have been done, see ``trace.pauses``.
        prefilled: Names of wells that held liquid before the run.
        waste: Names of wells that are waste.
        empty: Words for wells that are empty at first.
        levels: Words for concentrations, with their value: ``blank`` is 0.
        amounts: Words for concentrations or doses: ``conc``.
        aliases: Abbreviations and what they stand for, word by word.
        joints: What follows one of these only says more: "drug in medium".
        sides: Words that only say on which side of a transfer something stands: ``src``.
        joining: Words that join several things: "and".
        lacking: Words before something that is not there: "without".
        noise: Words that tell no compound from another: "stock", "well".
        distinct: Words for things of which each has a name of its own: "compounds".
        dose_words: Words for amounts of one thing: "dose".
        schema: The version of this format.
    """

    pauses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefilled: tuple[str, ...] = ()
    waste: tuple[str, ...] = ()
    empty: tuple[str, ...] = ()
    levels: Mapping[str, float] = field(default_factory=dict)
    amounts: tuple[str, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    joints: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()
    joining: tuple[str, ...] = ()
    lacking: tuple[str, ...] = ()
    noise: tuple[str, ...] = ()
    distinct: tuple[str, ...] = ()
    dose_words: tuple[str, ...] = ()
    schema: int = SCHEMA_VERSION

    @property
    def undescriptive(self) -> tuple[str, ...]:
        """Words of a name that say neither what a compound is nor how much of it there is."""
        return (*self.noise, *self.levels)
