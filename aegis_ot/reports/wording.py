"""Small words that several renderers share."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..vocabulary import Finding, Severity, Site, VerdictWord, WellRef, counted, printable
from ..workbench import CheckedProtocol, CheckRun


def fit_to_print(checked: CheckedProtocol) -> CheckedProtocol:
    """The same, with every text of it on one line and without what would repaint a terminal.

    Names of files, labware and liquids, and messages, come from the protocol.
    """
    fitted: CheckedProtocol = _fit(dataclasses.replace(checked, judgement=None, dossier=None))
    return dataclasses.replace(fitted, judgement=checked.judgement, dossier=checked.dossier)


def _fit(value: Any) -> Any:
    if type(value) is str:
        return printable(value, "\t")
    if isinstance(value, (list, tuple)):
        return tuple(map(_fit, value))
    if isinstance(value, Mapping):
        return {_fit(key): _fit(each) for key, each in value.items()}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [each.name for each in dataclasses.fields(value) if each.init]
        return dataclasses.replace(value, **{name: _fit(getattr(value, name)) for name in names})
    return value


def listed_wells(wells: Iterable[WellRef], at_most: int = 8) -> str:
    """Addresses, the first few of many."""
    addresses = list(dict.fromkeys(well.address for well in wells))
    return listed(addresses, at_most)


def listed(items: Sequence[str], at_most: int = 8) -> str:
    """``a, b and 3 more``."""
    if len(items) <= at_most:
        return ", ".join(items)
    return f"{', '.join(items[:at_most])} and {len(items) - at_most} more"


def summary_line(run: CheckRun) -> str:
    """What came of all files together, in one line."""
    words = [checked.verdict for checked in run.protocols]
    parts = [
        counted(words.count(VerdictWord.PASS), "passed", "passed"),
        counted(words.count(VerdictWord.WARN), "warned", "warned"),
        counted(words.count(VerdictWord.FAIL), "failed", "failed"),
    ]
    broken = words.count(VerdictWord.ERROR)
    if broken:
        parts.append(f"{broken} could not be judged")
    silent = sum(bool(checked.unanswered) for checked in run.protocols)
    if silent:
        parts.append(f"{silent} without the model's answer")
    findings = [finding for checked in run.protocols for finding in checked.findings]
    errors = sum(finding.severity is Severity.ERROR for finding in findings)
    told = [counted(errors, "error"), counted(len(findings) - errors, "warning")]
    undecided = sum(len(checked.undecided) for checked in run.protocols)
    waived = sum(len(checked.waived) for checked in run.protocols)
    known = sum(len(checked.baselined) for checked in run.protocols)
    for number, word in ((undecided, "undecided"), (waived, "waived"), (known, "in the baseline")):
        if number:
            told.append(f"{number} {word}")
    return f"{counted(len(words), 'protocol')}: {', '.join(parts)}; {', '.join(told)}."


def by_model(finding: Finding) -> str:
    """The mark of a finding that no check made."""
    return "found by the model" if finding.source == "model" else ""


def model_line(checked: CheckedProtocol) -> str:
    """Which model answered about a protocol, and what it took; ``""`` if none did."""
    reply = checked.judgement.reply if checked.judgement else None
    if reply is None or not reply.answered:
        return ""
    usage = reply.usage
    cached = f", {usage.cached / usage.total_input:.0%} from the cache" if usage.cached else ""
    tokens = f"{usage.total_input} tokens in{cached}, {usage.output} out, "
    return f"{reply.model}: {tokens if usage.total_input else ''}{reply.seconds:.1f} s"


def sites_by_line(finding: Finding) -> dict[int, list[Site]]:
    """The sites of a finding that have a line, by line, in their order."""
    lines: dict[int, list[Site]] = {}
    for site in finding.sites:
        if site.line is not None:
            lines.setdefault(site.line, []).append(site)
    return lines


def site_label(sites: Sequence[Site], at_most: int = 4) -> str:
    """What was done at one line, and to which wells."""
    parts = []
    for action in dict.fromkeys(site.action for site in sites):
        names = dict.fromkeys(s.well.address for s in sites if s.action == action and s.well)
        wells = listed(list(names), at_most)
        told = any(name.rpartition(":")[2] in action.split() for name in names)
        parts.append(action if told or not wells else f"{action} ({wells})" if action else wells)
    return "; ".join(part for part in parts if part)


def location(checked: CheckedProtocol, line: int | None) -> str:
    """``file:line``, or the file alone; ``file, step 4 (transfer), command 12`` without lines."""
    if line and checked.unit != "line":
        return f"{checked.file}, {place_in_file(checked, line)}"
    return f"{checked.file}:{line}" if line else checked.file


def place_in_file(checked: CheckedProtocol, line: int) -> str:
    """``line 12``; ``step 4 (transfer), command 12`` where Protocol Designer's steps are told."""
    step = checked.steps.get(line)
    return f"{f'{step}, ' if step else ''}{checked.unit} {line}"


def file_line(checked: CheckedProtocol, line: int | None) -> int | None:
    """The line of the file, for programs that open it there; ``None`` if it has none."""
    return line if checked.unit == "line" else None
