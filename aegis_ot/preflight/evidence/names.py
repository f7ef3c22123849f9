"""Names that held wells in the rehearsal, and what stands beside those wells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ...instrumentation import NameBinding, OperationKind, is_spot
from ...vocabulary import WellRef
from ..layouts import LEFT_OUT, Deck, well_names
from ..rules import Common
from ..text import SourceFacts, level_in, lexicon_of, tokens, words_of
from ..trace import Trace
from .clues import Clue, Strength, shortened
from .levels import are_amounts, is_number, names_amounts
from .name_parts import without_position
from .named_levels import NUMBERED, amounts_in_names, keyed_amounts, listed_beside, numeric_keys


def named_wells(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """What variables were called that held wells or whole labware."""
    comprehension = {name for function, name in facts.loose if function == "<comprehension>"}
    lists = _lists(names, facts, common)
    told = keyed_amounts(names, facts, common)
    amounts_named = amounts_in_names(names) | (told if are_amounts(told.values()) else {})
    keyed = {**told, **numeric_keys(names)}
    for binding in names:
        base = binding.name.split("[", 1)[0]
        loose = (binding.function, base) in facts.loose or (
            binding.function.startswith("<") and base in comprehension
        )
        line = facts.assigned.get(base, binding.line)
        if (binding.function, base) in facts.loops:
            continue  # its last value only; see call_arguments
        whole = not binding.wells
        wells = _meant(deck, binding.wells) or deck.used_wells(binding.labware)
        counted = binding.name in keyed and keyed[binding.name] is None
        yield Clue(
            Strength.LOOSE_NAME if loose else Strength.NAME,
            NUMBERED.sub(r"\1\4", binding.name) if counted else binding.name,
            wells,
            line,
            f"name `{binding.name}` at line {line}",
            whole=whole,
            levels=(keyed[binding.name],) * len(wells) if binding.name in keyed else (),
        )
        if binding.name == base and binding.wells:
            yield from _beside(binding, facts, line)
            yield from _parallel(binding, lists, facts, common)
        if binding.name in amounts_named:
            yield Clue(
                Strength.LOOSE_NAME,
                "standard",
                wells,
                line,
                f"name `{binding.name}`, one of several with amounts, at line {line}",
                levels=(amounts_named[binding.name],) * len(wells),
            )
        note = facts.notes.get(base)
        if levels := listed_beside(facts, line, wells, common) if not (loose or whole) else ():
            said = f"levels listed beside `{binding.name}` at line {line}"
            yield Clue(Strength.COMMENT, "", wells, line, said, subject=False, levels=levels)
        chosen = binding.name == base and not _is_all(deck, binding.wells)
        if note and not loose and chosen and of_all(note, wells, common):
            yield Clue(
                Strength.COMMENT,
                note,
                wells,
                line,
                f"comment '{shortened(note)}' at line {line}",
                whole=whole,
                subject=False,
                lone=len(wells) > 1,
            )


def _meant(deck: Deck, wells: tuple[WellRef, ...]) -> tuple[WellRef, ...]:
    """The wells of a name, without those of whole columns or rows that are not used this time.

    A few that the run leaves out may be a mistake, and so may all of them.
    """
    if len(set(wells)) != len(wells):
        return wells
    meant = set(wells)
    for key in {ref.labware for ref in wells}:
        here = [ref for ref in wells if ref.labware == key]
        used = [ref for ref in here if (ref.labware, ref.name) in deck.refs]
        unused = len(here) - len(used)
        if used and unused > max(LEFT_OUT, len(used) // 3) and deck.are_whole_lines(here):
            meant -= set(here) - set(used)
    return tuple(ref for ref in wells if ref in meant)


def _is_all(deck: Deck, wells: Sequence[WellRef]) -> bool:
    """Whether these are all wells of a labware: such a name says which one, and not what for."""
    info = deck.trace.labware[wells[0].labware] if len(wells) > 1 else None
    return info is not None and {(info.key, name) for name in info.wells} == {
        (ref.labware, ref.name) for ref in wells
    }


def of_all(note: str, wells: Sequence[WellRef], common: Common) -> bool:
    """Whether a comment speaks of all the wells of the name that it stands beside.

    Not "H1 NTC", which :mod:`.remarks` reads, and not "the last one is the NTC".
    """
    if len(set(wells)) < 2:
        return True
    some = lexicon_of({"some": (*common.partly, *common.negations)})
    return not well_names(common).spec.search(note) and not some.find(note)


def call_arguments(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Names of what calls draw from and give to: every value that a loop variable took."""
    positions = words_of(common.positions)
    used: dict[tuple[str, str], dict[WellRef, None]] = {}
    at_line: dict[str, int] = {}
    for visit in trace.visits:
        if visit.mixing or visit.line not in facts.arguments:
            continue
        side = "source" if visit.kind is OperationKind.ASPIRATE else "destination"
        for wanted, argument in facts.arguments[visit.line]:
            if wanted != side or _counts(facts, argument) or positions >= set(tokens(argument)):
                continue  # `pos` says where it stands, not what it holds
            for name in (argument, *_looped_over(facts, argument, visit.line)):
                used.setdefault((side, name), {})[visit.well.ref] = None
                at_line.setdefault(name, visit.line)
    for (_, name), wells in used.items():
        line = at_line[name]
        yield Clue(
            Strength.LOOSE_NAME,
            without_position(name, common),
            tuple(wells),
            line,
            f"name `{name}` used at line {line}",
        )


def _looped_over(facts: SourceFacts, name: str, line: int) -> Iterator[str]:
    """The lists that loops around a line run over to give this name its values."""
    for loop in facts.runs:
        if 0 < loop.first <= line <= loop.last:
            for values in loop.values:
                if values.name == name and values.source.isidentifier():
                    yield values.source


def _counts(facts: SourceFacts, name: str) -> bool:
    """Whether a name is a running number: it says which turn it is, not what the well holds."""
    return any(other in ("range", "len") for other, _, _ in facts.comes_from.get(name, ()))


def _beside(binding: NameBinding, facts: SourceFacts, line: int) -> Iterator[Clue]:
    """What stands beside each well in a list of rows: ``[(plate["H12"], "NTC", 0.5), ...]``."""
    rows = facts.tables.get(binding.name)
    if rows is None or len(rows) != len(binding.wells):
        return
    for row, ref in zip(rows, binding.wells, strict=False):
        for text in row:
            if isinstance(text, str) and not is_spot(text):
                yield Clue(
                    Strength.NAME,
                    text,
                    (ref,),
                    line,
                    f"'{text}' beside it in `{binding.name}` at line {line}",
                )
    columns = [[item for item in row if is_number(item)] for row in rows]
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


def _lists(
    names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> list[tuple[str, tuple[float, ...]]]:
    """Lists of numbers by name: written down, or made in the run (``[2000 / 2**n ...]``)."""
    known: list[tuple[str, Sequence[Any]]] = [
        (name, value)
        for name, value in facts.constants.items()
        if isinstance(value, (list, tuple)) and len(value) > 1
    ]
    known += [
        (binding.name, binding.values)
        for binding in names
        if len(binding.values) > 1 and binding.name not in facts.constants
    ]
    return list(
        dict.fromkeys(
            (name, levels)
            for name, value in known
            if (levels := tuple(n for item in value if (n := _amount(item, common)) is not None))
            and len(levels) == len(value)
        )
    )


def _amount(item: Any, common: Common) -> float | None:
    """The number that an entry of a list is or says: ``0.4``, ``"2 mg/mL"``, ``"blank"``."""
    if isinstance(item, str):
        return level_in(item, common)
    return float(item) if is_number(item) else None


def _parallel(
    binding: NameBinding,
    lists: Sequence[tuple[str, tuple[float, ...]]],
    facts: SourceFacts,
    common: Common,
) -> Iterator[Clue]:
    """A list of concentrations as long as the list of wells: ``standard_concs``."""
    fitting = [
        (_words_shared(name, binding.name), name, levels)
        for name, levels in lists
        if len(levels) == len(binding.wells) and names_amounts(name, common)
    ]
    if not fitting:
        return
    best = max(shared for shared, _, _ in fitting)
    chosen = [entry for entry in fitting if entry[0] == best]
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


_SHORTEST_BEGINNING = 3


def _words_shared(one: str, other: str) -> int:
    """How many words of a name the other one has as well, or begins with: ``cis``, ``CISPL_UM``."""
    return sum(
        any(
            word == its
            or (
                min(len(word), len(its)) >= _SHORTEST_BEGINNING
                and (word.startswith(its) or its.startswith(word))
            )
            for its in tokens(other)
        )
        for word in set(tokens(one))
    )
