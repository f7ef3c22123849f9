"""Loads the rules in force: the shipped families, compiled, and a user's own files."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...errors import RuleError
from ..rules import READABLE, SCHEMA_VERSION, Common, Family, parse_json, read_dataclass
from .rule_set import RuleSet


def shipped_rules() -> Path:
    """Where the shipped rule files stand: inside the wheel, or beside the package in a checkout.

    A robot has none: what judges is compiled from them.
    """
    package = Path(__file__).resolve().parents[2]
    folder = package / "rules"
    return folder if folder.is_dir() else package.parent / "rules"


def load_rules(extra: Sequence[str | Path] = ()) -> RuleSet:
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
    return RuleSet(tuple(families), shipped.common)


@functools.cache
def _shipped() -> RuleSet:
    """Made once: a robot server analyses many protocols in one process.

    What stands in them was held against what exists when they were written: by the tests.
    """
    from .shipped import COMMON, FAMILIES

    folder = shipped_rules()
    return RuleSet(
        tuple(dataclasses.replace(f, path=str(folder / f"{f.family}.json")) for f in FAMILIES),
        COMMON,
    )


def read_shipped() -> RuleSet:
    """The shipped families as their files say now: what ``scripts.compile_rules`` compiles.

    Raises:
        RuleError: With file, rule and field.
    """
    folder = shipped_rules()
    common = read_dataclass(Common, _json(folder / "common.json"), "common.json")
    return RuleSet(tuple(map(_read, _family_files(folder))), common)


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
