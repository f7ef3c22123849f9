"""Concentrations that stand beside wells in what a loop runs over, by the order of the draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...instrumentation import NameBinding, OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import Loop, SourceFacts, Values, origins
from ..trace import Trace
from .clues import Clue, Strength
from .levels import names_counts, number_in, speaks_of_amounts

Turn = tuple[WellRef, ...]
"""The wells that one step draws from: one per channel."""


def loop_levels(
    trace: Trace, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """``for tube, conc in STANDARDS: p.aspirate(5, rack[tube])``: one level per well drawn from.

    The wells that a line draws from, in order, are as many as the loop has turns.
    """
    if not facts.runs:
        return
    for line, drawn in _draws(trace, facts).items():
        for loop in facts.runs:
            turns, lines = _turns_within(drawn, loop)
            made_of = origins(facts, facts.draws[line], lines) if turns else set()
            if loop.names.isdisjoint(made_of):
                continue
            each = _turns_of_each([o for o in facts.runs if o.names & made_of], loop, line)
            levels = _levels(loop, len(turns), names, common, each) if each is not None else ()
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


Drawn = dict[int, tuple[list[WellRef], tuple[int, ...]]]
"""By index in the run: the wells that a step draws from, and the lines that call it."""


def _draws(trace: Trace, facts: SourceFacts) -> dict[int, Drawn]:
    """For each line that draws, what it draws in the run."""
    steps: dict[int, Drawn] = {}
    for visit in trace.visits:
        if visit.mixing or visit.kind is not OperationKind.ASPIRATE:
            continue
        for line in visit.lines:
            if line in facts.draws:
                drawn = steps.setdefault(line, {})
                drawn.setdefault(visit.index, ([], visit.lines))[0].append(visit.well.ref)
    return steps


def _turns_within(drawn: Drawn, loop: Loop) -> tuple[list[Turn], set[int]]:
    """The different steps that are made in a loop, in order, and the lines that call them."""
    inside = [
        (tuple(refs), lines)
        for refs, lines in drawn.values()
        if any(loop.first <= line <= loop.last for line in lines)
    ]
    turns = list(dict.fromkeys(refs for refs, _ in inside))
    return turns, {line for _, lines in inside for line in lines}


def _turns_of_each(loops: Sequence[Loop], loop: Loop, line: int) -> bool | None:
    """Whether another of these loops runs within each turn of this one, so that a number holds for
    several wells in turn; ``None`` where one runs within and another around it.
    """
    spans = {(other.first, other.last) for other in loops if other.first <= line <= other.last}
    spans.discard((loop.first, loop.last))
    within = any(loop.first <= first and last <= loop.last for first, last in spans)
    around = any(first <= loop.first and loop.last <= last for first, last in spans)
    return None if within and around else within


def _levels(
    loop: Loop, count: int, names: Sequence[NameBinding], common: Common, each: bool
) -> tuple[float, ...]:
    """The one column of numbers that speaks of amounts, one for each well, again and again; or
    ``each`` for several wells in turn.
    """
    named, listed = set(), set()
    for values in loop.values:
        for name, column in _columns(values, names):
            numbers = tuple(found for found in map(number_in, column) if found is not None)
            if len(numbers) != len(column) or len(set(numbers)) < 2 or count % len(numbers):
                continue
            times = count // len(numbers)  # within another loop it begins anew
            numbers = tuple(n for n in numbers for _ in range(times)) if each else numbers * times
            if names_counts(name, common):
                continue
            if speaks_of_amounts(name, common):
                named.add(numbers)
            elif speaks_of_amounts(values.source, common):
                listed.add(numbers)
    for found in (named, listed):
        if found:
            return found.pop() if len(found) == 1 else ()
    return ()


def _columns(
    values: Values, names: Sequence[NameBinding]
) -> Iterator[tuple[str, tuple[object, ...]]]:
    """What a name of a loop holds in turn; rows that are no literal come from the rehearsal."""
    if values.column is not None:
        yield values.name, values.column
        return
    for binding in names:
        if binding.name != values.source:
            continue
        rows = [row.cells for row in binding.rows]
        if values.at is not None:
            if all(len(row) > values.at for row in rows):
                yield values.name, tuple(row[values.at][1] for row in rows)
            continue
        if binding.values:
            yield values.name, binding.values
        for column in dict.fromkeys(name for row in rows for name, _ in row if name):
            found = [dict(row).get(column) for row in rows]
            yield f"{values.name} {column}", tuple(found)
