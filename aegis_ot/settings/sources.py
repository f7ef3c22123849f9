"""Where settings come from: arguments over environment variables over a file over defaults.

:func:`load_settings` reads a file and the environment, so it is called inside ``run``, never at
import or decoration.
"""

from __future__ import annotations

import difflib
import importlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from .fields import NAMES, Settings
from .values import READERS, SettingPlace

PREFIX = "AEGIS_OT_"
FILE_VARIABLE = "AEGIS_OT_CONFIG"
_TYPO = 0.8


def load_settings(**keywords: Any) -> Settings:
    """Put the settings together.

    Args:
        **keywords: Fields of :class:`Settings`; each comes before the environment variable
            ``AEGIS_OT_<NAME>``, that before the file, that before the default.

    Raises:
        ConfigurationError: Naming the setting, where it came from and what is accepted.
    """
    values: dict[str, Any] = {}
    for origin, given in (_from_file(), _from_environment(), ("argument", keywords)):
        for name, value in given.items():
            where = f"{origin} {PREFIX}{name.upper()}" if origin == "environment" else origin
            if name not in NAMES:
                raise ConfigurationError(_unknown(name, where))
            values[name] = READERS[name](value, SettingPlace(name, where))
    return Settings(**values)


def _unknown(name: str, where: str) -> str:
    close = difflib.get_close_matches(name, NAMES, n=1, cutoff=0.6)
    hint = f"Did you mean {close[0]!r}?" if close else f"Settings are: {', '.join(NAMES)}."
    return f"There is no setting {name!r} ({where}). {hint}"


def _from_environment() -> tuple[str, dict[str, Any]]:
    given = {
        variable.removeprefix(PREFIX).lower(): value
        for variable, value in os.environ.items()
        if variable.startswith(PREFIX) and value.strip()
    }
    # Others have variables with this prefix too: what resembles no setting is theirs.
    return "environment", {
        name: value
        for name, value in given.items()
        if name in NAMES or difflib.get_close_matches(name, NAMES, n=1, cutoff=_TYPO)
    }


def _from_file() -> tuple[str, dict[str, Any]]:
    named = os.environ.get(FILE_VARIABLE, "").strip()
    if named:
        path = Path(os.path.expanduser(named))
        if not os.path.isfile(path):
            raise ConfigurationError(
                f"{FILE_VARIABLE} names {path}, and there is no such file. "
                "Correct the path, or unset the variable."
            )
    else:
        found = next((p for p in _default_paths() if os.path.isfile(p)), None)
        if found is None:
            return "file", {}
        path = found
    return f"file {path}", _read_file(path)


def _default_paths() -> Sequence[Path]:
    try:
        folder = Path.home() / ".config" / "aegis-ot"
    except RuntimeError:  # no home directory, as under some service managers
        return ()
    return (folder / "guard.toml", folder / "guard.json")


def _read_file(path: Path) -> dict[str, Any]:
    try:
        text = path.read_text(encoding="utf-8-sig")  # Windows editors put a mark in front
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(
            f"The settings file {path} cannot be read ({error}). Make it a readable UTF-8 file."
        ) from error
    try:
        if path.suffix == ".toml":
            return dict(_toml()(text))
        content = json.loads(text)
    except ImportError as error:
        raise ConfigurationError(
            f"The settings file {path} is TOML, which this Python cannot read (3.11 and newer "
            "can). Write the same settings as JSON, in a file that ends in .json."
        ) from error
    except ValueError as error:
        raise ConfigurationError(
            f"The settings file {path}, read as {'TOML' if path.suffix == '.toml' else 'JSON'}, "
            f"cannot be understood: {error}. Correct it there."
        ) from error
    if not isinstance(content, dict):
        raise ConfigurationError(
            f"The settings file {path} must hold one object of settings, "
            f"not a {type(content).__name__}."
        )
    return content


def _toml() -> Callable[[str], Mapping[str, Any]]:
    # Not in Python 3.10, which is what an OT-2 has.
    loads: Callable[[str], Mapping[str, Any]] = importlib.import_module("tomllib").loads
    return loads
