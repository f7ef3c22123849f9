"""Fields of the rows and objects in a list: ``ladders[0].diluent``, ``{"vehicle": ...}``.

A loop over them leaves only the last one in its variable; the list holds them all.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...instrumentation import NameBinding
from ...vocabulary import WellRef
from ..text import SourceFacts
from .clues import Clue, Strength


def named_fields(names: Sequence[NameBinding], facts: SourceFacts) -> Iterator[Clue]:
    """What the fields are called that hold wells, for all rows of a list together."""
    loose = {name for _, name in facts.loose}
    for binding in names:
        base = binding.name.split("[", 1)[0]
        if len(binding.rows) < 2 or base in loose:
            continue
        held: dict[str, dict[WellRef, None]] = {}
        for row in binding.rows:
            for column, cell in row.cells:
                if isinstance(cell, WellRef) and column and not column.isdigit():
                    held.setdefault(column, {})[cell] = None
        line = facts.assigned.get(base, binding.line)
        for column, wells in held.items():
            yield Clue(
                Strength.NAME,
                f"{base}.{column}",
                tuple(wells),
                line,
                f"field `{column}` of `{binding.name}` at line {line}",
            )
