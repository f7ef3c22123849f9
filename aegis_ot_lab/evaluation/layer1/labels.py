"""Reads ``labels.json`` of a protocol benchmark: a list with one object per protocol.

::

    {"file": "b13.py", "family": "pcr", "verdict": "fail", "rules": ["PCR-1"],
     "also_acceptable": ["PCR-6"], "wells": {"PCR-1": ["4:H12"]}, "lines": {"PCR-1": [41]},
     "note": "one sentence"}

``file``, ``family`` and ``verdict`` must be there. An entry with an ``adjusted_verdict`` is
scored by both; the rules that it lists are acceptable under either.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aegis_ot.errors import DatasetError

LABELS = "labels.json"

_SHOWN = 6


@dataclass(frozen=True)
class Label:
    """What is known about one protocol.

    Attributes:
        file: File name within the folder.
        family: Assay family.
        is_bad: The strict label: whether it should be flagged.
        is_bad_adjusted: The same after adjustment; equal to the strict one where none is given.
        rules: Violated rules.
        also_acceptable: Rules that a careful reader could also cite.
        wells: Wells concerned, by rule, as ``slot:well`` or ``label:well``.
        lines: Source lines concerned, by rule.
        note: One sentence.
    """

    file: str
    family: str
    is_bad: bool
    is_bad_adjusted: bool
    rules: tuple[str, ...] = ()
    also_acceptable: tuple[str, ...] = ()
    wells: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    lines: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    note: str = ""

    @property
    def acceptable(self) -> frozenset[str]:
        """Rules whose findings are not false here, whatever the strict verdict says."""
        return frozenset((*self.rules, *self.also_acceptable))


def read_labels(folder: Path, families: Collection[str], rules: Collection[str]) -> list[Label]:
    """Read and check the labels of a folder, reporting everything that is wrong at once.

    Args:
        folder: Holds the protocols and ``labels.json``.
        families: Families that exist.
        rules: Rules that exist.

    Raises:
        DatasetError: The folder, the file or an entry is no good.
    """
    if not folder.is_dir():
        raise DatasetError(f"{folder}: there is no such folder.")
    path = folder / LABELS
    try:
        data = json.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise DatasetError(f"{folder}: the folder holds no {LABELS}.") from None
    except OSError as error:
        raise DatasetError(f"{path}: cannot be read: {error.strerror}.") from None
    except ValueError as error:
        raise DatasetError(f"{path}: is not JSON: {error}.") from None
    if not isinstance(data, list):
        raise DatasetError(f"{path}: expected a list of objects, one per protocol.")
    if not data:
        raise DatasetError(f"{path}: the list is empty.")
    reader = _LabelReader(folder, families, rules)
    labels = [reader.label(number, item) for number, item in enumerate(data, start=1)]
    if reader.wrong:
        shown = "; ".join(reader.wrong[:_SHOWN])
        more = len(reader.wrong) - _SHOWN
        raise DatasetError(f"{path}: {shown}{f'; and {more} more' if more > 0 else ''}.")
    return labels


class _LabelReader:
    def __init__(self, folder: Path, families: Collection[str], rules: Collection[str]) -> None:
        self._folder = folder
        self._families = families
        self._rules = rules
        self._seen: set[str] = set()
        self.wrong: list[str] = []

    def label(self, number: int, item: Any) -> Label:
        if not isinstance(item, Mapping):
            self.wrong.append(f"entry {number} is no object")
            return Label("", "", False, False)
        file = item.get("file")
        place = f"entry {number} ({file})" if isinstance(file, str) else f"entry {number}"
        if not isinstance(file, str) or not file:
            self.wrong.append(f"{place}: names no file")
            file = ""
        elif file in self._seen:
            self.wrong.append(f"{place}: is labelled twice")
        elif not (self._folder / file).is_file():
            self.wrong.append(f"{place}: there is no such file")
        self._seen.add(file)
        is_bad = self._verdict(item, "verdict", place)
        adjusted = item.get("adjusted_verdict")
        return Label(
            file=file,
            family=self._one_of(item.get("family"), self._families, "family", place),
            is_bad=is_bad,
            is_bad_adjusted=is_bad
            if adjusted is None
            else self._verdict(item, "adjusted_verdict", place),
            rules=self._rule_list(item, "rules", place),
            also_acceptable=self._rule_list(item, "also_acceptable", place),
            wells=self._by_rule(item, "wells", str, place),
            lines=self._by_rule(item, "lines", int, place),
            note=str(item.get("note") or ""),
        )

    def _verdict(self, item: Mapping[str, Any], key: str, place: str) -> bool:
        return self._one_of(item.get(key), ("pass", "fail"), key, place) == "fail"

    def _one_of(self, value: Any, accepted: Collection[str], key: str, place: str) -> str:
        if not isinstance(value, str) or value not in accepted:
            self.wrong.append(f"{place}: {key} is {value!r}, not one of {', '.join(accepted)}")
            return ""
        return value

    def _rule_list(self, item: Mapping[str, Any], key: str, place: str) -> tuple[str, ...]:
        value = item.get(key) or []
        if not isinstance(value, list):
            self.wrong.append(f"{place}: {key} is no list")
            return ()
        for rule in value:
            if rule not in self._rules:
                self.wrong.append(f"{place}: {key}: there is no rule {rule!r}")
        return tuple(str(rule) for rule in value)

    def _by_rule(
        self, item: Mapping[str, Any], key: str, kind: type, place: str
    ) -> dict[str, tuple[Any, ...]]:
        value = item.get(key) or {}
        if not isinstance(value, Mapping):
            self.wrong.append(f"{place}: {key} is no object of lists by rule")
            return {}
        checked = {}
        for rule, entries in value.items():
            if not isinstance(entries, list) or not all(type(e) is kind for e in entries):
                self.wrong.append(f"{place}: {key}.{rule}: expected a list of {key}")
                continue
            checked[str(rule)] = tuple(entries)
        return checked
