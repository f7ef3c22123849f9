"""The lines of a text in plain words: what they leave out or say otherwise is put in its place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ..rules import Common
from .bare_lists import with_rows
from .deck import Deck
from .drawn_grids import drawn_lines
from .labware_nouns import LabwareNouns
from .ordinals import with_numbers
from .places_last import with_places_first
from .prose import in_sentences, statements
from .trough_lines import with_troughs
from .well_names import well_names
from .wrapped_lines import whole_lines


def plain_lines(
    text: str, deck: Deck, nouns: LabwareNouns, common: Common, layout: bool
) -> Iterator[tuple[int, str]]:
    """Lines of a text by number, from 0; sentences of running text are one line each.

    Without those of a drawn plate, where "E1" may be a code.

    Args:
        text: A comment or a docstring.
        deck: What stands where.
        nouns: What texts call that.
        common: Words.
        layout: Whether it may tell the layout, and is no comment on a step of the run: there "the
            first column" may be of anything.
    """
    text = with_troughs(nouns.slots.with_slots(text), deck, nouns, common)
    names = well_names(common)
    written = with_places_first(with_rows(text, common).splitlines() or [text], names)
    lines = (
        (first + number, with_numbers(line, common) if layout else line)
        for first, block in in_sentences(written, common)
        for number, line in whole_lines(block, common)
    )
    drawn = drawn_lines(text.splitlines(), names)
    for number, line in _cut_at_headings(lines, nouns):
        if number not in drawn:
            yield from ((number, said) for said in statements(line, common))


_NEXT_HEADING = re.compile(r"(?<=[.;])\s+(?=[^\W\d]\w*(?:[ -]\w+){0,3}(?: \([^()]*\))?\s?:)")
"""Where a line may go on with what other labware holds."""


def _cut_at_headings(
    lines: Iterable[tuple[int, str]], nouns: LabwareNouns
) -> Iterator[tuple[int, str]]:
    """Lines by number, cut where one goes on with other labware: "Plate 1: ... Plate 2: "."""
    for number, line in lines:
        begun, *others = _NEXT_HEADING.split(line)
        indent = line[: len(line) - len(line.lstrip())]
        for other in others:
            if len(nouns.heading(other) or nouns.named(other.partition(":")[0])) == 1:
                yield number, begun
                begun = indent + other
            else:
                begun = f"{begun} {other}"
        yield number, begun
