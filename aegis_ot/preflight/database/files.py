"""Loads the rule database: one JSON file per assay family, the shipped ones and a user's own."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...errors import RuleError
from ..rules import READABLE, SCHEMA_VERSION, Common, Database, Family, parse_json, read_dataclass


def shipped_rules() -> Path:
    """The folder of the rule database: inside the wheel, or beside the package in a checkout."""
    package = Path(__file__).resolve().parents[2]
    for folder in (package / "rules", package.parent / "rules"):
        if (folder / "common.json").is_file():
            return folder
    raise RuleError(f"the rule database is missing: no rules/common.json beside {package}")


def load_database(extra: Sequence[str | Path] = ()) -> Database:
    """Load the shipped families and any of the user's own.

    Args:
        extra: Files or folders of further families. A family or rule that exists already is
            refused, so that nothing is shadowed by accident; and a folder without any, so that
            nobody believes that rules hold which are elsewhere.

    Raises:
        RuleError: With file, rule and field.
    """
    shipped = _shipped()
    files: list[Path] = []
    for given in extra:
        path = Path(given)
        if path.is_dir():
            found = _family_files(path)
            if not found:
                raise RuleError(f"{path}: there is no rule file (*.json) in this folder")
            files.extend(found)
        elif path.is_file():
            files.append(path)
        else:
            raise RuleError(f"{path}: no such file or folder of rules")
    if not files:
        return shipped
    from .validation import check_together

    families = [*shipped.families, *map(load_family, files)]
    check_together(families)
    return Database(tuple(families), shipped.common)


@functools.cache
def _shipped() -> Database:
    """Read once: a robot server analyses many protocols in one process.

    What stands in them was held against what exists when they were written: by the tests.
    """
    folder = shipped_rules()
    common = read_dataclass(Common, _json(folder / "common.json"), "common.json")
    return Database(tuple(map(_read, _family_files(folder))), common)


def _family_files(folder: Path) -> list[Path]:
    found = sorted(folder.glob("*.json"))
    return [p for p in found if p.name != "common.json" and not p.name.endswith("schema.json")]


def load_family(path: Path) -> Family:
    """Read and validate one family file.

    Raises:
        RuleError: With file, rule and field.
    """
    from .validation import check_family

    family = _read(path)
    check_family(family, path.name)
    return family


def _read(path: Path) -> Family:
    data = _json(path)
    if isinstance(data, dict):
        data.pop("$schema", None)
    family = read_dataclass(Family, data, path.name)
    if family.schema not in READABLE:
        raise RuleError(f"{path.name}: schema: expected {SCHEMA_VERSION}, found {family.schema}")
    return dataclasses.replace(family, path=str(path))


def _json(path: Path) -> Any:
    try:
        return parse_json(path.read_bytes())
    except OSError as error:
        raise RuleError(f"{path.name}: cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise RuleError(f"{path.name}: is not JSON: {error}") from error
