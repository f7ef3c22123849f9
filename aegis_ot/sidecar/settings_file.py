"""Settings in a JSON or TOML file, one over another, and what is wrong with them."""

from __future__ import annotations

import difflib
import importlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

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


def nest(place: tuple[str, ...], value: Any) -> dict[str, Any]:
    """A setting in its sections, as a file would have it."""
    for name in reversed(place):
        value = {name: value}
    return dict(value)


def merge(into: dict[str, Any], new: Mapping[str, Any]) -> None:
    """Add settings, section by section; the new ones win."""
    for name, value in new.items():
        if isinstance(value, Mapping) and isinstance(into.get(name), dict):
            merge(into[name], value)
        else:
            into[name] = dict(value) if isinstance(value, Mapping) else value


def explain(error: ValidationError, model: type[BaseModel]) -> str:
    """What is wrong with the settings of ``model``, for people."""
    lines = []
    for problem in error.errors(include_url=False):
        place = ".".join(str(part) for part in problem["loc"])
        text = problem["msg"].removeprefix("Value error, ")
        if problem["type"] == "extra_forbidden":
            hint = _elsewhere(problem, model) or _meant(problem["loc"], model)
            text = f"there is no such setting{hint}"
        elif problem["type"] == "model_type":
            text = f"is a section of settings: [{place}] in TOML, an object in JSON"
        elif problem["type"] == "tuple_type":
            given = problem["input"]
            text = "must be a list" + (f', as ["{given}"]' if isinstance(given, str) else "")
        lines.append(f"{place}: {text}" if place else text)
    return "Sidecar settings: " + "; ".join(lines)


def _elsewhere(problem: Mapping[str, Any], model: type[BaseModel]) -> str:
    """In which section an unknown setting is known, or what an unknown section holds."""
    given = problem["input"]
    names = list(given) if isinstance(given, Mapping) else [problem["loc"][-1]]
    known = [
        f"{section}.{name}"
        for section, field in model.model_fields.items()
        for name in names
        if name in getattr(field.annotation, "model_fields", ())
    ]
    return f"; did you mean {' or '.join(known)}?" if known else ""


def _meant(place: tuple[int | str, ...], model: type[BaseModel]) -> str:
    """Which setting an unknown one resembles, as the end of a sentence."""
    section: Any = model
    for name in place[:-1]:
        if isinstance(name, int):  # One of several: their type is that of the first.
            section = get_args(section)[0]
        else:
            section = section.model_fields[name].annotation
    known = list(section.model_fields)
    close = difflib.get_close_matches(str(place[-1]), known, n=1)
    return f"; did you mean {close[0]!r}?" if close else f"; there are {', '.join(known)}"
