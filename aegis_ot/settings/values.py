"""From what somebody wrote to a setting's value: one reader per setting.

A reader takes a text of the environment as well as a value of a file or an argument.
"""

from __future__ import annotations

import difflib
import json
import os
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from ..errors import ConfigurationError
from ..vocabulary import FAILURES

POLICIES = ("pause", "continue", "abort")
RECOVERIES = {
    kind.value: known.recovery for kind, known in sorted(FAILURES.items()) if known.recovery
}
"""What can be done by itself about each kind of failure; of others too little is known."""


@dataclass(frozen=True)
class SettingPlace:
    """Which setting is read, and where it was written, as messages name them."""

    name: str
    origin: str

    def error(self, value: Any, accepted: str) -> ConfigurationError:
        """That ``value`` cannot be used."""
        # An address may hold a password, and messages end up in logs.
        is_secret = "token" in self.name or (self.name == "sidecar" and "@" in str(value))
        shown = "..." if is_secret else reprlib.repr(value)
        return ConfigurationError(
            f"Setting {self.name!r} ({self.origin}) is {shown}. Accepted: {accepted}."
        )


def _optional_text(
    value: Any, site: SettingPlace, accepted: str = "a text that is not empty"
) -> str | None:
    if value is None:
        return None
    if not isinstance(value, (str, os.PathLike)) or not str(value).strip():
        raise site.error(value, accepted)
    return str(value).strip()


def _choice(*choices: str) -> Callable[[Any, SettingPlace], str]:
    def read(value: Any, site: SettingPlace) -> str:
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


def _flag(value: Any, site: SettingPlace) -> bool:
    if isinstance(value, bool):
        return value
    words = {"1": True, "true": True, "yes": True, "on": True}
    words.update({"0": False, "false": False, "no": False, "off": False})
    text = str(value).strip().lower()
    if not isinstance(value, str) or text not in words:
        raise site.error(value, "true or false")
    return words[text]


def _seconds(value: Any, site: SettingPlace) -> float:
    try:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)
    except (TypeError, ValueError):
        raise site.error(value, "a number of seconds, more than 0") from None
    if not 0 < number <= 86_400:
        raise site.error(value, "a number of seconds, more than 0 and at most a day")
    return number


def _texts(value: Any, site: SettingPlace) -> tuple[str, ...]:
    if isinstance(value, str):
        value = [part.strip() for part in value.split(",") if part.strip()]
    if isinstance(value, (list, tuple, set, frozenset)) and all(
        isinstance(item, str) and item.strip() for item in value
    ):
        ordered = value if isinstance(value, (list, tuple)) else sorted(value)
        return tuple(item.strip() for item in ordered)
    raise site.error(value, "a list of texts, or one text with commas between them")


def _roles(value: Any, site: SettingPlace) -> dict[str, tuple[str, ...]]:
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


def _recover(value: Any, site: SettingPlace) -> dict[str, str]:
    known = ", ".join(f'"{kind}": "{action}"' for kind, action in RECOVERIES.items())
    accepted = f'an object with any of {known} (or "pause" for one of them)'
    if isinstance(value, str):
        try:
            value = json.loads(value)
        except ValueError:
            raise site.error(value, accepted + ", written as JSON") from None
    if not isinstance(value, Mapping) or not all(
        kind in RECOVERIES and action in (RECOVERIES[kind], "pause")
        for kind, action in value.items()
    ):
        raise site.error(value, accepted)
    return {kind: action for kind, action in value.items() if action != "pause"}


def _count(value: Any, site: SettingPlace) -> int:
    text = str(value).strip()
    if isinstance(value, bool) or not text.isascii() or not text.isdigit() or int(text) > 1000:
        raise site.error(value, "a whole number from 0 to 1000")
    return int(text)


def _sidecar(value: Any, site: SettingPlace) -> str | None:
    accepted = '"http://HOST:PORT", "https://HOST:PORT", or None'
    text = _optional_text(value, site, accepted)
    if text is None or text.lower() in ("off", "none"):
        return None
    if text.lower() == "simulated":
        raise site.error(
            value,
            f"{accepted}. To watch simulated frames, run `aegis-ot simulate PROTOCOL.py` on the "
            "workstation; it brings its own sidecar",
        )
    if _is_address(text):
        return text.rstrip("/")
    bare = "/" not in text and "@" not in text and _is_address(f"http://{text}")
    raise site.error(value, accepted + (f' (did you mean "http://{text}"?)' if bare else ""))


def _is_address(text: str) -> bool:
    try:
        parts = urlsplit(text)
        port_is_fine = parts.port is None or 0 < parts.port < 65_536
    except ValueError:
        return False
    plain = not (parts.query or parts.fragment or parts.username or " " in text)
    plain = plain and parts.path.isascii() and text.isprintable()
    return parts.scheme in ("http", "https") and bool(parts.hostname) and port_is_fine and plain


def _token(value: Any, site: SettingPlace) -> str | None:
    text = _optional_text(value, site)
    if text is not None and not (text.isascii() and text.isprintable() and " " not in text):
        raise site.error(value, "printable ASCII without spaces")
    return text


def _run_id(value: Any, site: SettingPlace) -> str | None:
    text = _optional_text(value, site)
    if text is not None:
        plain = text.replace("-", "").replace("_", "").replace(".", "")
        if not (plain.isascii() and plain.isalnum() and len(text) <= 100):
            raise site.error(value, "at most 100 letters, digits, '-', '_' and '.'")
    return text


READERS: dict[str, Callable[[Any, SettingPlace], Any]] = {
    "assay": _optional_text,
    "rules": _choice("on", "strict", "warn", "off"),
    "select": _texts,
    "ignore": _texts,
    "rules_path": _optional_text,
    "roles": _roles,
    "sidecar": _sidecar,
    "token": _token,
    "robot_token": _token,
    "robot_reason": _optional_text,
    "hold": _choice("boundary", "well", "off"),
    "on_fail": _choice(*POLICIES),
    "on_undecided": _choice(*POLICIES),
    "on_link_loss": _choice(*POLICIES),
    "recover": _recover,
    "recover_limit": _count,
    "recover_run_limit": _count,
    "watch_simulation": _flag,
    "lift": _flag,
    "capture_timeout_s": _seconds,
    "verdict_timeout_s": _seconds,
    "rehearsal_timeout_s": _seconds,
    "opinion": _choice("off", "ask"),
    "opinion_timeout_s": _seconds,
    "run_id": _run_id,
}
