"""Concentrations that stand beside wells in what a loop runs over, by the order of the draws."""

from __future__ import annotations

from collections.abc import Iterator

from ...vocabulary import WellRef
from ..rules import Common
from ..text import Lexicon, Loop, SourceFacts, origins
from ..trace import Trace
from .clues import Clue, Strength
from .plate_maps import is_number

Turn = tuple[WellRef, ...]
"""The wells that one step draws from: one per channel."""


def loop_levels(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """``for tube, conc in STANDARDS: p.aspirate(5, rack[tube])``: one level per well drawn from.

    The wells that a line draws from, in order, are as many as the loop has turns.
    """
    if not facts.runs:
        return
    for line, (turns, lines) in _turns(trace, facts).items():
        for loop in facts.runs:
            if not any(loop.first <= at <= loop.last for at in lines):
                continue
            if loop.names.isdisjoint(origins(facts, facts.draws[line], lines)):
                continue
            levels = _levels(loop, len(turns), common)
            if levels:
                yield Clue(
                    Strength.NAME,
                    "",
                    tuple(ref for turn in turns for ref in turn),
                    line,
                    f"numbers beside it in the loop at line {loop.first or line}",
                    levels=tuple(
                        level for turn, level in zip(turns, levels, strict=True) for _ in turn
                    ),
                )


def _turns(trace: Trace, facts: SourceFacts) -> dict[int, tuple[list[Turn], set[int]]]:
    """For each line that draws: the wells it draws from, in order, and the lines that call it."""
    steps: dict[int, dict[int, list[WellRef]]] = {}
    callers: dict[int, set[int]] = {}
    for visit in trace.visits:
        if visit.mixing or visit.kind.value != "aspirate":
            continue
        for line in visit.lines:
            if line in facts.draws:
                steps.setdefault(line, {}).setdefault(visit.index, []).append(visit.well.ref)
                callers.setdefault(line, set()).update(visit.lines)
    return {
        line: (list(dict.fromkeys(map(tuple, by_index.values()))), callers[line])
        for line, by_index in steps.items()
    }


def _levels(loop: Loop, count: int, common: Common) -> tuple[float, ...]:
    """The one column of numbers that speaks of amounts, as long as there are wells."""
    amounts = Lexicon({"amount": common.amounts})
    counts = Lexicon({"count": common.countings})
    named, listed = set(), set()
    for values in loop.values:
        numbers = tuple(float(item) for item in values.column if is_number(item))
        if len(numbers) != count or len(values.column) != count or len(set(numbers)) < 2:
            continue
        if amounts.find(values.name):
            named.add(numbers)
        elif amounts.find(values.source) and not counts.find(values.name):
            listed.add(numbers)
    for found in (named, listed):
        if found:
            return found.pop() if len(found) == 1 else ()
    return ()
