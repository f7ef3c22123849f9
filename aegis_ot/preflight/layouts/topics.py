"""Which labware the lines of a text speak of, one after the other."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ..rules import Common
from ..text import tokens
from .clauses import Part, axis_of, parts_of
from .labware_nouns import IN_BRACKETS, LabwareNouns
from .well_names import well_names

_LONGEST_HEADING = 6

_LABEL = re.compile(r"[\s*-]*([^\W\d]\w*(?: [\w()]+){0,3}):?\s{2,}(?=\S)")
"""What stands at the left of a line, apart from its entries."""

_NONE: frozenset[str] = frozenset()


class Topic:
    """What the lines and parts of one text, read in order, speak of: keys of labware.

    Attributes:
        heading: What a line above, or the begin of this one, says of all that follows.
        in_deck: Whether the lines list what stands in which slot: "Deck" stood above them.
    """

    def __init__(self, nouns: LabwareNouns, common: Common) -> None:
        self._nouns = nouns
        self._common = common
        self.heading = _NONE
        self._last = self._in_line = self._of_line = self._headed = _NONE
        self._begins = _NONE
        self._begun = ""
        self._hanging = (0, _NONE)
        self._heads_next = self.in_deck = False

    def next_line(self, written: str, parts: Sequence[Part]) -> None:
        """Go on with a line, whose parts name wells."""
        nouns = self._nouns
        begun, colon, _ = written.partition(":")
        short = bool(colon) and len(tokens(IN_BRACKETS.sub(" ", begun))) <= _LONGEST_HEADING
        named = nouns.named(begun) if short else _NONE
        self._headed = nouns.heading(written)
        if named and len(self._headed) != 1:
            self._headed = named  # "kit rack: ..." is not any rack
        # "cDNA plate, columns 1-5 samples": it begins with its labware.
        opening = written[: IN_BRACKETS.sub(_as_long, f"{written},").index(",")]
        opens = bool(parts) and parts[0].text not in opening
        self._begins = nouns.named(opening) if opens else _NONE
        self.in_deck = nouns.is_of_deck_list(written, self.in_deck)
        listed = nouns.begun_by(written, self.in_deck)
        # "Curve (slot 2, row A): A1 ..." still says what its wells hold.
        plain = IN_BRACKETS.sub(" ", begun)
        called = self._headed and (nouns.named(plain) or nouns.beginning(plain))
        of_labware = called or nouns.ends_in_noun(plain) or (colon and listed)
        self._begun = begun.strip() if (self._headed or listed) and of_labware else ""
        self._of_line = nouns.named(written.partition("->")[0]) or self._headed or self._hanging[1]
        self._in_line = _NONE
        if named:
            self.heading = named  # and of the lines below: "strips: column 1 blank"
        elif listed:
            self.heading, self._last = listed, _NONE
        elif self._of_line and _heads(written, self._common):
            self.heading = self._of_line
        elif self._begins and self.heading and self._begins != self.heading:
            self.heading = self._begins
        elif not written.strip() and not self._heads_next:
            self.heading = self._last = _NONE
        anew = bool(parts) and (_is_headed(parts[0], begun) or nouns.ends_in_noun(begun))
        if colon and not self._of_line and anew:
            self.heading = self._last = _NONE  # "cells: column 1 ..." goes on with something else
        others = _NONE if self._of_line else nouns.of_kinds_in(_before_wells(written, parts))
        if others and others.isdisjoint(self.heading or self._last):
            self.heading = self._last = _NONE  # "both plates" are none of the rack before
        elif self._of_line and written.rstrip().endswith("."):
            self._last = self._of_line  # and the next sentence, if it names none
        # An empty line may set a heading apart from what it heads.
        self._heads_next = bool(self.heading) and written.rstrip().endswith(":")

    def entries(self, written: str) -> str:
        """A line without the labware that stands at its left, of which the next ones speak, too.

        ::

            rack on 4   A1 blank  A2 BSA 0.2  A3 BSA 0.4
                        C1-C6 extracts
        """
        at, keys = self._hanging
        if keys and written.strip() and len(written) - len(written.lstrip()) >= at:
            return written
        label = _LABEL.match(written)
        wells = well_names(self._common).spec
        named = label is not None and not wells.search(label[1])
        keys = self._nouns.beginning(label[1]) if label and named else _NONE
        if label is None or not keys:
            self._hanging = (0, _NONE)
            return written
        self._hanging = (label.end(), keys)
        rest = written[label.end() :]
        told = tokens(wells.sub(" ", rest))  # not in "dye trough   A1"
        return " " * label.end() + rest if told else written

    def next_part(self, before: frozenset[str]) -> None:
        """Go on with a part, before whose wells this stands: "strip columns 1 and 2"."""
        self._last, self._in_line = before or self._last, before or self._in_line

    def without_heading(self, part: Part) -> Part:
        """The part without what its line speaks of: "drug plate: A1 vehicle" is no drug."""
        if not self._begun or not part.text.strip().startswith(self._begun):
            return part
        return part._replace(words=part.words.partition(":")[2])

    def said(self, part: Part, before: frozenset[str], noted: frozenset[str]) -> frozenset[str]:
        """The labware that a part or its line names, ``noted``: by the variable beside it."""
        named = self._nouns.named(IN_BRACKETS.sub(" ", _here(part)))
        return (
            (before if len(before) == 1 else _NONE)
            or (_NONE if before and named.isdisjoint(before) else named)
            or self._one_of(before)
            or before
            or (self._in_line if len(self._in_line) == 1 else _NONE)
            or noted
            or self._of_line
        )

    def _one_of(self, several: frozenset[str]) -> frozenset[str]:
        """The one of these that the line or a heading names: "slot 2: tube A1 ..., tube A3 ..."
        where two racks hold tubes.
        """
        known = (self._of_line & several, self.heading & several)
        return next((keys for keys in known if len(keys) == 1), _NONE)

    def above(self) -> frozenset[str]:
        """The labware that was named before, where a line names none."""
        return self.heading or self._last

    def places(self, keys: frozenset[str]) -> bool:
        """Whether the text says itself that these are the labware of a part's wells."""
        headed = 1 in (len(self._headed), len(self._in_line), len(self._begins))
        return headed or (bool(keys) and keys == self.heading)


def _as_long(match: re.Match[str]) -> str:
    """As many signs that are no commas."""
    return "_" * len(match[0])


def _here(part: Part) -> str:
    """A part without where an arrow leads after it: "H1 water -> every H well of the plate"."""
    here, arrow, _ = part.text.partition("->")
    start = part.wells[-1].group()
    return here if arrow and start in here and tokens(here.rpartition(start)[2]) else part.text


def _before_wells(written: str, parts: Sequence[Part]) -> str:
    """What a line says before it names wells."""
    return written.partition(parts[0].wells[0].group())[0] if parts else ""


def _is_headed(part: Part, begun: str) -> bool:
    """Whether a line has a heading without wells of its own before its first columns."""
    return 0 < len(tokens(begun)) <= _LONGEST_HEADING and (
        part.text.strip().startswith(begun.strip())
        and axis_of(part) == 1
        and part.text.find(part.wells[0].group()) > len(begun.strip())
    )


def _heads(line: str, common: Common) -> bool:
    """Whether a line says which labware the next ones speak of: "rack in slot 5"."""
    if line.rstrip().endswith(":"):
        return True
    return len(tokens(IN_BRACKETS.sub(" ", line))) <= _LONGEST_HEADING and not any(
        p.wells for p in parts_of(line, common)
    )
