"""Levels that a text gives at both ends: "0.3 nM in column 1 up to 10 uM in column 10"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from ...instrumentation import LabwareInfo
from ..layouts import Deck, LabwareNouns, WellNames, well_names
from ..rules import Common
from ..text import SourceFacts, amounts_in, comment_blocks, with_u
from ..trace import row_column
from .clues import Clue, Strength, shortened

_WIDEST = 8
"""So many characters at most stand between a level and its place: "10 nM (col 3)"."""

_LONGEST_LINE = 400

Span = tuple[re.Match[str], re.Match[str], float, float]
"""The first and the last place, and the levels there."""


def level_spans(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Levels of the wells between two places that a line names with a level each.

    On the labware that the line names, or else on those that the run fills: what they are filled
    from may be laid out the other way round.
    """
    names, nouns = well_names(common), LabwareNouns(deck, common)
    for first, text in (*facts.docstrings, *comment_blocks(facts)):
        for line, written in enumerate(text.splitlines(), first):
            for low, high, start, end in _spans(written[:_LONGEST_LINE], names):
                keys = nouns.heading(written) or nouns.named(written) or deck.filled
                for info in deck.plates():
                    if info.key not in keys:
                        continue
                    levels = _levels(names, info, low, high, start, end)
                    wells = [well for well in levels if (info.key, well) in deck.refs]
                    if not info.centers_channels and wells:
                        yield Clue(
                            Strength.COMMENT,
                            "",
                            tuple(deck.refs[info.key, well] for well in wells),
                            line,
                            f"'{shortened(written)}' at line {line}",
                            subject=False,
                            levels=tuple(levels[well] for well in wells),
                        )


def _spans(text: str, names: WellNames) -> Iterator[Span]:
    """Two levels and two places in turn, "up to" in their middle and little else between."""
    text = with_u(text)  # so that places in it are those of its amounts
    found: list[tuple[re.Match[str], float | None]] = [*amounts_in(text)]
    found += [(place, None) for place in names.spec.finditer(text)]
    found.sort(key=lambda item: item[0].start())
    for four in zip(found, found[1:], found[2:], found[3:], strict=False):
        gaps = [text[one.end() : other.start()] for (one, _), (other, _) in pairwise(four)]
        if len(gaps[0]) > _WIDEST or len(gaps[2]) > _WIDEST or not _leads_on(gaps[1], names):
            continue
        places = [at for at, level in four if level is None]
        levels = [level for _, level in four if level is not None]
        in_turn = (four[0][1] is None) != (four[1][1] is None)
        if in_turn and (four[2][1] is None) == (four[0][1] is None) and len(places) == 2:
            yield places[0], places[1], levels[0], levels[1]


def _leads_on(between: str, names: WellNames) -> bool:
    """Whether nothing but "up to", an arrow or the like stands between two ends."""
    return (
        re.fullmatch(rf"[\s,)\]]*(?:up|down)?(?:{names.to}|\s*(?:-+>|→)\s*)[(\[]?", between)
        is not None
    )


def _levels(
    names: WellNames,
    info: LabwareInfo,
    low: re.Match[str],
    high: re.Match[str],
    start: float,
    end: float,
) -> dict[str, float]:
    """The level of each well from one place to the other, in even steps: only order counts."""
    ends = [{row_column(well) for well in names.meant(place, info)} for place in (low, high)]
    for axis in (1, 0):
        first, last = ({at[axis] for at in wells} for wells in ends)
        across = {at[1 - axis] for at in ends[0]}
        if (
            len(first) == len(last) == 1
            and first != last
            and across == {at[1 - axis] for at in ends[1]}
        ):
            (a,), (b,) = first, last
            return {
                well: start + (end - start) * (row_column(well)[axis] - a) / (b - a)
                for well in info.wells
                if row_column(well)[1 - axis] in across
                and min(a, b) <= row_column(well)[axis] <= max(a, b)
            }
    return {}
