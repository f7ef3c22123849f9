"""The baseline file: findings that a project knows of and has put off.

A finding is recognised by its file, its rule, the text of the lines concerned and the wells, so
that it stays known when lines move. It is counted: a second one like it is new.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from ..vocabulary import Finding
from .result import CheckedProtocol

_SCHEMA = 1

Key = tuple[str, str, tuple[str, ...], tuple[str, ...]]


class Baseline:
    """Known findings.

    Args:
        path: Of the baseline file; files are named relative to its folder.
        known: How often each is known.

    Attributes:
        path: Of the file.
    """

    def __init__(self, path: Path, known: Counter[Key]) -> None:
        self.path = path.resolve()
        self._folder = self.path.parent
        self._known = known

    def split(
        self, file: str, findings: Sequence[Finding], lines: Sequence[str]
    ) -> tuple[list[Finding], list[Finding], int]:
        """New findings, known ones, and how many known ones no longer occur in this file."""
        name = _relative(file, self._folder)
        left = Counter({key: n for key, n in self._known.items() if key[0] == name})
        fresh, known = [], []
        for finding in findings:
            key = _key(name, finding, lines)
            if left[key] > 0:
                left[key] -= 1
                known.append(finding)
            else:
                fresh.append(finding)
        return fresh, known, sum(left.values())


def read_baseline(path: Path) -> Baseline:
    """Read a baseline file.

    Raises:
        ConfigurationError: It is missing or no baseline file.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigurationError(
            f"The baseline {path} cannot be read: {error.strerror}. "
            "Write one with --write-baseline."
        ) from None
    except ValueError as error:
        raise ConfigurationError(f"The baseline {path} is not JSON: {error}.") from None
    try:
        if data["schema"] != _SCHEMA:
            raise ConfigurationError(f"The baseline {path} is of another version; write it anew.")
        known = Counter(
            (
                str(item["file"]),
                str(item["rule"]),
                tuple(str(text) for text in item["code"]),
                tuple(str(well) for well in item["wells"]),
            )
            for item in data["findings"]
        )
    except (KeyError, TypeError):
        raise ConfigurationError(f"{path} is no baseline file of aegis-ot.") from None
    return Baseline(path, known)


def baseline_text(path: Path, protocols: Iterable[CheckedProtocol]) -> str:
    """A baseline file that knows all these findings.

    Args:
        path: Where it will stand; files are named relative to its folder.
        protocols: Checked without a baseline.
    """
    folder = path.resolve().parent
    entries: list[dict[str, Any]] = []
    for checked in protocols:
        name = _relative(checked.file, folder)
        for finding in checked.findings:
            _, rule, code, wells = _key(name, finding, checked.lines)
            entries.append({"file": name, "rule": rule, "code": code, "wells": wells})
    return json.dumps({"schema": _SCHEMA, "findings": entries}, indent=1, ensure_ascii=False) + "\n"


def _key(name: str, finding: Finding, lines: Sequence[str]) -> Key:
    code = tuple(
        " ".join(lines[line - 1].split()) for line in finding.lines if 0 < line <= len(lines)
    )
    return name, finding.rule, code, tuple(sorted(well.address for well in finding.wells))


def _relative(file: str, folder: Path) -> str:
    path = Path(file).resolve()
    try:
        return path.relative_to(folder).as_posix()
    except ValueError:
        pass
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:  # another drive
        return path.as_posix()
