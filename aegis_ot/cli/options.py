"""Options that several commands share, and what makes sense as their values."""

from __future__ import annotations

import contextlib
import difflib
from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError

if TYPE_CHECKING:
    from ..preflight import Database

DEFAULT_TIMEOUT_S = 120.0

Files = Annotated[list[Path], typer.Argument(help="Python protocols.")]
FilesOrFolders = Annotated[
    list[Path], typer.Argument(help="Python protocols, or folders with protocols.")
]
Assay = Annotated[
    list[str] | None, typer.Option("--assay", help="Assay family, if it should not be inferred.")
]
Rules = Annotated[
    list[Path] | None, typer.Option("--rules", help="File or folder of further rules.")
]
Select = Annotated[list[str] | None, typer.Option("--select", help="Only these rules.")]
Ignore = Annotated[list[str] | None, typer.Option("--ignore", help="Not these rules.")]
Strict = Annotated[bool, typer.Option("--strict", help="Warnings are errors.")]
Parameters = Annotated[
    list[str] | None, typer.Option("--parameter", help="Runtime parameter as NAME=VALUE.")
]
CsvParameters = Annotated[
    list[str] | None, typer.Option("--csv", help="File of a CSV runtime parameter as NAME=PATH.")
]
Labware = Annotated[
    list[Path] | None,
    typer.Option("--labware", help="Folder or file with custom labware definitions."),
]
Timeout = Annotated[
    float | None,
    typer.Option(
        "--timeout",
        help=f"Longest rehearsal of one protocol, s ({DEFAULT_TIMEOUT_S:g} if left out).",
    ),
]


def one_of(option: str, value: str, accepted: Collection[str]) -> str:
    """Check a choice.

    Raises:
        ConfigurationError: It is none of them.
    """
    if value not in accepted:
        raise ConfigurationError(f"{option}: {value!r} is not one of {', '.join(accepted)}.")
    return value


def spared(option: str, written: Path | None, read: Iterable[Path]) -> None:
    """Refuse to write over what the same call reads.

    Raises:
        ConfigurationError: ``written`` is one of the files that are read.
    """
    if written is None:
        return
    for path in read:
        with contextlib.suppress(OSError):  # one of them is not there, or not to be looked at
            if path.samefile(written):
                raise ConfigurationError(
                    f"{option} {written}: the call reads this file; it would be overwritten."
                )


def known_rule(name: str, database: Database, place: str = "") -> str:
    """A rule's identifier in the spelling of its file, or the nearest ones as a hint.

    Raises:
        ConfigurationError: There is no such rule.
    """
    return known_name(name, [rule.id for rule in database.rules], f"{place}there is no rule")


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
