"""Reads what the user names on the command line: protocols, labware, values."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError, RehearsalError

NO_GUARD = (
    "aegis-ot check judges it (Protocol Designer's, or an analysis). What is run with the guard "
    "is a Python protocol; today's Protocol Designer exports one."
)
_BINARY = "is a binary file, not a Python protocol."
_CONTROL = re.compile(rb"[\x00-\x06\x0e-\x1a\x1c-\x1f]")
"""Bytes that no text has, in whatever encoding."""


def read_protocol(path: Path) -> str:
    """The text of a protocol file.

    Raises:
        ConfigurationError: It cannot be a Python protocol; the message does not name the file.
        RehearsalError: Likewise, with the line.
    """
    if path.is_dir():
        raise ConfigurationError(f"is a folder; name the protocols in it: {path}/*.py")
    if path.suffix.lower() == ".json":
        raise ConfigurationError(f"is a JSON file: {NO_GUARD}")
    if path.suffix.lower() == ".zip":
        raise ConfigurationError("is a bundle; unpack it and check the protocol inside.")
    try:
        if path.exists() and not path.is_file():  # reading a pipe or a device may never end
            raise ConfigurationError("is no regular file (but a pipe, a socket or a device).")
        data = path.read_bytes()
    except FileNotFoundError:
        raise ConfigurationError("there is no such file.") from None
    except OSError as error:
        raise ConfigurationError(f"cannot be read: {error.strerror}.") from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if _CONTROL.search(data):
            raise ConfigurationError(_BINARY) from None
        line = data.count(b"\n", 0, error.start) + 1
        raise RehearsalError("is not UTF-8 text, as Opentrons demands.", line) from None
    return as_protocol(text)


def as_protocol(text: str) -> str:
    """The same text, if it can be a Python protocol.

    Raises:
        ConfigurationError: It cannot; the message does not name the file.
    """
    if "\0" in text:
        raise ConfigurationError(_BINARY)
    if not text.strip():
        raise ConfigurationError("is empty.")
    if text.lstrip().startswith("{") and _is_json(text):
        raise ConfigurationError(f"holds JSON and is not named .json; {NO_GUARD}")
    return text


def _is_json(text: str) -> bool:
    try:
        json.loads(text)
    except ValueError:
        return False
    return True


def read_values(items: Sequence[str]) -> dict[str, Any]:
    """Runtime parameters as ``NAME=VALUE``; a value is JSON where it is JSON, else text.

    Python's ``True`` and ``False`` are taken as well.

    Raises:
        ConfigurationError: One has no name or no ``=``, or a name comes twice.
    """
    values: dict[str, Any] = {}
    for name, value in _pairs("--parameter", "NAME=VALUE", items):
        try:
            values[name] = (
                {"True": True, "False": False}.get(value)
                if value in ("True", "False")
                else json.loads(value)
            )
        except ValueError:
            values[name] = value
    return values


def read_csv_paths(items: Sequence[str]) -> dict[str, Path]:
    """Files for CSV runtime parameters, as ``NAME=PATH``.

    Raises:
        ConfigurationError: One is not written so, or there is no such file.
    """
    paths = {}
    for name, value in _pairs("--csv", "NAME=PATH", items):
        path = Path(value)
        if not path.is_file():
            raise ConfigurationError(f"--csv {name}: there is no file {value}.")
        paths[name] = path.resolve()  # a rehearsal runs in its protocol's folder
    return paths


def _pairs(option: str, shape: str, items: Sequence[str]) -> list[tuple[str, str]]:
    pairs = []
    for item in items:
        name, equals, value = item.partition("=")
        if not equals or not name.strip():
            raise ConfigurationError(f"{option} {item!r}: write it as {shape}.")
        pairs.append((name.strip(), value))
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise ConfigurationError(f"{option} {name}: given twice.")
    return pairs


def read_labware(places: Sequence[Path]) -> dict[str, Mapping[str, Any]]:
    """Custom labware definitions, by URI.

    Args:
        places: Files, or folders that are searched for ``*.json``; what is no labware there is
            passed over.

    Raises:
        ConfigurationError: There is none, or a file that is named is no labware definition.
    """
    found: dict[str, Mapping[str, Any]] = {}
    for place in places:
        here: dict[str, Mapping[str, Any]] = {}
        for file in labware_files([place]):
            try:
                definition = json.loads(file.read_text(encoding="utf-8-sig"))
                name = definition["parameters"]["loadName"]
                here[f"{definition['namespace']}/{name}/{definition['version']}"] = definition
            except OSError as error:
                raise ConfigurationError(f"--labware {file}: {error.strerror}.") from None
            except (ValueError, KeyError, TypeError):
                if file != place:  # of a folder, what is none is passed over
                    continue
                raise ConfigurationError(
                    f"--labware {file}: this is no Opentrons labware definition."
                ) from None
        if not here:
            raise ConfigurationError(
                f"--labware {place}: no *.json in the folder is an Opentrons labware definition."
            )
        found.update(here)
    return found


def labware_files(places: Sequence[Path]) -> list[Path]:
    """The files of custom labware in ``places``: files, or folders searched for ``*.json``.

    Hidden files are left out: macOS puts ``._NAME.json`` beside each file of an archive.

    Raises:
        ConfigurationError: A folder holds none.
    """
    found: list[Path] = []
    for place in places:
        files = [place]
        if place.is_dir():
            files = sorted(file for file in place.rglob("*.json") if not file.name.startswith("."))
        if not files:
            raise ConfigurationError(f"--labware {place}: the folder holds no *.json.")
        found += files
    return found
