"""Labels of labware: "Compound source", "soil DNA, columns 1-3 (A1 = water)"."""

from __future__ import annotations

from collections.abc import Iterator

from ...instrumentation import LabwareInfo
from ..rules import Common
from .clauses import Part, parts_of
from .clues import Clue, Strength
from .deck import Deck
from .well_names import well_names


def labels(deck: Deck, common: Common) -> Iterator[Clue]:
    """What labware is called, and what a label of several parts says of single wells."""
    for info in deck.plates():
        if not info.label:
            continue
        parts = list(parts_of(info.label, common))
        if len(parts) > 1 and any(part.wells for part in parts):
            yield from _of_wells(deck, info, parts, common)
            text = ", ".join(part.text for part in parts if not part.wells)
        else:
            text = info.label
        if text:
            yield Clue(
                Strength.NAME,
                text,
                deck.used_wells((info.key,)),
                None,
                f"label '{info.label}'",
                whole=True,
                lone="," in text or ";" in text,
            )


def _of_wells(deck: Deck, info: LabwareInfo, parts: list[Part], common: Common) -> Iterator[Clue]:
    names = well_names(common)
    for part in parts:
        wells = [name for match in part.wells for name in names.meant(match, info)]
        used = tuple(deck.ref(info.key, name) for name in wells if (info.key, name) in deck.refs)
        yield Clue(
            Strength.NAME,
            part.words,
            used,
            None,
            f"'{part.text}' on the label '{info.label}'",
            subject=False,
        )
