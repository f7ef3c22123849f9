"""The trace as a compact table for a reader with little room: a model, or a person.

One line per tip session. What a loop repeats is folded: ``8x (L36 draw 10 2:A1-H1; ...)``, wells
listed in the order of the repetitions. Nothing is left out silently: a table that would be too
long ends with how many lines are missing.

Words: ``draw V W`` aspirates V µL from W; ``give`` dispenses and touches the liquid there;
``give^`` from above the well, touching nothing; ``give.`` into a dry well; ``give~`` below the
rim but clear of the liquid; ``mix V``; ``blow`` and its marks likewise; ``touch`` the wall.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from .trace import Trace
from .visits import Visit
from .wells import row_column

_WORDS = {
    OperationKind.ASPIRATE: "draw",
    OperationKind.DISPENSE: "give",
    OperationKind.BLOW_OUT: "blow",
    OperationKind.TOUCH_TIP: "touch",
}
_LONGEST_CYCLE = 8
_LONGEST_MERGED = 16


@dataclass(frozen=True)
class _Row:
    """One thing that the channels of a pipette did together."""

    what: str
    line: int | None
    wells: tuple[WellRef, ...]

    @property
    def signature(self) -> Hashable:
        """Equal for rows that a loop repeats."""
        return (self.what, self.line, len(self.wells))


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


def trace_table(trace: Trace, limit: int = 6000) -> tuple[str, ...]:
    """The lines of the table.

    Args:
        trace: What happened.
        limit: About how many characters the table may have in all.
    """
    sessions = _sessions(trace)
    lines: list[str] = []
    room = limit
    for start, period, count in _cycles([s.signature for s in sessions]):
        block = sessions[start : start + period * count]
        line = _told(block, period, count)
        if len(line) > room:
            left = len(sessions) - start
            lines.append(f"(... {left} more tip sessions are left out: too many to show)")
            break
        room -= len(line) + 1
        lines.append(line)
    return tuple(lines)


def _sessions(trace: Trace) -> list[_Session]:
    found: list[_Session] = []
    latest: dict[tuple[int, int], _Session] = {}
    for visits in _together(trace.visits):
        key = (visits[0].tip.number, visits[0].session)
        session = latest.get(key)
        if session is None:
            tips = tuple(visit.tip.number for visit in visits)
            session = latest[key] = _Session(tips, visits[0].session > 1, [])
            found.append(session)
        elif len(visits) > len(session.tips):
            session.tips = tuple(visit.tip.number for visit in visits)
        _append(session.rows, visits)
    return found


def _together(visits: Sequence[Visit]) -> Iterable[list[Visit]]:
    group: list[Visit] = []
    for visit in visits:
        if group and visit.index != group[0].index:
            yield group
            group = []
        group.append(visit)
    if group:
        yield group


def _append(rows: list[_Row], visits: list[Visit]) -> None:
    first = visits[0]
    wells = tuple(dict.fromkeys(visit.well.ref for visit in visits))
    word = _WORDS.get(first.kind, first.kind.value)
    volume = f" {first.volume:.4g}" if first.volume else ""
    if first.mixing:
        # A mix is drawing and giving back, again and again: one row. How often is not told,
        # since the trace keeps a repeated mix once.
        row = _Row(f"mix{volume}", first.line, wells)
        if word != "give" and (not rows or rows[-1] != row):
            rows.append(row)
        return
    if word in ("give", "blow"):
        word += _mark(visits)
    rows.append(_Row(f"{word}{volume}", first.line, wells))


def _mark(visits: list[Visit]) -> str:
    if any(visit.touch for visit in visits):
        return ""
    if not any(visit.below for visit in visits):
        return "^"
    return "." if all(visit.empty_before for visit in visits) else "~"


def _told(block: Sequence[_Session], period: int, count: int) -> str:
    first = block[:period]
    if count == 1:
        return "; ".join(f"{_tips([s])}: {_rows(s.rows)}" for s in first)
    parts = []
    for place, session in enumerate(first):
        same = block[place::period]
        rows = [
            f"{_line(row)}{row.what} {places([w for s in same for w in s.rows[number].wells])}"
            for number, row in enumerate(session.rows)
        ]
        parts.append(f"{_tips(same)}: " + "; ".join(rows))
    if period == 1:
        return parts[0]
    return f"{count} times in turn [" + " | ".join(parts) + "]"


def _tips(sessions: Sequence[_Session]) -> str:
    numbers = [number + 1 for session in sessions for number in session.tips]
    run = numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    if len(numbers) == 1:
        text = f"tip {numbers[0]}"
    elif run:
        text = f"tips {numbers[0]}-{numbers[-1]}"
    else:
        shown = ",".join(map(str, numbers[:8])) + (",..." if len(numbers) > 8 else "")
        text = f"tips {shown}"
    if len(sessions[0].tips) > 1:
        text += f" ({len(sessions[0].tips)} channels at once)"
    if len(sessions) > 1:
        text += f", {len(sessions)} pick-ups one after the other"
    return text + (", USED BEFORE" if sessions[0].again else "")


def _rows(rows: Sequence[_Row]) -> str:
    parts = []
    for start, period, count in _cycles([row.signature for row in rows]):
        block = rows[start : start + period * count]
        inner = "; ".join(
            f"{_line(row)}{row.what} {places([w for r in block[place::period] for w in r.wells])}"
            for place, row in enumerate(block[:period])
        )
        parts.append(inner if count == 1 else f"{count}x ({inner})")
    return "; ".join(parts)


def _line(row: _Row) -> str:
    return f"L{row.line} " if row.line is not None else ""


def _cycles(signatures: Sequence[Hashable]) -> Iterable[tuple[int, int, int]]:
    """Cuts a sequence into repeated blocks: (start, length of the block, how often)."""
    at = 0
    while at < len(signatures):
        best = (1, 1)
        for period in range(1, min(_LONGEST_CYCLE, (len(signatures) - at) // 2) + 1):
            block = list(signatures[at : at + period])
            count = 1
            while list(signatures[at + count * period : at + (count + 1) * period]) == block:
                count += 1
            if count > 1 and period * count > best[0] * best[1]:
                best = (period, count)
        yield at, *best
        at += best[0] * best[1]


def places(wells: Sequence[WellRef]) -> str:
    """Wells in order, folded: ``2:A1-H1,3×A2``, ranges running down the columns."""
    if len(set(wells)) == 1:
        return wells[0].address
    parts: list[str] = []
    slot = ""
    at = 0
    while at < len(wells):
        first = wells[at]
        same = 1
        while at + same < len(wells) and wells[at + same] == first:
            same += 1
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
    """How many wells from the first on make a column, a row or whole columns."""
    best = 1
    for follows in (_below, _beside):
        length = 1
        while length < len(wells) and follows(wells[length - 1], wells[length]):
            length += 1
        best = max(best, length if length > 2 else 1)
    return max(best, _columns(wells))


def _columns(wells: Sequence[WellRef]) -> int:
    """How many wells make whole columns of one height, one after the other."""
    column = 1
    while column < len(wells) and _below(wells[column - 1], wells[column]):
        column += 1
    if column < 2:
        return 1
    (row, first_column), key = row_column(wells[0].name), wells[0].labware
    length = 0
    while length < len(wells):
        wanted = (row + length % column, first_column + length // column)
        if wells[length].labware != key or row_column(wells[length].name) != wanted:
            break
        length += 1
    length -= length % column
    return length if length > 2 else 1


def _step(down: int, along: int) -> Callable[[WellRef, WellRef], bool]:
    def follows(one: WellRef, other: WellRef) -> bool:
        (row, column), (row2, column2) = row_column(one.name), row_column(other.name)
        return one.labware == other.labware and (row2, column2) == (row + down, column + along)

    return follows


_below = _step(1, 0)
_beside = _step(0, 1)
