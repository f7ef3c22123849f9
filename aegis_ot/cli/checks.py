"""``aegis-ot check``: Layer 1 on files, for terminals, editors, hooks and CI."""

from __future__ import annotations

import dataclasses
import difflib
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

import typer

from ..checking import (
    Asking,
    CheckRun,
    CheckSettings,
    Configuration,
    check_files,
    find_configuration,
)
from ..checking.baseline import baseline_text, read_baseline
from ..checking.configuration import ConfiguredWaiver
from ..checking.files import read_csv_paths, read_labware, read_values
from ..checking.side_by_side import processors
from ..errors import ConfigurationError
from ..preflight import Database, Options, load_database
from ..reports import RENDERERS, check_text
from .app import BROKEN, CLEAN, app
from .models import ModelName, RecordFolder, backend_of

DEFAULT_TIMEOUT_S = 120.0


@app.command()
def check(
    files: Annotated[list[Path], typer.Argument(help="Python protocols.")],
    output_format: Annotated[
        str, typer.Option("--format", "-f", help=f"One of {', '.join(RENDERERS)}.")
    ] = "text",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Write here, not to the terminal.")
    ] = None,
    assay: Annotated[
        list[str] | None, typer.Option(help="Assay family, if it should not be inferred.")
    ] = None,
    rules: Annotated[
        list[Path] | None, typer.Option(help="File or folder of further rules.")
    ] = None,
    select: Annotated[list[str] | None, typer.Option(help="Only these rules.")] = None,
    ignore: Annotated[list[str] | None, typer.Option(help="Not these rules.")] = None,
    explain_roles: Annotated[
        bool, typer.Option("--explain-roles", help="Show what each well is taken for, and why.")
    ] = False,
    parameter: Annotated[
        list[str] | None, typer.Option(help="Runtime parameter as NAME=VALUE.")
    ] = None,
    csv: Annotated[
        list[str] | None, typer.Option(help="File of a CSV runtime parameter as NAME=PATH.")
    ] = None,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    all_parameters: Annotated[
        bool, typer.Option("--all-parameters", help="Try all values of runtime parameters.")
    ] = False,
    timeout: Annotated[
        float | None,
        typer.Option(help=f"Longest rehearsal of one protocol, s [default: {DEFAULT_TIMEOUT_S:g}]"),
    ] = None,
    baseline: Annotated[
        Path | None, typer.Option(help="Leave out the findings that this file lists.")
    ] = None,
    write_baseline: Annotated[
        Path | None, typer.Option(help="Write such a file from what is found now.")
    ] = None,
    jobs: Annotated[
        int | None,
        typer.Option(
            "--jobs",
            "-j",
            min=1,
            help="Protocols to check at a time [default: one per processor]",
        ),
    ] = None,
    model: ModelName = None,
    record: RecordFolder = None,
) -> None:
    """Check protocols before they run: rehearse them, and judge them by the rules.

    A model, where one is named, adds to what the rules decide, and never takes from it.

    Exit codes: 0 clean, 1 findings, 2 a protocol could not be judged, a model that was asked
    gave no answer, or the call is wrong.
    """
    one_of("--format", output_format, tuple(RENDERERS))
    if baseline and write_baseline:
        raise ConfigurationError("--baseline and --write-baseline cannot be given together.")
    configured = find_configuration(Path.cwd())
    rule_paths = tuple(str(path) for path in rules or ()) or configured.rules
    database = load_database(rule_paths)
    settings = CheckSettings(
        options=_options(database, configured, assay, select, ignore),
        rules=tuple(str(Path(path).resolve()) for path in rule_paths),
        parameters=read_values(parameter or ()),
        csv_parameters=read_csv_paths(csv or ()),
        labware=read_labware(labware or [Path(p) for p in configured.labware]),
        timeout_s=_seconds(timeout, configured.timeout),
        all_parameters=all_parameters,
        waivers=_waivers(database, configured),
        waiver_root=configured.folder,
        explain_roles=explain_roles,
        asking=_asking(model, record, configured),
        jobs=jobs or processors(),
    )
    known = baseline or (Path(configured.baseline) if configured.baseline else None)
    if known is not None and not write_baseline:
        settings = dataclasses.replace(settings, baseline=read_baseline(known))
    run = check_files(_each_once(files), settings, database)
    if write_baseline:
        write_text(write_baseline, baseline_text(write_baseline, run.protocols))
        count = sum(len(checked.findings) for checked in run.protocols)
        typer.echo(f"{write_baseline}: {count} findings are known from now on.", err=True)
        raise typer.Exit(BROKEN if run.exit_code == BROKEN else CLEAN)
    _show(run, output_format, output)
    raise typer.Exit(run.exit_code)


def one_of(option: str, value: str, accepted: Sequence[str]) -> str:
    """Check a choice.

    Raises:
        ConfigurationError: It is none of them.
    """
    if value not in accepted:
        raise ConfigurationError(f"{option}: {value!r} is not one of {', '.join(accepted)}.")
    return value


def known_rule(name: str, database: Database, place: str = "") -> str:
    """A rule's identifier in the spelling of its file, or the nearest ones as a hint.

    Raises:
        ConfigurationError: There is no such rule.
    """
    return _known(name, [rule.id for rule in database.rules], f"{place}there is no rule")


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


def split(values: Sequence[str] | None) -> list[str]:
    """``PCR-1,PCR-2`` and repeated options mean the same."""
    return [part for value in values or () for part in value.split(",") if part.strip()]


def _options(
    database: Database,
    configured: Configuration,
    assay: Sequence[str] | None,
    select: Sequence[str] | None,
    ignore: Sequence[str] | None,
) -> Options:
    families = [family.family for family in database.families]
    return Options(
        assay=tuple(
            _known(name, families, "--assay: there is no assay family")
            for name in split(assay) or configured.assay
        ),
        select=tuple(
            known_rule(rule, database, "--select: ") for rule in split(select) or configured.select
        ),
        ignore=tuple(
            known_rule(rule, database, "--ignore: ")
            for rule in [*split(ignore), *configured.ignore]
        ),
        severity={
            known_rule(rule, database, "pyproject.toml: tool.aegis-ot.severity: "): severity
            for rule, severity in configured.severity.items()
        },
    )


def _waivers(database: Database, configured: Configuration) -> tuple[ConfiguredWaiver, ...]:
    place = "pyproject.toml: tool.aegis-ot.waivers: "
    for waiver in configured.waivers:
        for rule in waiver.rules:
            known_rule(rule, database, place)
    return configured.waivers


def _asking(model: str | None, record: Path | None, configured: Configuration) -> Asking | None:
    backend = backend_of(model, record, configured.model, configured.folder)
    return None if backend is None else Asking(backend)


def _seconds(given: float | None, configured: float | None) -> float:
    if given is None:
        return configured or DEFAULT_TIMEOUT_S
    if not 0 < given <= 86_400:
        raise ConfigurationError(f"--timeout: expected seconds greater than 0, found {given:g}.")
    return given


def _each_once(files: Sequence[Path]) -> list[Path]:
    return list(dict.fromkeys(files))


def _show(run: CheckRun, output_format: str, output: Path | None) -> None:
    if output is not None:
        write_text(output, RENDERERS[output_format](run))
        typer.echo(f"{output_format} report: {output}", err=True)
        return
    if output_format == "text":
        text = check_text(run, colour=_colours())
    else:
        text = RENDERERS[output_format](run)
    # Bytes: a Windows console's own encoding may lack the µ of a message.
    sys.stdout.buffer.write(text.encode("utf-8"))
    sys.stdout.buffer.flush()


def _colours() -> bool:
    if os.environ.get("NO_COLOR"):
        return False
    return sys.stdout.isatty() and os.environ.get("TERM") != "dumb"


def write_text(path: Path, text: str) -> None:
    """Write a file, making its folder.

    Raises:
        ConfigurationError: It cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None
