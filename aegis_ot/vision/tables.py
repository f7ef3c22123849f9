"""CSV tables read cell by cell, with every fault noted by row and column."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Collection, Sequence
from pathlib import Path

from ..vocabulary import from_csv_cell

_MOST_SHOWN = 200


class Problems:
    """Faults of a data set, in the order found."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, file: str, row: int | None, column: str | None, what: str) -> None:
        """Note one fault; ``row`` is the line of the file, the header being 1."""
        where = file
        if row is not None:
            where += f", row {row}"
        if column is not None:
            where += f", column {column}"
        self.lines.append(f"{where}: {what}")

    def __bool__(self) -> bool:
        return bool(self.lines)

    def text(self, root: Path) -> str:
        shown = self.lines[:_MOST_SHOWN]
        more = len(self.lines) - len(shown)
        head = f"{root}: {len(self.lines)} fault{'s' if len(self.lines) != 1 else ''}"
        tail = [f"... and {more} more"] if more else []
        return "\n  ".join([head, *shown, *tail])


class Note:
    """Notes faults of one row: ``note(column, what)``."""

    def __init__(self, problems: Problems, file: str, line: int) -> None:
        self._problems, self._file, self._line = problems, file, line

    def __call__(self, column: str, what: str) -> None:
        self._problems.add(self._file, self._line, column, what)


def read_table(
    path: Path, columns: Sequence[str], problems: Problems, optional: Collection[str] = ()
) -> list[tuple[int, dict[str, str]]]:
    """Rows as (line of the file, cells by column), cells stripped.

    Columns of ``optional`` may stand anywhere; where one does not, its cells are empty.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        problems.add(path.name, None, None, "is missing")
        return []
    except (OSError, UnicodeDecodeError) as error:
        problems.add(path.name, None, None, f"cannot be read as UTF-8 text ({error})")
        return []
    reader = csv.reader(io.StringIO(text, newline=""))
    rows: list[tuple[int, dict[str, str]]] = []
    header: list[str] | None = None
    try:
        for cells in reader:
            cells = [from_csv_cell(cell.strip()) for cell in cells]
            if header is None:
                header = cells
                needed = list(header)
                for column in optional:
                    if column in needed:
                        needed.remove(column)
                if not _check_header(path.name, needed, columns, problems):
                    return []
                continue
            if not any(cells):
                continue
            if len(cells) != len(header):
                problems.add(
                    path.name,
                    reader.line_num,
                    None,
                    f"has {len(cells)} cells, the header has {len(header)}",
                )
                continue
            row = dict.fromkeys(optional, "") | dict(zip(header, cells, strict=True))
            rows.append((reader.line_num, row))
    except csv.Error as error:
        problems.add(path.name, reader.line_num, None, f"is not readable as CSV ({error})")
    if header is None:
        problems.add(path.name, None, None, "is empty")
    return rows


def _check_header(
    file: str, header: Sequence[str], columns: Sequence[str], problems: Problems
) -> bool:
    if list(header) == list(columns):
        return True
    missing = [column for column in columns if column not in header]
    unknown = [column for column in header if column not in columns]
    for column in missing:
        problems.add(file, 1, column, "is missing from the header")
    for column in unknown:
        problems.add(file, 1, column or "(no name)", "is not a column of this table")
    if not missing and not unknown:
        problems.add(file, 1, None, f"columns must stand in the order {','.join(columns)}")
    return False


def number(cell: str, column: str, note: Note) -> float | None:
    """A finite number, or ``None`` with a note of what is wrong."""
    try:
        value = float(cell)
    except ValueError:
        note(column, f"{cell!r} is no number" if cell else "is empty")
        return None
    if not math.isfinite(value):
        note(column, f"{cell!r} is no finite number")
        return None
    return value
