"""Settings in a JSON or TOML file."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError


def read_settings_file(path: Path) -> dict[str, Any]:
    """What a JSON or TOML file (by its suffix) holds.

    Raises:
        ConfigurationError: It cannot be read, or holds something else.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Cannot read the settings file {path}: {error}") from error
    try:
        data = _parse_toml(text) if path.suffix == ".toml" else json.loads(text)
    except ValueError as error:
        raise ConfigurationError(f"The settings file {path} is damaged: {error}") from error
    if not isinstance(data, dict):
        raise ConfigurationError(f"The settings file {path} must hold one object of settings.")
    return data


def _parse_toml(text: str) -> Any:
    try:
        tomllib = importlib.import_module("tomllib")
    except ImportError:  # Python 3.10
        raise ConfigurationError(
            "TOML settings need Python 3.11 or newer; write the same settings as JSON."
        ) from None
    return tomllib.loads(text)
