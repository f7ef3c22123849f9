"""What came of a corpus: a table with one row a protocol, its findings beside it.

The table is CSV; the findings (and undecided rules with their reasons) are JSON lines in the file
beside it. Both grow protocol by protocol, so that an interrupted run loses nothing that was done.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import json
import os
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from ..errors import ConfigurationError
from ..vocabulary import csv_cell, from_csv_cell

SCHEMA = "2"

SKIPPED, CRASHED = "skipped", "crash"
"""Verdicts beside those of a report: there was no use in trying, and aegis-ot itself failed."""


@dataclass(frozen=True)
class CorpusRow:
    """One protocol.

    Attributes:
        file: Its path, with forward slashes.
        verdict: ``pass``, ``warn``, ``fail``, ``error`` (it cannot be rehearsed), ``skipped``
            or ``crash``.
        family: The likeliest assay family.
        rules: Broken rules, each with its severity and count: ``PCR-2:error*3 GEN-3:warning*1``.
        findings: How many.
        undecided: Undecided rules, with blanks between.
        decided: Rules that were judged to the end.
        not_applicable: Rules of other assays, and those that nothing in it concerns.
        rehearsal_s: Time of the rehearsal, s.
        verdict_s: Time from the recording to the verdict, s.
        reason: Why it was not judged.
        line: The source line of that, if known.
        modules: Files of its repository that were imported, for the rehearsal only.
        schema: Version of this table's columns.
        key: Changes with the protocol, what lies around it, and what judges it.
    """

    file: str
    verdict: str
    family: str = ""
    rules: str = ""
    findings: int = 0
    undecided: str = ""
    decided: str = ""
    not_applicable: str = ""
    rehearsal_s: float = 0.0
    verdict_s: float = 0.0
    reason: str = ""
    line: str = ""
    modules: str = ""
    schema: str = SCHEMA
    key: str = ""


@dataclass(frozen=True)
class Told:
    """One finding of a protocol, or one rule that it leaves undecided.

    Attributes:
        file: The protocol, as in its row.
        rule: Rule identifier.
        severity: ``error``, ``warning`` or ``undecided``.
        wells: ``slot:well``.
        lines: Source lines.
        message: The finding's sentence, or the reason why it is undecided.
        fix: How to mend it.
    """

    file: str
    rule: str
    severity: str
    wells: tuple[str, ...]
    lines: tuple[int, ...]
    message: str
    fix: str = ""


Results = dict[str, tuple[CorpusRow, tuple[Told, ...]]]
"""Rows with their findings, by file."""

_COLUMNS = [f.name for f in dataclasses.fields(CorpusRow)]
_LATER = {"decided": "", "not_applicable": "", "modules": "", "schema": "1"}
"""Columns that the first version had not, and what they say of its rows."""
_NUMBERS = {f.name: float for f in dataclasses.fields(CorpusRow) if f.name.endswith("_s")}


def findings_path(table: Path) -> Path:
    """Where the findings of a table lie: ``results.csv``, ``results.findings.jsonl``."""
    return table.with_name(f"{table.stem}.findings.jsonl")


def summary_path(table: Path) -> Path:
    """Where the summary of a table lies: ``results.csv``, ``results.summary.json``."""
    return table.with_name(f"{table.stem}.summary.json")


def write_summary(table: Path, rows: Sequence[CorpusRow]) -> None:
    """Write what came of these protocols together, beside their table.

    Raises:
        ConfigurationError: It cannot be written.
    """
    broken = Counter(part.partition("*")[0] for row in rows for part in row.rules.split())
    states = {
        word: Counter(rule for row in rows for rule in getattr(row, word).split())
        for word in ("decided", "undecided", "not_applicable")
    }
    data = {
        "schema_version": SCHEMA,
        "protocols": len(rows),
        "verdicts": Counter(row.verdict for row in rows),
        "findings": sum(row.findings for row in rows),
        "protocols_by_broken_rule": broken,
        "protocols_by_rule": states,
    }
    path = summary_path(table)
    try:
        path.write_text(json.dumps(data, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None


def read_results(table: Path) -> Results:
    """Read a table and the findings beside it, if they are there.

    A row that an interruption left half written is left out.

    Raises:
        ConfigurationError: It cannot be read, or is no table of a corpus.
    """
    rows: dict[str, CorpusRow] = {}
    try:
        with table.open(encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            names = [*(reader.fieldnames or _COLUMNS)]
            if names not in (_COLUMNS, [name for name in _COLUMNS if name not in _LATER]):
                told = "is no table that aegis-ot corpus of this version wrote; give another file."
                raise ConfigurationError(f"{table} {told}")
            for values in reader:
                values = {**({} if "schema" in names else _LATER), **values}
                if all(values.get(name) is not None for name in _COLUMNS):
                    row = _row({name: from_csv_cell(values[name]) for name in _COLUMNS})
                    rows[row.file] = row
        told_by_file = _read_findings(findings_path(table))
    except OSError as error:
        raise ConfigurationError(f"{table} cannot be read: {error.strerror}.") from None
    except (csv.Error, UnicodeDecodeError, ValueError, TypeError, KeyError) as error:
        raise ConfigurationError(f"{table} or its findings are damaged: {error}.") from None
    return {file: (row, tuple(told_by_file.get(file, ()))) for file, row in rows.items()}


def _row(values: dict[str, str]) -> CorpusRow:
    numbers = {name: kind(values[name]) for name, kind in _NUMBERS.items()}
    return CorpusRow(**{**values, **numbers, "findings": int(values["findings"])})  # type: ignore[arg-type]


def _read_findings(path: Path) -> dict[str, list[Told]]:
    told: dict[str, list[Told]] = {}
    if not path.is_file():
        return told
    with path.open(encoding="utf-8") as file:
        for line in file:
            if not line.endswith("\n"):  # half written
                continue
            data: dict[str, Any] = json.loads(line)
            data["wells"], data["lines"] = tuple(data["wells"]), tuple(data["lines"])
            told.setdefault(data["file"], []).append(Told(**data))
    return told


class CorpusTable:
    """Appends to a table and its findings. A context manager.

    Raises:
        ConfigurationError: It cannot be written.
    """

    def __init__(self, path: Path, kept: Iterable[tuple[CorpusRow, Sequence[Told]]]) -> None:
        head = io.StringIO()
        csv.writer(head, lineterminator="\n").writerow(_COLUMNS)
        rows, told = [head.getvalue()], []
        for row, findings in kept:
            rows.append(_row_text(row))
            told.append(_findings_text(findings))
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._rows = _written_anew(path, "".join(rows))
            self._told = _written_anew(findings_path(path), "".join(told))
        except OSError as error:
            raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None

    def __enter__(self) -> CorpusTable:
        return self

    def __exit__(self, *_: object) -> None:
        self._rows.close()
        self._told.close()

    def append(self, row: CorpusRow, findings: Sequence[Told]) -> None:
        """Write one protocol: the findings first, so that a row is never without them."""
        for file, text in ((self._told, _findings_text(findings)), (self._rows, _row_text(row))):
            file.write(text)
            file.flush()


def _written_anew(path: Path, text: str) -> IO[str]:
    """Replace a file at one go, and open it to be added to."""
    fresh = path.with_name(f"{path.name}.part")
    fresh.write_text(text, encoding="utf-8", errors="backslashreplace", newline="")
    os.replace(fresh, path)
    return path.open("a", encoding="utf-8", errors="backslashreplace", newline="")


def _row_text(row: CorpusRow) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(map(csv_cell, dataclasses.astuple(row)))
    return text.getvalue()


def _findings_text(findings: Sequence[Told]) -> str:
    return "".join(json.dumps(dataclasses.asdict(told)) + "\n" for told in findings)
