"""From a protocol, or from what a guard recorded, to a report; and the report in plain words."""

from __future__ import annotations

from collections.abc import Sequence

from ..adapters.opentrons.rehearsal import Recording, Script, record
from ..settings import Settings
from ..vocabulary import Finding, Severity, counted
from .judging import Interpretation, Options, Report, judge, unanswered
from .rule_set import RuleSet, load_rules


def read_for_guard(recording: Recording, settings: Settings) -> Interpretation:
    """Read a rehearsal on record as a guard's settings say.

    Raises:
        RuleError: A rule file cannot be used.
        ConfigurationError: A setting names a rule, role or family that does not exist.
    """
    rule_set = load_rules([settings.rules_path] if settings.rules_path else [])
    return Interpretation(recording, rule_set, Options.from_settings(settings))


def check_recording(recording: Recording, settings: Settings) -> Report:
    """Judge a rehearsal on record as a guard's settings say; raises as :func:`read_for_guard`."""
    return judge(read_for_guard(recording, settings))


def check_script(
    script: Script,
    rule_set: RuleSet | None = None,
    options: Options | None = None,
    timeout_s: float = 120.0,
) -> Report:
    """Rehearse a protocol and judge it.

    Raises:
        RehearsalError: It cannot be rehearsed.
        RuleError: A rule file cannot be used.
    """
    recording = record(script, timeout_s=timeout_s)
    return judge(Interpretation(recording, rule_set or load_rules(), options))


def errors_of(report: Report) -> list[Finding]:
    """The findings for which the guard refuses to run a protocol."""
    return [finding for finding in report.findings if finding.severity is Severity.ERROR]


def rejection(report: Report) -> str:
    """Why a protocol is refused: every error with its rule, wells and lines."""
    errors = errors_of(report)
    count = "an error" if len(errors) == 1 else f"{len(errors)} errors"
    lines = [f"Layer 1 found {count} in {report.file}; no tip has moved."]
    lines += [tell_finding(finding) for finding in errors]
    return "\n".join(lines)


def summary(report: Report) -> str:
    """One line for the run log."""
    rules = ", ".join(dict.fromkeys(finding.rule for finding in report.findings))
    told = f" ({rules})" if rules else ""
    silence = unanswered(report)
    model = f" The model was asked in vain: {silence}" if silence else ""
    return f"Layer 1: {report.verdict.value}{told}: {counts_of(report)}.{model}"


def counts_of(report: Report) -> str:
    """How many errors, warnings and so on there are."""
    errors = len(errors_of(report))
    warnings = len(report.findings) - errors
    parts = [
        counted(errors, "error"),
        counted(warnings, "warning"),
        f"{len(report.undecided)} undecided{_named([one.rule for one in report.undecided])}",
    ]
    if report.waived:
        parts.append(f"{len(report.waived)} waived")
    if report.remarks:
        parts.append(f"{counted(len(report.remarks), 'remark')} (aegis-ot check shows them)")
    return ", ".join(parts)


def _named(rules: Sequence[str], most: int = 4) -> str:
    """``" (PCR-1, PCR-2 and 3 more)"``; nothing of none."""
    known = list(dict.fromkeys(rules))
    rest = f" and {len(known) - most} more" if len(known) > most else ""
    return f" ({', '.join(known[:most])}{rest})" if known else ""


def tell_finding(finding: Finding) -> str:
    """One finding in words: rule, what happened, where, how to mend it."""
    lines = ", ".join(str(line) for line in finding.lines)
    wells = ", ".join(str(well) for well in finding.wells)
    where = f" Lines {lines}; wells {wells}." if lines and wells else ""
    fix = f" Fix: {finding.fix}" if finding.fix else ""
    mark = " (found by the model)" if finding.source == "model" else ""
    return f"{finding.rule}{mark}: {finding.message}{where}{fix}"
