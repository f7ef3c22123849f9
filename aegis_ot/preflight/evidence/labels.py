"""Labels of labware: "Compound source", "soil DNA, columns 1-3 (A1 = water)"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ...instrumentation import LabwareInfo
from ..layouts import Deck, Part, parts_of, well_names
from ..rules import Common
from ..text import amounts_in, tokens
from .clues import Clue, Strength

_JOINT = re.compile(r"\s*[,;+/&]\s*")


def labels(deck: Deck, common: Common) -> Iterator[Clue]:
    """What labware is called, and what a label of several parts says of single wells."""
    for info in deck.plates():
        if not info.label:
            continue
        if info.centers_channels:
            yield from _of_troughs(deck, info)
        parts = _parts(info.label, common)
        if len(parts) > 1 and any(part.wells for part in parts):
            head, parts = _headed(parts)
            yield from _of_wells(deck, info, parts, common)
            text = ", ".join(filter(None, [head, *(p.text for p in parts if not p.wells)]))
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
                lone=bool(_JOINT.search(text)),
            )


def _parts(label: str, common: Common) -> list[Part]:
    """The parts of a label; in "clones + BSA col 1" only the second has wells of its own."""
    parts = list(parts_of(label, common))
    pieces = _JOINT.split(label)
    if len(parts) == 1 and parts[0].wells and len(pieces) > 1:
        apart = [part for piece in pieces for part in parts_of(piece, common)]
        if sum(len(part.wells) for part in apart) == len(parts[0].wells):
            return apart
    return parts


def _headed(parts: Sequence[Part]) -> tuple[str, list[Part]]:
    """What a label says of all its wells, and the parts without that: "mixes A1 KPC, A2 NDM"."""
    first, *others = parts
    begun = first.text.partition(first.wells[0].group())[0] if first.wells else ""
    head, colon, _ = begun.partition(":")
    alone = all(p.text.startswith(p.wells[0].group()) for p in others if p.wells)
    plural = head.rstrip().endswith("s") and alone and tokens(first.words[len(begun) :])
    if not (tokens(head) and (colon or plural)):
        return "", list(parts)
    kept = first._replace(text=first.text[len(head + colon) :].strip())
    return head.strip(), [kept._replace(words=first.words[len(head + colon) :]), *others]


_TROUGH = re.compile(
    r"(?:^|[,;:/|])\s*(?P<low>\d{1,2})(?:\s*(?:-|–|to)\s*(?P<high>\d{1,2}))?"
    r"(?:\s*[:=]\s*|\s+)(?P<said>[^\W\d][^,;/|]*)"
)
_UNIT = re.compile(r"(?i:[munµμ]?[lmg]|x|h|min|ml|ul)\b")
_FEWEST = 2
"""A single number in a label may be an amount."""


def _of_troughs(deck: Deck, info: LabwareInfo) -> Iterator[Clue]:
    """What a reservoir's label says of its troughs by number: "1 PBS vehicle, 3-6 doxorubicin"."""
    entries = list(_TROUGH.finditer(info.label))
    names = list(info.wells)
    spans = [range(int(entry["low"]), int(entry["high"] or entry["low"]) + 1) for entry in entries]
    told = [number for span in spans for number in span]
    amounts = any(True for entry in entries for _ in amounts_in(entry.group()))
    if len(entries) < _FEWEST or len(set(told)) != len(told) or not set(told) <= _counted(names):
        return
    if amounts or any(_UNIT.match(entry["said"]) for entry in entries):
        return  # "2 mL drug, 10 mL vehicle"
    for entry, span in zip(entries, spans, strict=True):
        yield Clue(
            Strength.NAME,
            entry["said"],
            tuple(deck.ref(info.key, names[number - 1]) for number in span),
            None,
            f"'{entry.group().strip(' ,;:/|')}' on the label '{info.label}'",
            subject=False,
        )


def _counted(names: Sequence[str]) -> set[int]:
    return set(range(1, len(names) + 1))


def _of_wells(deck: Deck, info: LabwareInfo, parts: list[Part], common: Common) -> Iterator[Clue]:
    names = well_names(common)
    for part in parts:
        wells = names.meant_by(part.wells, info)
        used = tuple(deck.ref(info.key, name) for name in wells if (info.key, name) in deck.refs)
        yield Clue(
            Strength.NAME,
            part.words,
            used,
            None,
            f"'{part.text}' on the label '{info.label}'",
            subject=False,
        )
