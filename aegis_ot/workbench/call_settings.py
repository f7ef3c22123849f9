"""How protocols are judged, as a caller and the project say it: for every command, and `check`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from ..errors import ConfigurationError
from ..preflight import Options, RuleSet, load_rules
from .configuration import TABLE, Configuration, ConfiguredWaiver
from .files import read_csv_paths, read_labware, read_values
from .given import known_name, known_rule, seconds_of, split
from .run import CheckSettings


def settings_of(
    configured: Configuration,
    *,
    assay: Sequence[str] | None = None,
    rules: Sequence[Path] | None = None,
    select: Sequence[str] | None = None,
    ignore: Sequence[str] | None = None,
    parameter: Sequence[str] | None = None,
    csv: Sequence[str] | None = None,
    labware: Sequence[Path] | None = None,
    timeout: float | None = None,
    strict: bool = False,
) -> tuple[CheckSettings, RuleSet]:
    """What the options say, else the project, and the rules in force.

    Raises:
        ConfigurationError: A name is not known, or a value makes no sense.
        RuleError: A rule file cannot be used.
    """
    rule_paths = tuple(str(path) for path in rules or ()) or configured.rules
    rule_set = load_rules(rule_paths)
    options = _options(rule_set, configured, assay, select, ignore)
    options = replace(options, strict=strict or configured.strict)
    if options.leave_none(rule_set):
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
        waivers=_waivers(rule_set, configured),
        waiver_root=configured.folder,
    )
    return settings, rule_set


def _table(configured: Configuration) -> str:
    """The project's table with its file, for a complaint."""
    return f"{configured.name}: {TABLE}"


def _options(
    rule_set: RuleSet,
    configured: Configuration,
    assay: Sequence[str] | None,
    select: Sequence[str] | None,
    ignore: Sequence[str] | None,
) -> Options:
    families = [family.family for family in rule_set.assays]
    named, selected, table = split("--assay", assay), split("--select", select), _table(configured)
    return Options(
        assay=tuple(
            known_name(name, families, f"{place}there is no assay family")
            for name, place in _placed("assay", named, () if named else configured.assay, table)
        ),
        select=tuple(
            known_rule(rule, rule_set, place)
            for rule, place in _placed(
                "select", selected, () if selected else configured.select, table
            )
        ),
        ignore=tuple(
            known_rule(rule, rule_set, place)
            for rule, place in _placed(
                "ignore", split("--ignore", ignore), configured.ignore, table
            )
        ),
        severity={
            known_rule(rule, rule_set, f"{table}.severity: "): severity
            for rule, severity in configured.severity.items()
        },
    )


def _placed(
    option: str, given: Iterable[str], configured: Iterable[str], table: str
) -> Iterator[tuple[str, str]]:
    """Each value with the place that says it, for a complaint."""
    yield from ((value, f"--{option}: ") for value in given)
    yield from ((value, f"{table}.{option}: ") for value in configured)


def _waivers(rule_set: RuleSet, configured: Configuration) -> tuple[ConfiguredWaiver, ...]:
    place = f"{_table(configured)}.waivers: "
    for waiver in configured.waivers:
        for rule in waiver.rules:
            known_rule(rule, rule_set, place)
    return configured.waivers
