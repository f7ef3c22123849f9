"""The trace as a compact table for a reader with little room: a model, or a person.

One line per tip session. What a loop repeats is folded: ``8x (L36 draw 10 2:A1-H1; ...)``, wells
listed in the order of the repetitions. A table that would be too long is folded further, to
counts and ranges, until it fits: every tip session is in it.

Words: ``draw V W`` aspirates V µL from W; ``give`` dispenses and touches the liquid there;
``give^`` clear of the liquid, touching nothing; ``give.`` into a dry well; ``mix V``; ``blow`` and
its marks likewise; ``touch`` the wall.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby, pairwise, takewhile
from typing import TypeVar

from ...adapters.opentrons.instrumentation import OperationKind
from ...vocabulary import WellRef
from .geometry import row_column
from .model import Visit
from .trace import Trace

_WORDS = {
    OperationKind.ASPIRATE: "draw",
    OperationKind.DISPENSE: "give",
    OperationKind.BLOW_OUT: "blow",
    OperationKind.TOUCH_TIP: "touch",
}
_LONGEST_CYCLE = 8
_LONGEST_MERGED = 16
_LONGEST_LISTS = (6000, 600, 240, 60)
"""So many characters of wells are told in one row, by the room that there is."""

Told = Callable[[Sequence[WellRef]], str]


@dataclass(frozen=True)
class _Row:
    """One thing that the channels of a pipette did together."""

    word: str
    volume: float
    line: int | None
    wells: tuple[WellRef, ...]

    @property
    def signature(self) -> Hashable:
        """Equal for rows that a loop repeats."""
        return (self.word, f"{self.volume:.4g}", self.line, len(self.wells))


@dataclass
class _Session:
    """From pick-up to drop of one tip, or of the tips of one multi-channel pipette."""

    tips: tuple[int, ...]
    again: bool
    rows: list[_Row]

    @property
    def signature(self) -> Hashable:
        """Equal for sessions that a loop repeats."""
        if len(self.rows) > _LONGEST_MERGED:
            return id(self)
        return (self.again, len(self.tips), tuple(row.signature for row in self.rows))

    @property
    def shape(self) -> Hashable:
        """Equal for sessions that do the same things at the same lines, however often."""
        return (self.again, frozenset((row.word, row.line) for row in self.rows))


_Told = TypeVar("_Told", _Row, _Session)


def trace_table(trace: Trace, limit: int = 6000) -> tuple[str, ...]:
    """The lines of the table, of about ``limit`` characters in all."""
    for lines in _foldings(_sessions(trace)):
        if sum(len(line) + 1 for line in lines) <= limit:
            break
    return tuple(lines)


def _foldings(sessions: Sequence[_Session]) -> Iterator[list[str]]:
    """The table in ever fewer words."""
    repeated = list(_repeated(sessions))
    alike: dict[Hashable, list[_Session]] = {}
    for session in sessions:
        alike.setdefault(session.shape, []).append(session)
    for longest in _LONGEST_LISTS:
        wells = partial(_in_short, longest=longest)
        lines = []
        for count, block in repeated:
            told = [_told(same, wells) for same in block]
            many = f"{count} times in turn [{' | '.join(told)}]"
            lines.append(told[0] if len(told) == 1 else many)
        yield lines
        yield [_summed(same, wells, by_line=True) for same in alike.values()]
    together = 2
    while together < 2 * len(sessions):
        starts = range(0, len(sessions), together)
        yield [_summed(sessions[at : at + together], wells, by_line=False) for at in starts]
        together *= 2


def _sessions(trace: Trace) -> list[_Session]:
    found: list[_Session] = []
    latest: dict[tuple[int, int], _Session] = {}
    for _, group in groupby(trace.visits, key=lambda visit: visit.index):
        visits = list(group)
        key = (visits[0].tip.number, visits[0].session)
        tips = tuple(visit.tip.number for visit in visits)
        session = latest.get(key)
        if session is None:
            session = latest[key] = _Session(tips, visits[0].session > 1, [])
            found.append(session)
        session.tips = max(session.tips, tips, key=len)
        _append(session.rows, visits)
    return found


def _append(rows: list[_Row], visits: list[Visit]) -> None:
    first = visits[0]
    wells = tuple(dict.fromkeys(visit.well.ref for visit in visits))
    word = _WORDS.get(first.kind, first.kind.value)
    if first.mixing:
        # A mix is drawing and giving back, again and again: one row. How often is not told,
        # since the trace keeps a repeated mix once.
        row = _Row("mix", first.volume, first.line, wells)
        if word != "give" and (not rows or rows[-1] != row):
            rows.append(row)
        return
    if word in ("give", "blow") and not any(visit.touches for visit in visits):
        word += "." if any(visit.contact for visit in visits) else "^"
    rows.append(_Row(word, first.volume, first.line, wells))


def _told(same: Sequence[_Session], wells: Told) -> str:
    """Sessions that a loop repeats in one line."""
    if len(same) > 1:
        rows = [_rows([alike], wells) for alike in zip(*(s.rows for s in same), strict=True)]
    else:
        rows = []
        for count, block in _repeated(same[0].rows):
            inner = "; ".join(_rows([alike], wells) for alike in block)
            rows.append(inner if count == 1 else f"{count}x ({inner})")
    return f"{_tips(same)}: {'; '.join(rows)}"


def _rows(parts: Sequence[Sequence[_Row]], wells: Told) -> str:
    """Rows of one word, told together, with a border between the wells of two sessions."""
    rows = [row for part in parts for row in part]
    line = f"L{rows[0].line} " if rows[0].line is not None else ""
    most = max(row.volume for row in rows)
    low, high = (f"{volume:.4g}" for volume in (min(row.volume for row in rows), most))
    volume = f" {high if low == high else f'{low}-{high}'}" if most else ""
    places = " | ".join(wells([well for row in part for well in row.wells]) for part in parts)
    return f"{line}{rows[0].word}{volume} {places}"


def _summed(sessions: Sequence[_Session], wells: Told, by_line: bool) -> str:
    """Several tip sessions in one line: what they did, each thing once with its wells, which stand
    in the order of the sessions: of as many drawn from as given to, the third goes into the third.
    """
    rows: dict[Hashable, list[list[_Row]]] = {}
    for session in sessions:
        mine: dict[Hashable, list[_Row]] = {}
        for row in session.rows:
            line = row.line if by_line else None
            mine.setdefault((row.word, line), []).append(replace(row, line=line))
        for what, same in mine.items():
            rows.setdefault(what, []).append(same)
    told = []
    for parts in rows.values():
        # Where one tip did it several times, it is told which.
        bordered = by_line and len({len(part) for part in parts}) > 1
        told.append(_rows(parts if bordered else [[one for part in parts for one in part]], wells))
    if not by_line:
        lines = [row.line for session in sessions for row in session.rows if row.line]
        told.insert(0, f"lines {min(lines, default=0)}-{max(lines, default=0)}")
    return f"{_tips(sessions)}: {'; '.join(told)}"


def _tips(sessions: Sequence[_Session]) -> str:
    numbers = [number + 1 for session in sessions for number in session.tips]
    text = "tip " if len(numbers) == 1 else "tips "
    consecutive = numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    if len(numbers) > 1 and consecutive:
        text += f"{numbers[0]}-{numbers[-1]}"
    else:
        text += ",".join(map(str, numbers[:8])) + (",..." if len(numbers) > 8 else "")
    if len(sessions[0].tips) > 1:
        text += f" ({len(sessions[0].tips)} channels at once)"
    if len(sessions) > 1:
        follow = all(after - before in (0, 1) for before, after in pairwise(numbers))
        how = " one after the other" if follow else ", others in between"
        text += f", {len(sessions)} pick-ups{how}"
    again = sum(session.again for session in sessions)
    if again:
        text += ", USED BEFORE" if again == len(sessions) else f", {again} of them USED BEFORE"
    return text


def _repeated(items: Sequence[_Told]) -> Iterator[tuple[int, list[Sequence[_Told]]]]:
    """Cuts a sequence into repeated blocks: how often, and what stands at each place of one."""
    signatures = [item.signature for item in items]
    at = 0
    while at < len(items):
        best = (1, 1)
        for period in range(1, min(_LONGEST_CYCLE, (len(items) - at) // 2) + 1):
            count = 1
            block = signatures[at : at + period]
            while signatures[at + count * period : at + (count + 1) * period] == block:
                count += 1
            if count > 1 and period * count > best[0] * best[1]:
                best = (period, count)
        period, count = best
        end = at + period * count
        yield count, [items[at + place : end : period] for place in range(period)]
        at = end


def _in_short(wells: Sequence[WellRef], longest: int) -> str:
    """Wells, the first of them where they are many: ``2:A1-H1,... (40 wells)``."""
    text = places(wells)
    if len(text) <= longest:
        return text
    return f"{text[:longest].rpartition(',')[0]},... ({len(set(wells))} wells)"


def places(wells: Sequence[WellRef]) -> str:
    """Wells in order, folded: ``2:A1-H1,3×A2``, ranges running down the columns."""
    if len(set(wells)) == 1:
        return wells[0].address
    parts: list[str] = []
    slot = ""
    at = 0
    while at < len(wells):
        first = wells[at]
        same = len(list(takewhile(first.__eq__, wells[at:])))
        length = same if same > 1 else _run(wells[at:])
        last = wells[at + length - 1]
        prefix = first.address.rpartition(":")[0]
        name = first.name if length == 1 else f"{first.name}-{last.name}"
        if same > 1:
            name = f"{same}×{first.name}"
        parts.append(name if prefix == slot else f"{prefix}:{name}")
        slot = prefix
        at += length
    return ",".join(parts)


def _run(wells: Sequence[WellRef]) -> int:
    """How many wells from the first on make a column, a row or whole columns, in that order."""
    row, column = row_column(wells[0].name)

    def length(way: Callable[[int], tuple[int, int]]) -> int:
        for number, well in enumerate(wells):
            down, along = way(number)
            here = row_column(well.name) == (row + down, column + along)
            if not here or well.labware != wells[0].labware:
                return number
        return len(wells)

    high = length(lambda number: (number, 0))
    whole = length(lambda number: (number % high, number // high))
    best = max(high, length(lambda number: (0, number)), whole - whole % high)
    return best if best > 2 else 1
