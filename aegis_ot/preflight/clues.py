"""Gathers what speaks for a well's role, before any family says what the words mean.

A clue is a text (a name, a liquid, a label, a comment), the wells it speaks of, where it
stands, and how strong it is. ``spec/rules.md`` orders the strengths.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from ..instrumentation import LabwareInfo, NameBinding
from ..vocabulary import WellRef
from .rulefiles import Common
from .source import Place, SourceFacts
from .trace import Trace, row_column
from .words import Lexicon, tokens


class Strength(IntEnum):
    """How much a clue is worth; more beats less."""

    MODEL = 1
    COMMENT = 2
    LOOSE_NAME = 3
    DESCRIPTION = 4
    NAME = 5
    LIQUID = 6
    GIVEN = 7


@dataclass(frozen=True)
class Clue:
    """One piece of evidence.

    Attributes:
        strength: What kind it is.
        text: The words.
        wells: The wells it speaks of, in order.
        line: Where it stands in the source, if it does.
        said: For people: "name `ntc` at line 12".
        whole: Whether it speaks of a whole labware rather than of chosen wells.
        role: The role itself, where it was given outright.
        levels: Concentrations or doses beside the wells, if any.
        subject: Whether only the last word names the thing, as in ``sample_buffer``.
        step: For a comment beside a transfer: ``source`` or ``destination`` of the transfer.
    """

    strength: Strength
    text: str
    wells: tuple[WellRef, ...]
    line: int | None
    said: str
    whole: bool = False
    role: str = ""
    levels: tuple[float | None, ...] = ()
    subject: bool = True
    step: str = ""


_WELL = r"[A-P](?:0?[1-9]|1\d|2[0-4])"
_WELL_NAME = re.compile(rf"^{_WELL}$")
_SPEC = re.compile(
    rf"\b(?:(?P<first>{_WELL})(?:\s*(?:-|–|—|to|through|\.\.+|:)\s*(?P<last>{_WELL}))?"
    r"|col(?:umn)?s?\.?\s*(?P<column>1\d|2[0-4]|[1-9])(?:\s*(?:-|–|to)\s*(?P<column2>\d+))?"
    r"|rows?\s+(?P<row>[A-P])(?:\s*(?:-|–|to)\s*(?P<row2>[A-P]))?)\b"
)


def gather(
    trace: Trace,
    names: Sequence[NameBinding],
    facts: SourceFacts,
    given: Mapping[str, Sequence[str]],
    common: Common,
) -> list[Clue]:
    """All clues of one protocol.

    Args:
        trace: A first reading of the run, to know labware, liquids and used wells.
        names: Names that held wells, from the rehearsal.
        facts: What the text says.
        given: Roles given outright: role to places (``"4:H12"``, ``"PCR plate:A1-A8"``).
        common: Words for amounts.
    """
    deck = Deck(trace, names)
    clues = [
        *_given(deck, given),
        *_liquids(trace, facts),
        *_names(deck, names, facts, common),
        *_labels(deck),
        *_places(deck, facts),
        *_plate_maps(deck, facts),
        *_written(deck, facts),
        *_step_comments(trace, facts, common),
        *_arguments(trace, facts),
    ]
    return list(dict.fromkeys(clue for clue in clues if clue.wells))


class Deck:
    """Finds wells by the labware's name, label or slot and by well names."""

    def __init__(self, trace: Trace, names: Sequence[NameBinding]) -> None:
        self.trace = trace
        self.refs: dict[tuple[str, str], WellRef] = {}
        for well in trace.wells.values():
            self.refs.setdefault((well.ref.labware, well.ref.name), well.ref)
        self.by_name: dict[str, set[str]] = {}
        for binding in names:
            if binding.labware and not binding.wells:
                self.by_name.setdefault(binding.name, set()).update(binding.labware)
        self.received = {
            (well.ref.labware, well.ref.name)
            for well in trace.wells.values()
            if any(True for _ in trace.deliveries(well))
        }

    def ref(self, labware: str, name: str) -> WellRef:
        """The reference of a well, made up where the run never used it."""
        known = self.refs.get((labware, name))
        if known is not None:
            return known
        info = self.trace.labware[labware]
        return WellRef(labware, name, info.label or info.display_name, info.slot)

    def used_wells(self, labware: Sequence[str]) -> tuple[WellRef, ...]:
        """The wells of these labware that the run uses."""
        return tuple(ref for (key, _), ref in self.refs.items() if key in labware)

    def plates(self) -> list[LabwareInfo]:
        """Labware that holds liquid."""
        return [
            info
            for info in self.trace.labware.values()
            if not info.is_tip_rack and not info.is_trash and info.wells
        ]

    def labware_called(self, words: str) -> list[str]:
        """Keys of labware by slot, label or the name of a variable."""
        wanted = tokens(words)
        found = []
        for info in self.plates():
            if wanted and (
                wanted == tokens(info.slot)
                or wanted == tokens(info.label)
                or wanted == tokens(info.key)
                or wanted == tokens(info.load_name)
            ):
                found.append(info.key)
        return found or sorted(self.by_name.get(words, ()))

    def most_likely(self, names: Iterable[str]) -> str:
        """The one labware in which all these wells were used, or ``""``."""
        names = list(names)
        used = [
            info.key
            for info in self.plates()
            if all(name in info.wells for name in names)
            and any((info.key, name) in self.refs for name in names)
        ]
        full = [key for key in used if all((key, name) in self.refs for name in names)] or used
        if len(full) > 1:
            full = [
                key for key in full if any((key, name) in self.received for name in names)
            ] or full
        return full[0] if len(full) == 1 else ""


def _given(deck: Deck, given: Mapping[str, Sequence[str]]) -> Iterator[Clue]:
    for role, places in given.items():
        wells: list[WellRef] = []
        for place in places:
            labware, _, spec = str(place).rpartition(":")
            for key in deck.labware_called(labware):
                wells.extend(
                    deck.ref(key, name) for name in spec_wells(spec, deck.trace.labware[key])
                )
        yield Clue(
            Strength.GIVEN, role, tuple(wells), None, f"given to the guard as {role}", role=role
        )


def _liquids(trace: Trace, facts: SourceFacts) -> Iterator[Clue]:
    by_name: dict[str, list[WellRef]] = {}
    for well in trace.wells.values():
        for liquid in well.liquids:
            by_name.setdefault(liquid, []).append(well.ref)
    for liquid, wells in by_name.items():
        yield Clue(Strength.LIQUID, liquid, tuple(wells), None, f"liquid '{liquid}'")
        description = facts.liquids.get(liquid)
        if description:
            yield Clue(
                Strength.DESCRIPTION,
                description,
                tuple(wells),
                None,
                f"liquid '{liquid}', described as '{_short(description)}'",
                subject=False,
            )


def _names(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    comprehension = {name for function, name in facts.loose if function == "<comprehension>"}
    keyed = _numeric_keys(names)
    for binding in names:
        base = binding.name.split("[", 1)[0]
        loose = (binding.function, base) in facts.loose or (
            binding.function.startswith("<") and base in comprehension
        )
        line = facts.assigned.get(base, binding.line)
        if (binding.function, base) in facts.loops:
            continue  # its last value only; see _arguments
        whole = not binding.wells
        wells = binding.wells or deck.used_wells(binding.labware)
        yield Clue(
            Strength.LOOSE_NAME if loose else Strength.NAME,
            binding.name,
            wells,
            line,
            f"name `{binding.name}` at line {line}",
            whole=whole,
            levels=(keyed[binding.name],) * len(wells) if binding.name in keyed else (),
        )
        if binding.name == base and binding.wells:
            yield from _beside(binding, facts, line)
            yield from _parallel(binding, facts, common)
        note = facts.notes.get(base)
        if note and not loose and binding.name == base:
            yield Clue(
                Strength.COMMENT,
                note,
                wells,
                line,
                f"comment '{_short(note)}' at line {line}",
                whole=whole,
                subject=False,
            )


def _numeric_keys(names: Sequence[NameBinding]) -> dict[str, float | None]:
    """Level of each name like ``standards[125]``; ``None`` where the keys only count."""
    groups: dict[str, dict[str, float]] = {}
    for binding in names:
        match = re.fullmatch(r"(.*)\[(-?\d+(?:\.\d+)?)\]", binding.name)
        if match:
            groups.setdefault(match[1], {})[binding.name] = float(match[2])
    found: dict[str, float | None] = {}
    for group in groups.values():
        values = sorted(group.values())
        counting = values in (
            [float(n) for n in range(len(values))],
            [float(n + 1) for n in range(len(values))],
        )
        found.update({name: None if counting else value for name, value in group.items()})
    return found


def _beside(binding: NameBinding, facts: SourceFacts, line: int) -> Iterator[Clue]:
    """What stands beside each well in a list of rows: ``[(plate["H12"], "NTC", 0.5), ...]``."""
    rows = facts.tables.get(binding.name)
    if rows is None or len(rows) != len(binding.wells):
        return
    for row, ref in zip(rows, binding.wells, strict=False):
        for text in row:
            if isinstance(text, str) and not _WELL_NAME.match(text):
                yield Clue(
                    Strength.NAME,
                    text,
                    (ref,),
                    line,
                    f"'{text}' beside it in `{binding.name}` at line {line}",
                )
    columns = [[item for item in row if _is_number(item)] for row in rows]
    if all(len(numbers) == 1 for numbers in columns):
        levels = tuple(float(numbers[0]) for numbers in columns)
        if len(set(levels)) > 1:
            yield Clue(
                Strength.NAME,
                binding.name,
                binding.wells,
                line,
                f"numbers beside it in `{binding.name}` at line {line}",
                levels=levels,
            )


def _parallel(binding: NameBinding, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """A list of concentrations as long as the list of wells: ``standard_concs``."""
    amounts = Lexicon({"amount": common.amounts})
    lists = []
    for name, value in facts.constants.items():
        if not isinstance(value, (list, tuple)) or len(value) != len(binding.wells):
            continue
        if len(value) < 2 or not all(_is_number(item) for item in value):
            continue
        if amounts.find(name):
            shared = set(tokens(name)) & set(tokens(binding.name))
            lists.append((len(shared), name, tuple(float(item) for item in value)))
    if not lists:
        return
    best = max(shared for shared, _, _ in lists)
    chosen = [entry for entry in lists if entry[0] == best]
    if len({levels for _, _, levels in chosen}) == 1:
        _, name, levels = chosen[0]
        line = facts.assigned.get(name)
        yield Clue(
            Strength.NAME,
            binding.name,
            binding.wells,
            line,
            f"`{name}` at line {line}",
            levels=levels,
        )


def _labels(deck: Deck) -> Iterator[Clue]:
    for info in deck.trace.labware.values():
        if info.label and not info.is_tip_rack and not info.is_trash:
            yield Clue(
                Strength.NAME,
                info.label,
                deck.used_wells((info.key,)),
                None,
                f"label '{info.label}'",
                whole=True,
            )


def _places(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    for place in facts.places:
        keys = deck.by_name.get(place.labware, set())
        if len(keys) != 1:
            continue
        key = next(iter(keys))
        wells = tuple(_indexed(deck, key, place))
        for name in place.names:
            if wells and ("<comprehension>", name) not in facts.loose:
                yield Clue(
                    Strength.NAME,
                    name,
                    wells,
                    place.line,
                    f"name `{name}` at line {place.line}",
                )


def _indexed(deck: Deck, key: str, place: Place) -> Iterator[WellRef]:
    info = deck.trace.labware[key]
    value = place.value
    names = list(info.wells)
    if place.kind in ("well", "wells") and not isinstance(value, str):
        groups = [[name] for name in names]
    elif place.kind in ("columns", "column"):
        groups = _grouped(names, 1)
    elif place.kind in ("rows", "row"):
        groups = _grouped(names, 0)
    else:
        groups = []
    if isinstance(value, bool):
        return
    if isinstance(value, int) and -len(groups) <= value < len(groups):
        chosen = groups[value]
    elif isinstance(value, slice) and value != slice(None, None):
        chosen = [name for group in groups[value] for name in group]
    elif isinstance(value, str) and place.kind in ("column", "row"):
        if place.kind == "column" and not value.isdigit():
            return
        at = 1 if place.kind == "column" else 0
        wanted = int(value) - 1 if value.isdigit() else row_column(value)[0]
        chosen = [name for name in names if row_column(name)[at] == wanted]
    elif isinstance(value, str) and value in info.wells:
        chosen = [value]
    elif isinstance(value, (list, tuple)):
        chosen = [item for item in value if isinstance(item, str) and item in info.wells]
    else:
        return
    for name in chosen:
        yield deck.ref(key, name)


def _grouped(names: Sequence[str], axis: int) -> list[list[str]]:
    groups: dict[int, list[str]] = {}
    for name in names:
        groups.setdefault(row_column(name)[axis], []).append(name)
    return [groups[at] for at in sorted(groups)]


def _plate_maps(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    """Constants that hold well names: ``NTC_WELLS = ["H11", "H12"]``, ``{"A1": "NTC"}``."""
    for name, value in facts.constants.items():
        if name == "metadata":
            continue
        line = facts.assigned.get(name)
        entries = list(_entries(name, value))
        all_names = [well for _, wells, _ in entries for well in wells]
        if not all_names:
            continue
        labware = _used_with(deck, facts, name) or deck.most_likely(dict.fromkeys(all_names))
        if not labware:
            continue
        info = deck.trace.labware[labware]
        for text, wells, level in entries:
            refs = tuple(deck.ref(labware, well) for well in wells if well in info.wells)
            yield Clue(
                Strength.NAME,
                text,
                refs,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(refs),
            )


def _used_with(deck: Deck, facts: SourceFacts, name: str) -> str:
    """The labware that is indexed by this constant, straight or in a comprehension."""
    keys: set[str] = set()
    for place in facts.places:
        if name in place.names:
            keys |= deck.by_name.get(place.labware, set())
    return next(iter(keys)) if len(keys) == 1 else ""


def _entries(
    name: str, value: Any, depth: int = 0
) -> Iterator[tuple[str, tuple[str, ...], float | None]]:
    """``(text, well names, level)`` of a constant that holds well names."""
    if depth > 3:
        return
    if isinstance(value, str):
        if _WELL_NAME.match(value):
            yield name, (value,), None
        return
    if isinstance(value, Mapping):
        for key, item in value.items():
            if isinstance(key, str) and _WELL_NAME.match(key):
                for text in _said_of(item):
                    yield text, (key,), None
                for number in _numbers_of(item):
                    yield name, (key,), number
            else:
                level = float(key) if _is_number(key) else None
                for text, wells, own in _entries(f"{name} {key}", item, depth + 1):
                    yield text, wells, level if own is None else own
        return
    if isinstance(value, (list, tuple)):
        wells = tuple(item for item in value if isinstance(item, str) and _WELL_NAME.match(item))
        if wells and len(wells) == len(value):
            yield name, wells, None
            return
        texts = [item for item in value if isinstance(item, str) and not _WELL_NAME.match(item)]
        if wells and depth > 0:
            numbers = [float(item) for item in value if _is_number(item)]
            for text in texts or [name]:
                yield text, wells, numbers[0] if len(numbers) == 1 else None
            return
        for item in value:
            if isinstance(item, (list, tuple, Mapping)):
                yield from _record(name, item, depth + 1)


def _record(
    name: str, item: Any, depth: int
) -> Iterator[tuple[str, tuple[str, ...], float | None]]:
    """A row of a table: ``{"well": "A1", "type": "NTC"}`` or ``("A1", "NTC", 5)``."""
    if isinstance(item, Mapping):
        wells = tuple(v for v in item.values() if isinstance(v, str) and _WELL_NAME.match(v))
        if len(wells) == 1:
            for value in item.values():
                if isinstance(value, str) and value not in wells:
                    yield value, wells, None
            return
    yield from _entries(name, item, depth)


def _said_of(item: Any) -> Iterator[str]:
    if isinstance(item, str):
        yield item
    elif isinstance(item, Mapping):
        yield from (value for value in item.values() if isinstance(value, str))
    elif isinstance(item, (list, tuple)):
        yield from (value for value in item if isinstance(value, str))


def _numbers_of(item: Any) -> Iterator[float]:
    if _is_number(item):
        yield float(item)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _written(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    """Well names in comments and docstrings: "A1-A8: samples", "NTC in H12"."""
    texts = list(facts.docstrings)
    texts += list(facts.comments.items())
    texts += [(1, text) for text in facts.metadata.values()]
    for line, text in texts:
        for number, written in enumerate(text.splitlines() or [text]):
            for clause in re.split(
                r"[;|]|,(?=\s*(?:[a-zA-Z ]{0,20}\b[A-P]\d|[A-Za-z]{3,}))", written
            ):
                found = list(_SPEC.finditer(clause))
                if not found or len(clause) > 160:
                    continue
                rest = _SPEC.sub(" ", clause)
                if not tokens(rest):
                    continue
                at = line + number
                yield from _spoken(deck, clause, rest, found, at)


def _spoken(
    deck: Deck, clause: str, rest: str, found: Sequence[re.Match[str]], line: int
) -> Iterator[Clue]:
    named = [
        info.key
        for info in deck.plates()
        if info.label and f" {' '.join(tokens(info.label))} " in f" {' '.join(tokens(rest))} "
    ]
    for labware in named if len(named) == 1 else [info.key for info in deck.plates()]:
        info = deck.trace.labware[labware]
        wells: list[WellRef] = []
        for match in found:
            wells.extend(
                deck.ref(labware, name)
                for name in _match_wells(match, info)
                if (labware, name) in deck.refs
            )
        if wells:
            yield Clue(
                Strength.COMMENT,
                rest,
                tuple(wells),
                line,
                f"'{_short(clause)}' at line {line}",
                subject=False,
            )


def _arguments(trace: Trace, facts: SourceFacts) -> Iterator[Clue]:
    """Names of what calls draw from and give to: every value that a loop variable took."""
    used: dict[tuple[str, str], dict[WellRef, None]] = {}
    at_line: dict[str, int] = {}
    for visit in trace.visits:
        if visit.mixing or visit.line not in facts.arguments:
            continue
        side = "source" if visit.kind.value == "aspirate" else "destination"
        for wanted, name in facts.arguments[visit.line]:
            if wanted == side:
                used.setdefault((side, name), {})[visit.well.ref] = None
                at_line.setdefault(name, visit.line)
    for (_, name), wells in used.items():
        line = at_line[name]
        yield Clue(
            Strength.LOOSE_NAME, name, tuple(wells), line, f"name `{name}` used at line {line}"
        )


_LONGEST_STEP_COMMENT = 14


def _step_comments(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Comments beside or right above a transfer: "# distribute diluent".

    They name what is drawn, if they name one thing only; short ones with nothing else in them
    may name a single destination ("# NTC").
    """
    beside = _comment_of_line(facts)
    unsaid = Lexicon({"not": common.negations})
    drawn: dict[str, dict[WellRef, None]] = {}
    given: dict[str, dict[WellRef, None]] = {}
    at_line: dict[str, int] = {}
    for visit in trace.visits:
        if visit.mixing:
            continue
        for line in visit.lines:
            text = beside.get(line)
            if text is None:
                continue
            at_line[text] = line
            if visit.kind.value == "aspirate":
                drawn.setdefault(text, {})[visit.well.ref] = None
            elif visit.parts:
                given.setdefault(text, {})[visit.well.ref] = None
            break
    for text, line in at_line.items():
        count = len(tokens(text))
        if count > _LONGEST_STEP_COMMENT or unsaid.find(text):
            continue
        said = f"comment '{_short(text)}' at line {line}"
        sources = tuple(ref for ref in drawn.get(text, ()) if ref not in given.get(text, ()))
        if sources:
            yield Clue(Strength.COMMENT, text, sources, line, said, subject=False, step="source")
        into = tuple(given.get(text, ()))
        if into and count <= _LONGEST_STEP_COMMENT // 2 and len(into) <= 8:
            yield Clue(Strength.COMMENT, text, into, line, said, subject=False, step="destination")


def _comment_of_line(facts: SourceFacts) -> dict[int, str]:
    """The comment that speaks of each line: beside it, or right above its block."""
    found: dict[int, str] = {}
    for line, text in facts.comments.items():
        if line not in facts.own_line:
            found[line] = text
    for line in sorted(facts.own_line):
        below = line + 1
        if below in facts.own_line:
            continue
        text = facts.comments[line]
        first = line
        while first - 1 in facts.own_line:
            first -= 1
            text = f"{facts.comments[first]} {text}"
        for covered in facts.blocks.get(below, (below,)):
            found.setdefault(covered, text)
    return found


def spec_wells(spec: str, info: LabwareInfo) -> list[str]:
    """Well names of ``"A1"``, ``"A1-B3"``, ``"A1, A2"``, ``"column 12"``, ``"row A"``, ``"*"``."""
    if spec.strip() in ("", "*"):
        return list(info.wells)
    names: list[str] = []
    for match in _SPEC.finditer(spec):
        names.extend(name for name in _match_wells(match, info) if name not in names)
    return names


def _match_wells(match: re.Match[str], info: LabwareInfo) -> list[str]:
    parts = match.groupdict()
    names = list(info.wells)
    if parts["first"]:
        first = _plain(parts["first"])
        if not parts["last"]:
            return [first] if first in info.wells else []
        (r1, c1), (r2, c2) = row_column(first), row_column(_plain(parts["last"]))
        rows, columns = sorted((r1, r2)), sorted((c1, c2))
        return [
            name
            for name in names
            if rows[0] <= row_column(name)[0] <= rows[1]
            and columns[0] <= row_column(name)[1] <= columns[1]
        ]
    if parts["column"]:
        low = int(parts["column"])
        high = int(parts["column2"] or low)
        return [name for name in names if low <= row_column(name)[1] + 1 <= high]
    low_row = row_column(parts["row"] + "1")[0]
    high_row = row_column((parts["row2"] or parts["row"]) + "1")[0]
    return [name for name in names if low_row <= row_column(name)[0] <= high_row]


def _plain(name: str) -> str:
    return name[0] + str(int(name[1:]))


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= 60 else text[:57] + "..."
