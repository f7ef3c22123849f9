"""Settings of the guard: keyword arguments over environment variables over a file over defaults.

:func:`load_settings` reads a file and the environment, so it is called inside ``run``, never at
import or decoration.
"""

from __future__ import annotations

import difflib
import importlib
import json
import os
import uuid
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from .errors import ConfigurationError

PREFIX = "AEGIS_OT_"
FILE_VARIABLE = "AEGIS_OT_CONFIG"
SIMULATED = "simulated"

POLICIES = ("pause", "continue", "abort")


@dataclass(frozen=True)
class Settings:
    """All that can be set, with its defaults.

    Attributes:
        assay: Assay family, or ``None`` to let the guard find out. Families of your own rule
            files are accepted as well.
        rules: ``"on"``; ``"warn"``: findings are reported and the run goes on; ``"off"``.
        select: Rule ids to use; empty for all.
        ignore: Rule ids to leave out.
        rules_path: Folder or file of further rules.
        roles: What wells are for, the guard's own evidence: role to wells, each written
            ``"label-or-slot:well"``, as in ``{"ntc": ["plate:H12"]}``.
        sidecar: Address of the sidecar, ``"http://192.168.1.20:7645"``; ``"simulated"``; ``None``
            for Layer 1 alone.
        token: Bearer token that the sidecar expects, or ``None``.
        hold: ``"boundary"``, ``"well"`` or ``"off"``; see ``docs/reference/keyframes.md``.
        on_fail: What a failed well does: ``"pause"``, ``"continue"`` or ``"abort"``.
        on_undecided: The same for a well that no gate could settle.
        on_link_loss: The same for a sidecar that is away, refuses, answers nonsense, or gives
            no frame or no verdict in time.
        watch_simulation: Whether Layer 2 also acts in simulation.
        lift: Whether moves to the top of the well are inserted for two of the keyframes.
        capture_timeout_s: Longest wait for one keyframe, retries included, s.
        verdict_timeout_s: Longest hold for verdicts at one boundary, s.
        rehearsal_timeout_s: Longest rehearsal of the protocol, s.
        opinion: ``"ask"``: the sidecar's model, if it has one, is asked about the protocol as
            well; it can add findings and takes none away. ``"off"``.
        opinion_timeout_s: Longest wait of an analysis for it, s; a live run takes what is
            remembered.
        run_id: Identifier of the run; a fresh one if ``None``.
    """

    assay: str | None = None
    rules: str = "on"
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    rules_path: str | None = None
    roles: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    sidecar: str | None = None
    token: str | None = field(default=None, repr=False)
    hold: str = "boundary"
    on_fail: str = "pause"
    on_undecided: str = "pause"
    on_link_loss: str = "pause"
    watch_simulation: bool = False
    lift: bool = True
    capture_timeout_s: float = 10.0
    verdict_timeout_s: float = 60.0
    rehearsal_timeout_s: float = 120.0
    opinion: str = "off"
    opinion_timeout_s: float = 20.0
    run_id: str | None = None

    def new_run_id(self) -> str:
        """The configured identifier, or a fresh one."""
        return self.run_id or uuid.uuid4().hex


NAMES = tuple(f.name for f in fields(Settings))


def unknown_names(keywords: Mapping[str, Any]) -> tuple[str, ...]:
    """Those keyword names that are no settings. No I/O; for whoever wants to know early."""
    return tuple(name for name in keywords if name not in NAMES)


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
            values[name] = _READERS[name](value, _Site(name, where))
    return Settings(**values)


@dataclass(frozen=True)
class _Site:
    name: str
    origin: str

    def error(self, value: Any, accepted: str) -> ConfigurationError:
        # An address may hold a password, and messages end up in logs.
        is_secret = self.name == "token" or (self.name == "sidecar" and "@" in str(value))
        shown = "..." if is_secret else repr(value)
        return ConfigurationError(
            f"Setting {self.name!r} ({self.origin}) is {shown}. Accepted: {accepted}."
        )


def _unknown(name: str, where: str) -> str:
    close = difflib.get_close_matches(name, NAMES, n=1, cutoff=0.6)
    hint = f"Did you mean {close[0]!r}?" if close else f"Settings are: {', '.join(NAMES)}."
    return f"There is no setting {name!r} ({where}). {hint}"


def _from_environment() -> tuple[str, dict[str, Any]]:
    found = {
        name: value
        for name in NAMES
        if (value := os.environ.get(PREFIX + name.upper())) is not None and value.strip()
    }
    return "environment", found


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
            f"The settings file {path} cannot be understood: {error}. Correct it there."
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


# One reader per setting: from a string of the environment or a value of a file or argument.


def _optional_text(value: Any, site: _Site) -> str | None:
    if value is None:
        return None
    if not isinstance(value, (str, os.PathLike)) or not str(value).strip():
        raise site.error(value, "a text that is not empty")
    return str(value).strip()


def _choice(*choices: str) -> Callable[[Any, _Site], str]:
    def read(value: Any, site: _Site) -> str:
        if value is False and "off" in choices:
            return "off"
        if value is True and "on" in choices:
            return "on"
        text = value.strip().lower() if isinstance(value, str) else value
        if text in choices:
            return str(text)
        close = difflib.get_close_matches(str(value), choices, n=1)
        hint = f" (did you mean {close[0]!r}?)" if close else ""
        raise site.error(value, ", ".join(map(repr, choices)) + hint)

    return read


def _flag(value: Any, site: _Site) -> bool:
    if isinstance(value, bool):
        return value
    words = {"1": True, "true": True, "yes": True, "on": True}
    words.update({"0": False, "false": False, "no": False, "off": False})
    text = str(value).strip().lower()
    if not isinstance(value, str) or text not in words:
        raise site.error(value, "true or false")
    return words[text]


def _seconds(value: Any, site: _Site) -> float:
    try:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)
    except (TypeError, ValueError):
        raise site.error(value, "a number of seconds, more than 0") from None
    if not 0 < number <= 86_400:
        raise site.error(value, "a number of seconds, more than 0 and at most a day")
    return number


def _texts(value: Any, site: _Site) -> tuple[str, ...]:
    if isinstance(value, str):
        value = [part.strip() for part in value.split(",") if part.strip()]
    if isinstance(value, (list, tuple, set, frozenset)) and all(
        isinstance(item, str) and item.strip() for item in value
    ):
        ordered = value if isinstance(value, (list, tuple)) else sorted(value)
        return tuple(item.strip() for item in ordered)
    raise site.error(value, "a list of texts, or one text with commas between them")


def _roles(value: Any, site: _Site) -> dict[str, tuple[str, ...]]:
    accepted = 'an object from role to wells, as in {"ntc": ["plate:H12"]}'
    if isinstance(value, str):
        try:
            value = json.loads(value)
        except ValueError:
            raise site.error(value, accepted + ", written as JSON") from None
    if not isinstance(value, Mapping) or not all(isinstance(k, str) and k for k in value):
        raise site.error(value, accepted)
    try:
        return {role: _texts(wells, site) for role, wells in value.items()}
    except ConfigurationError:
        raise site.error(value, accepted) from None


def _sidecar(value: Any, site: _Site) -> str | None:
    text = _optional_text(value, site)
    if text is None or text.lower() in ("off", "none"):
        return None
    if text.lower() == SIMULATED:
        return SIMULATED
    from urllib.parse import urlsplit

    accepted = '"http://HOST:PORT", "https://HOST:PORT", "simulated", or None'
    try:
        parts = urlsplit(text)
        port_is_fine = parts.port is None or 0 < parts.port < 65_536
    except ValueError:
        raise site.error(value, accepted) from None
    plain = not (parts.query or parts.fragment or parts.username or " " in text)
    plain = plain and parts.path.isascii() and text.isprintable()
    if parts.scheme in ("http", "https") and parts.hostname and port_is_fine and plain:
        return text.rstrip("/")
    raise site.error(value, accepted)


def _token(value: Any, site: _Site) -> str | None:
    text = _optional_text(value, site)
    if text is not None and not (text.isascii() and text.isprintable() and " " not in text):
        raise site.error(value, "printable ASCII without spaces")
    return text


def _run_id(value: Any, site: _Site) -> str | None:
    text = _optional_text(value, site)
    if text is not None:
        plain = text.replace("-", "").replace("_", "").replace(".", "")
        if not (plain.isascii() and plain.isalnum() and len(text) <= 100):
            raise site.error(value, "at most 100 letters, digits, '-', '_' and '.'")
    return text


_READERS: dict[str, Callable[[Any, _Site], Any]] = {
    "assay": _optional_text,
    "rules": _choice("on", "warn", "off"),
    "select": _texts,
    "ignore": _texts,
    "rules_path": _optional_text,
    "roles": _roles,
    "sidecar": _sidecar,
    "token": _token,
    "hold": _choice("boundary", "well", "off"),
    "on_fail": _choice(*POLICIES),
    "on_undecided": _choice(*POLICIES),
    "on_link_loss": _choice(*POLICIES),
    "watch_simulation": _flag,
    "lift": _flag,
    "capture_timeout_s": _seconds,
    "verdict_timeout_s": _seconds,
    "rehearsal_timeout_s": _seconds,
    "opinion": _choice("off", "ask"),
    "opinion_timeout_s": _seconds,
    "run_id": _run_id,
}
