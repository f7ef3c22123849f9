"""What a caller gives by name or in seconds, checked before anything is rehearsed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..errors import ConfigurationError

if TYPE_CHECKING:
    from ..preflight import RuleSet

DEFAULT_TIMEOUT_S = 120.0


def known_rule(name: str, rule_set: RuleSet, place: str = "") -> str:
    """A rule's identifier in the spelling of its file, or the nearest ones as a hint.

    Raises:
        ConfigurationError: There is no such rule.
    """
    return known_name(name, [rule.id for rule in rule_set.rules], f"{place}there is no rule")


def split(option: str, values: Sequence[str] | None) -> list[str]:
    """``PCR-1,PCR-2`` and repeated options mean the same.

    Raises:
        ConfigurationError: The option is given, and names nothing.
    """
    names = [part for value in values or () for part in value.split(",") if part.strip()]
    if values and not names:
        raise ConfigurationError(f"{option}: names nothing; leave it out, or give it a value.")
    return names


def known_name(name: str, names: Iterable[str], complaint: str) -> str:
    """A name in its own spelling.

    Raises:
        ConfigurationError: It is none of them; the nearest ones are a hint.
    """
    by_key = {known.casefold(): known for known in names}
    found = by_key.get(name.strip().casefold())
    if found is None:
        near = difflib.get_close_matches(name.strip().casefold(), by_key, n=3, cutoff=0.6)
        hint = f"did you mean {' or '.join(by_key[key] for key in near)}?" if near else ""
        raise ConfigurationError(
            f"{complaint} {name!r}; {hint or 'known are ' + ', '.join(by_key.values()) + '.'}"
        )
    return found


def seconds_of(given: float | None, configured: float | None = None) -> float:
    """The longest rehearsal, s.

    Raises:
        ConfigurationError: It is no length of time.
    """
    if given is None:
        return configured or DEFAULT_TIMEOUT_S
    if not 0 < given <= 86_400:
        raise ConfigurationError(f"--timeout: expected seconds greater than 0, found {given:g}.")
    return given
