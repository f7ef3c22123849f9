"""What ``common.json`` may say: the words of no assay in particular."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

SCHEMA_VERSION = 1


@dataclass(frozen=True)
class Common:
    """``common.json``: word lists that belong to no family."""

    pauses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefilled: tuple[str, ...] = ()
    protocol_prefilled: tuple[str, ...] = ()
    levels: Mapping[str, float] = field(default_factory=dict)
    rising: tuple[str, ...] = ()
    falling: tuple[str, ...] = ()
    amounts: tuple[str, ...] = ()
    curves: tuple[str, ...] = ()
    countings: tuple[str, ...] = ()
    figures: tuple[str, ...] = ()
    abbreviations: tuple[str, ...] = ()
    tips: tuple[str, ...] = ()
    decks: tuple[str, ...] = ()
    waste: tuple[str, ...] = ()
    negations: tuple[str, ...] = ()
    exceptions: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    comparing: tuple[str, ...] = ()
    means: tuple[str, ...] = ()
    by_hand: tuple[str, ...] = ()
    instead: tuple[str, ...] = ()
    lacking: tuple[str, ...] = ()
    free_of: tuple[str, ...] = ()
    empty: tuple[str, ...] = ()
    dried: tuple[str, ...] = ()
    replicates: tuple[str, ...] = ()
    alike: tuple[str, ...] = ()
    twins: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    joining: tuple[str, ...] = ()
    additives: tuple[str, ...] = ()
    toward: tuple[str, ...] = ()
    giving: tuple[str, ...] = ()
    holding: tuple[str, ...] = ()
    filling: tuple[str, ...] = ()
    handling: tuple[str, ...] = ()
    afterwards: tuple[str, ...] = ()
    controls: tuple[str, ...] = ()
    belonging: tuple[str, ...] = ()
    origins: tuple[str, ...] = ()
    articles: tuple[str, ...] = ()
    partly: tuple[str, ...] = ()
    positions: tuple[str, ...] = ()
    on_paper: tuple[str, ...] = ()
    ordinals: tuple[str, ...] = ()
    ordinal_numbers: Mapping[str, float] = field(default_factory=dict)
    cardinal_numbers: Mapping[str, float] = field(default_factory=dict)
    labware: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    heads: tuple[str, ...] = ()
    endings: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    noise: tuple[str, ...] = ()
    distinct: tuple[str, ...] = ()
    dose_words: tuple[str, ...] = ()
    layout: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    schema: int = SCHEMA_VERSION
