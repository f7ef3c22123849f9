"""Options that several commands share, and what makes sense as their values."""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Annotated

import typer

from ..errors import ConfigurationError
from ..workbench.given import DEFAULT_TIMEOUT_S

_JUDGING = "How to judge"
_VALUES = "What the protocol gets"

FilesOrFolders = Annotated[
    list[Path] | None,
    typer.Argument(help="Protocols (Python, Protocol Designer), analyses, or folders of them."),
]
Assay = Annotated[
    list[str] | None,
    typer.Option(
        "--assay", help="Assay family, if it should not be inferred.", rich_help_panel=_JUDGING
    ),
]
Rules = Annotated[
    list[Path] | None,
    typer.Option("--rules", help="File or folder of further rules.", rich_help_panel=_JUDGING),
]
Select = Annotated[
    list[str] | None, typer.Option("--select", help="Only these rules.", rich_help_panel=_JUDGING)
]
Ignore = Annotated[
    list[str] | None, typer.Option("--ignore", help="Not these rules.", rich_help_panel=_JUDGING)
]
Strict = Annotated[
    bool, typer.Option("--strict", help="Warnings are errors.", rich_help_panel=_JUDGING)
]
Parameters = Annotated[
    list[str] | None,
    typer.Option("--parameter", help="Runtime parameter as NAME=VALUE.", rich_help_panel=_VALUES),
]
CsvParameters = Annotated[
    list[str] | None,
    typer.Option(
        "--csv", help="File of a CSV runtime parameter as NAME=PATH.", rich_help_panel=_VALUES
    ),
]
Labware = Annotated[
    list[Path] | None,
    typer.Option(
        "--labware", help="Folder or file with custom labware definitions.", rich_help_panel=_VALUES
    ),
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


def refuse_to_overwrite(option: str, written: Path | None, read: Iterable[Path]) -> None:
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
