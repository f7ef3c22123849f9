"""``[tool.aegis-ot]`` of ``pyproject.toml``: how a project wants its protocols checked.

::

    [tool.aegis-ot]
    assay = "pcr"                       # or a list; left out: inferred
    select = ["PCR-1", "PCR-2"]         # left out: all
    ignore = ["GEN-3"]
    rules = ["our-rules"]               # files or folders of further rules
    labware = ["labware"]
    baseline = "aegis-baseline.json"
    timeout = 120
    strict = true                       # warnings are errors; left out: they are warnings
    model = "openai:MODEL"              # or AEGIS_OT_MODEL; left out: no model is asked

    [tool.aegis-ot.severity]
    PCR-6 = "error"                     # error, warning or off

    [[tool.aegis-ot.waivers]]
    rules = ["SD-5"]
    files = ["tutorials/*.py"]          # left out: every file
    reason = "One tip per series is how we teach it."

Paths are relative to the file. Whatever is given on the command line wins. The nearest file above
a protocol holds for it, so one call may go by several: :func:`configurations_of`.
"""

from __future__ import annotations

import functools
import importlib
import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError

TABLE = "tool.aegis-ot"
FILE = "pyproject.toml"


@dataclass(frozen=True)
class ConfiguredWaiver:
    """Rules that are not held against some files.

    Attributes:
        rules: Rule identifiers.
        reason: Why.
        files: Patterns of paths relative to the configuration file; empty for all.
    """

    rules: tuple[str, ...]
    reason: str
    files: tuple[str, ...] = ()


@dataclass(frozen=True)
class Configuration:
    """The table, read and checked; see the module's own text for the keys.

    ``name`` is the file's as seen from the working folder, for messages; ``""`` if there is none.
    """

    assay: tuple[str, ...] = ()
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()
    labware: tuple[str, ...] = ()
    baseline: str | None = None
    timeout: float | None = None
    strict: bool = False
    model: str | None = None
    severity: Mapping[str, str] = field(default_factory=dict)
    waivers: tuple[ConfiguredWaiver, ...] = ()
    folder: Path = field(default_factory=Path)
    name: str = ""


def configurations_of(
    files: Sequence[Path], working_folder: Path
) -> list[tuple[Configuration, list[Path]]]:
    """Each configuration with the protocols that it holds for, in the order of their first.

    It is the nearest one at or above the protocol's own folder, as with other tools that check
    code; where there is none, that of the working folder.

    Raises:
        ConfigurationError: One of them is no TOML, or a key is unknown or of the wrong kind.
    """
    nearest = functools.cache(find_configuration)
    found: dict[str, tuple[Configuration, list[Path]]] = {}
    for file in files:
        configured = nearest(file.parent.resolve())
        if not configured.name:
            configured = nearest(working_folder)
        found.setdefault(configured.name, (configured, []))[1].append(file)
    return list(found.values())


def find_configuration(start: Path) -> Configuration:
    """The table of the nearest ``pyproject.toml`` that has one, from ``start`` upwards.

    Raises:
        ConfigurationError: It is no TOML, or a key is unknown or of the wrong kind.
    """
    start = start.resolve()
    for folder in (start, *start.parents):
        path = folder / FILE
        if path.is_file():
            table = _table(path)
            if table is not None:
                return read_configuration(table, folder, shown(path))
    return Configuration()


def shown(path: Path) -> str:
    """A path as seen from the working folder, where that is shorter."""
    try:
        return min(os.path.relpath(path), str(path), key=len)
    except ValueError:  # another drive
        return str(path)


def _table(path: Path) -> Any:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"{path} cannot be read: {error}") from None
    if "aegis-ot" not in text:
        return None
    try:
        toml = importlib.import_module("tomllib")
    except ModuleNotFoundError:
        try:
            toml = importlib.import_module("tomli")
        except ModuleNotFoundError:
            if f"[{TABLE}" not in text:  # named as a dependency, most likely
                return None
            raise ConfigurationError(
                f"{path} has [{TABLE}], but this Python cannot read TOML. Use Python 3.11 or "
                "newer, or install tomli."
            ) from None
    try:
        data = toml.loads(text)
    except ValueError as error:
        raise ConfigurationError(f"{path} is not TOML: {error}") from None
    return data.get("tool", {}).get("aegis-ot")


_EXPECTED: Mapping[str, tuple[Callable[[Any], bool], str]] = {
    "timeout": (lambda value: type(value) in (int, float), "a number of seconds"),
    "severity": (lambda value: isinstance(value, Mapping), "a table of rules"),
    "strict": (lambda value: isinstance(value, bool), "true or false"),
    "baseline": (lambda value: isinstance(value, str), "a path"),
    "model": (lambda value: isinstance(value, str) and bool(value.strip()), "a model's name"),
}
"""Keys that hold one thing: whether a value is of its kind, and the kind in words."""

_KEYS = {*_EXPECTED, "assay", "select", "ignore", "rules", "labware", "waivers"}


def read_configuration(table: Any, folder: Path, name: str) -> Configuration:
    """Check a parsed table.

    Args:
        table: The table.
        folder: Of the file.
        name: Of the file, for messages.

    Raises:
        ConfigurationError: A key is unknown or of the wrong kind, with its name.
    """
    reader = _ConfigurationReader(name)
    if not isinstance(table, Mapping):
        raise ConfigurationError(f"{name}: [{TABLE}] must be a table.")
    for key in table:
        if key not in _KEYS:
            raise ConfigurationError(
                f"{name}: [{TABLE}] has no key {key!r}; known are {', '.join(sorted(_KEYS))}."
            )
    for key, (fits, words) in _EXPECTED.items():
        if key in table and not fits(table[key]):
            raise ConfigurationError(f"{name}: {TABLE}.{key}: expected {words}.")
    timeout, baseline = table.get("timeout"), table.get("baseline")
    if timeout is not None and timeout <= 0:
        raise ConfigurationError(f"{name}: {TABLE}.timeout: must be greater than 0.")
    severity = table.get("severity", {})
    for rule, value in severity.items():
        if value not in ("error", "warning", "off"):
            raise ConfigurationError(
                f"{name}: {TABLE}.severity.{rule}: expected error, warning or off, found {value!r}."
            )
    return Configuration(
        assay=reader.texts(table, "assay"),
        select=reader.rules(table, "select"),
        ignore=reader.rules(table, "ignore"),
        rules=tuple(str(folder / item) for item in reader.texts(table, "rules")),
        labware=tuple(str(folder / item) for item in reader.texts(table, "labware")),
        baseline=None if baseline is None else str(folder / baseline),
        timeout=None if timeout is None else float(timeout),
        strict=table.get("strict", False),
        model=table.get("model"),
        severity={str(rule).upper(): value for rule, value in severity.items()},
        waivers=reader.waivers(table.get("waivers", [])),
        folder=folder,
        name=name,
    )


class _ConfigurationReader:
    def __init__(self, name: str) -> None:
        self._name = name

    def texts(self, table: Mapping[str, Any], key: str, place: str = TABLE) -> tuple[str, ...]:
        value = table.get(key, ())
        if isinstance(value, str):
            return (value,)
        if not isinstance(value, (list, tuple)) or not all(isinstance(v, str) for v in value):
            raise ConfigurationError(f"{self._name}: {place}.{key}: expected a list of texts.")
        return tuple(value)

    def rules(self, table: Mapping[str, Any], key: str, place: str = TABLE) -> tuple[str, ...]:
        return tuple(rule.upper() for rule in self.texts(table, key, place))

    def waivers(self, items: Any) -> tuple[ConfiguredWaiver, ...]:
        if not isinstance(items, Sequence) or isinstance(items, str):
            raise ConfigurationError(
                f"{self._name}: {TABLE}.waivers: write each as [[{TABLE}.waivers]]."
            )
        waivers = []
        for number, item in enumerate(items, start=1):
            place = f"{TABLE}.waivers {number}"
            if not isinstance(item, Mapping) or set(item) - {"rules", "rule", "files", "reason"}:
                raise ConfigurationError(
                    f"{self._name}: {place}: expected rules, files and reason."
                )
            rules = self.rules(item, "rules", place) or self.rules(item, "rule", place)
            reason = item.get("reason")
            if not rules:
                raise ConfigurationError(f"{self._name}: {place}: names no rules.")
            if not isinstance(reason, str) or not re.search(r"\w", reason):
                raise ConfigurationError(
                    f"{self._name}: {place}: gives no reason for waiving {', '.join(rules)}."
                )
            waivers.append(
                ConfiguredWaiver(rules, reason.strip(), self.texts(item, "files", place))
            )
        return tuple(waivers)
