"""Names, keys and fields that held wells in the rehearsal: ``ntc``, ``tubes["water"]``."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import takewhile

from ...adapters.opentrons.instrumentation import NameBinding
from ...vocabulary import WellRef
from ..rules import Common
from ..source import SourceFacts, level_in, lexicon_of, tokens
from .deck import DeckNames
from .evidence import Evidence, Kind

NUMBERED = re.compile(r"(.*)\[(?P<quote>['\"]?)(-?\d+(?:\.\d+)?)(?P=quote)\](.*)")


def named_wells(
    deck: DeckNames, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Evidence]:
    """What variables, keys and attributes were called that held wells or whole labware."""
    keyed, listed = levels_of_keys(names), _lists_of_levels(names, common)
    held = sorted({frozenset(one.wells) for one in names}, key=len, reverse=True)
    bound = Counter((one.function, one.name) for one in names if one.wells)
    for binding in names:
        if not (binding.wells or binding.labware):
            continue
        place = (binding.function, base_of(binding))
        mine = set(binding.wells)
        longer = takewhile(lambda other: len(other) > len(mine), held)  # noqa: B023
        if place in facts.varying and any(mine < other for other in longer):
            continue  # the list that it runs over says as much of all its wells
        line = line_of(binding, facts)
        wells = deck.meant(binding.wells) or deck.used_wells(binding.labware)
        level = keyed.get(binding.name)
        text = binding.name
        levels: tuple[float | None, ...] = ()
        if binding.name in keyed:
            text = NUMBERED.sub(r"\1\4", text) if level is None else text
            levels = (level,) * len(wells)
        elif binding.wells and len(wells) > 1:
            levels = _listed_beside(binding, listed)
        yield Evidence(
            Kind.PASSING_NAME
            if place in facts.passing or bound[binding.function, binding.name] > 1
            else Kind.NAME,
            text,
            wells,
            f"name `{binding.name}` at line {line}",
            whole=not binding.wells,
            levels=levels,
            variable=True,
        )


def base_of(binding: NameBinding) -> str:
    """``layout`` of ``layout["ntc"]``."""
    return binding.name.split("[", 1)[0]


def line_of(binding: NameBinding, facts: SourceFacts) -> int:
    """Where the name, or the field of this name, is first given a value."""
    return facts.assigned.get(base_of(binding).rpartition(".")[2], binding.line)


def fields_of_rows(names: Sequence[NameBinding], facts: SourceFacts) -> Iterator[Evidence]:
    """What the columns are called that hold wells, for all rows of a list together:
    ``[{"sample": tube, "vehicle": trough}, ...]``; a loop over it leaves the last row only.
    """
    for binding in names:
        base = base_of(binding)
        if len(binding.rows) < 2 or (binding.function, base) in facts.varying:
            continue
        held: dict[str, dict[WellRef, None]] = {}
        for row in binding.rows:
            for column, cell in row.cells:
                if isinstance(cell, WellRef) and column and not column.isdigit():
                    held.setdefault(column, {})[cell] = None
        line = line_of(binding, facts)
        for column, wells in held.items():
            citation = f"field `{column}` of `{binding.name}` at line {line}"
            yield Evidence(Kind.NAME, f"{base}.{column}", tuple(wells), citation)


def levels_of_keys(names: Sequence[NameBinding]) -> dict[str, float | None]:
    """Level of each name like ``standards[125]``; ``None`` where the keys only count."""
    groups: dict[tuple[str, str], dict[str, float]] = {}
    for binding in names:
        match = NUMBERED.fullmatch(binding.name)
        if match:
            group = groups.setdefault((match[1] + match[4], match["quote"]), {})
            group[binding.name] = float(match[3])
    found: dict[str, float | None] = {}
    for (_, quote), group in groups.items():
        values = sorted(group.values())
        counting = any(values == [float(n + at) for n in range(len(values))] for at in (0, 1))
        if not (counting and quote):  # `tubes["1"]` names something rather than counts it
            found.update({name: None if counting else value for name, value in group.items()})
    return found


def _lists_of_levels(
    names: Sequence[NameBinding], common: Common
) -> dict[tuple[str, str], tuple[float, ...]]:
    """Lists of concentrations or doses by function and name: ``STANDARD_CONCS = [0, 125, 250]``."""
    amounts = lexicon_of({"amount": common.amounts})
    found: dict[tuple[str, str], tuple[float, ...]] = {}
    for one in names:
        if len(one.values) > 1 and amounts.find(one.name):
            levels = [_level(item, common) for item in one.values]
            if None not in levels:
                found[one.function, one.name] = tuple(lv for lv in levels if lv is not None)
    return found


def _listed_beside(
    wells: NameBinding, listed: Mapping[tuple[str, str], tuple[float, ...]]
) -> tuple[float, ...]:
    """Of the lists of levels that are as long as a list of wells, the one whose name shares most
    words with it; of two of one name that of its own function.
    """
    own = {name for function, name in listed if function == wells.function}
    fitting: dict[int, set[tuple[float, ...]]] = {}
    for (function, name), levels in listed.items():
        if len(levels) == len(wells.wells) and (function == wells.function or name not in own):
            shared = set(tokens(name)) & set(tokens(wells.name))
            fitting.setdefault(len(shared), set()).add(levels)
    chosen = fitting[max(fitting)] if fitting else set()
    return chosen.pop() if len(chosen) == 1 else ()


def _level(item: float | str, common: Common) -> float | None:
    if isinstance(item, str):
        return level_in(item, common.levels)
    try:
        return float(item)
    except OverflowError:  # an integer of hundreds of digits
        return None
