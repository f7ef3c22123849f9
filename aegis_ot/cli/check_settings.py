"""How protocols are judged, as the command line and the project say it: for every command."""

from __future__ import annotations

import contextlib
import difflib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from ..checking import CheckSettings, Configuration
from ..checking.configuration import TABLE, ConfiguredWaiver
from ..checking.files import read_csv_paths, read_labware, read_values
from ..errors import ConfigurationError
from ..preflight import Database, Options, load_database

DEFAULT_TIMEOUT_S = 120.0

Files = Annotated[list[Path], typer.Argument(help="Python protocols.")]
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


def settings_of(
    configured: Configuration,
    *,
    assay: Sequence[str] | None,
    rules: Sequence[Path] | None,
    select: Sequence[str] | None,
    ignore: Sequence[str] | None,
    parameter: Sequence[str] | None,
    csv: Sequence[str] | None,
    labware: Sequence[Path] | None,
    timeout: float | None,
    strict: bool = False,
) -> tuple[CheckSettings, Database]:
    """What the options say, else the project, and the rules in force.

    Raises:
        ConfigurationError: A name is not known, or a value makes no sense.
        RuleError: A rule file cannot be used.
    """
    rule_paths = tuple(str(path) for path in rules or ()) or configured.rules
    database = load_database(rule_paths)
    options = _options(database, configured, assay, select, ignore)
    options = replace(options, strict=strict or configured.strict)
    if options.leave_none(database):
        where = f" and [{TABLE}] of {configured.name}" if configured.name else ""
        told = f"No rule is left to judge by: --select, --ignore{where} leave none."
        raise ConfigurationError(told)
    settings = CheckSettings(
        options=options,
        rules=tuple(str(Path(path).resolve()) for path in rule_paths),
        parameters=read_values(parameter or ()),
        csv_parameters=read_csv_paths(csv or ()),
        labware=read_labware(labware or [Path(p) for p in configured.labware]),
        timeout_s=seconds_of(timeout, configured.timeout),
        waivers=_waivers(database, configured),
        waiver_root=configured.folder,
    )
    return settings, database


def one_of(option: str, value: str, accepted: Sequence[str]) -> str:
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
    return _known(name, [rule.id for rule in database.rules], f"{place}there is no rule")


def split(option: str, values: Sequence[str] | None) -> list[str]:
    """``PCR-1,PCR-2`` and repeated options mean the same.

    Raises:
        ConfigurationError: The option is given, and names nothing.
    """
    names = [part for value in values or () for part in value.split(",") if part.strip()]
    if values and not names:
        raise ConfigurationError(f"{option}: names nothing; leave it out, or give it a value.")
    return names


def _known(name: str, names: Iterable[str], complaint: str) -> str:
    by_key = {known.casefold(): known for known in names}
    found = by_key.get(name.strip().casefold())
    if found is None:
        near = difflib.get_close_matches(name.strip().casefold(), by_key, n=3, cutoff=0.6)
        hint = f"did you mean {' or '.join(by_key[key] for key in near)}?" if near else ""
        raise ConfigurationError(
            f"{complaint} {name!r}; {hint or 'known are ' + ', '.join(by_key.values()) + '.'}"
        )
    return found


def _table(configured: Configuration) -> str:
    """The project's table with its file, for a complaint."""
    return f"{configured.name}: {TABLE}"


def _options(
    database: Database,
    configured: Configuration,
    assay: Sequence[str] | None,
    select: Sequence[str] | None,
    ignore: Sequence[str] | None,
) -> Options:
    families = [family.family for family in database.families]
    named, selected, table = split("--assay", assay), split("--select", select), _table(configured)
    return Options(
        assay=tuple(
            _known(name, families, f"{place}there is no assay family")
            for name, place in _placed("assay", named, () if named else configured.assay, table)
        ),
        select=tuple(
            known_rule(rule, database, place)
            for rule, place in _placed(
                "select", selected, () if selected else configured.select, table
            )
        ),
        ignore=tuple(
            known_rule(rule, database, place)
            for rule, place in _placed(
                "ignore", split("--ignore", ignore), configured.ignore, table
            )
        ),
        severity={
            known_rule(rule, database, f"{table}.severity: "): severity
            for rule, severity in configured.severity.items()
        },
    )


def _placed(
    option: str, given: Iterable[str], configured: Iterable[str], table: str
) -> Iterator[tuple[str, str]]:
    """Each value with the place that says it, for a complaint."""
    yield from ((value, f"--{option}: ") for value in given)
    yield from ((value, f"{table}.{option}: ") for value in configured)


def _waivers(database: Database, configured: Configuration) -> tuple[ConfiguredWaiver, ...]:
    place = f"{_table(configured)}.waivers: "
    for waiver in configured.waivers:
        for rule in waiver.rules:
            known_rule(rule, database, place)
    return configured.waivers


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
