"""Layouts of two labware that stand side by side in one text.

::

    Tubes (slot 2)            Plate (slot 3)
    A1   blank                A1 A2
    A2   BSA 0.125 mg/mL      B1 B2
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..rules import Common
from ..text import labware_words, tokens
from .labware_nouns import IN_BRACKETS
from .well_names import WellNames, well_names

_APART = re.compile(r"\s{3,}")
_GAP = re.compile(r"\s{2,}")
_RULE = re.compile(r"[\s=_|+-]*")
_FEWEST = 2
_LONGEST_HEADING = 10
_NEAR = 4
"""Spaces by which an entry may begin beside its heading."""


def side_by_side(line: int, text: str, common: Common) -> Iterator[tuple[int, str]]:
    """The text without what stands at the right, and then that, each with its first line.

    Wells at the right without words hold what stands at their left: "blank      A1 A2".
    """
    lines = text.split("\n")
    names = well_names(common)
    right: list[tuple[int, str]] = []
    for at, written in enumerate(lines):
        start = _second_heading(written, common, names)
        if start is None:
            continue
        rows = _rows_below(lines, at, start)
        if sum(bool(tokens(there)) for _, there in rows) < _FEWEST:
            continue
        block = [written[start:]]
        lines[at] = written[:start].rstrip()
        for below, (here, there) in enumerate(rows, at + 1):
            lines[below] = here
            said = names.spec.sub(" ", here).strip(" :=")
            bare = there.strip() and not tokens(names.spec.sub(" ", there))
            block.append(f"{there.strip()}: {said}" if bare and tokens(said) else there.strip())
        right.append((line + at, "\n".join(block)))
    yield line, "\n".join(lines)
    yield from right


def _second_heading(written: str, common: Common, names: WellNames) -> int | None:
    """Where the second of two headings begins that each speak of labware, if a line has two."""
    heads = _APART.split(written.strip())
    if len(heads) != 2 or names.spec.search(IN_BRACKETS.sub(" ", written)):
        return None
    nouns = labware_words(common) | {"rack"}
    if any(len(tokens(h)) > _LONGEST_HEADING or nouns.isdisjoint(tokens(h)) for h in heads):
        return None
    return written.rindex(heads[1])


def _rows_below(lines: Sequence[str], at: int, start: int) -> list[tuple[str, str]]:
    """What stands at the left and at the right on each line below, up to one that has no gap."""
    rows: list[tuple[str, str]] = []
    for written in lines[at + 1 :]:
        if not written.strip():
            break
        if _RULE.fullmatch(written):
            rows.append(("-", "-"))  # no blank line, which ends what a heading speaks of
            continue
        gaps = [gap.end() for gap in _GAP.finditer(written) if abs(gap.end() - start) <= _NEAR]
        if gaps:
            split = min(gaps, key=lambda end: abs(end - start))
        elif len(written.rstrip()) <= start:
            split = len(written)
        else:
            break
        rows.append((written[:split].rstrip(), written[split:]))
    return rows
