"""Applies the waivers of the project's configuration; those in a protocol are Layer 1's own."""

from __future__ import annotations

import dataclasses
import fnmatch
import os
from collections.abc import Sequence
from pathlib import Path

from ..preflight import Report
from ..preflight.judging import Waived, Waiver
from ..vocabulary import Finding, Remark
from .configuration import FILE, ConfiguredWaiver, shown
from .result import CheckedProtocol


def waive(
    file: str, report: Report, waivers: Sequence[ConfiguredWaiver], root: Path
) -> tuple[list[Finding], list[Waived]]:
    """Findings that stand, and findings that are waived, for one file."""
    here = _for_file(file, waivers, root)
    standing: list[Finding] = []
    waived: list[Waived] = []
    for finding in report.findings:
        by = next((waiver for waiver in here if finding.rule.upper() in waiver.rules), None)
        if by is None:
            standing.append(finding)
        else:
            waived.append(Waived(finding, Waiver(0, (), by.rules, by.reason)))
    return standing, waived


def with_stale_waivers(
    protocols: Sequence[CheckedProtocol], waivers: Sequence[ConfiguredWaiver], root: Path
) -> list[CheckedProtocol]:
    """The protocols, with a remark on each waiver that covers nothing in any of them.

    A waiver may well cover nothing in one file: it is stale if it covers nothing in all that it is
    for, and was judged in one. The first of these carries the remark. Of a waiver for every file a
    single one says nothing.
    """
    told = list(protocols)
    for waiver in waivers:
        concerned = [
            (number, checked.report)
            for number, checked in enumerate(told)
            if checked.report is not None and waiver in _for_file(checked.file, waivers, root)
        ]
        used = {
            waived.finding.rule
            for _, report in concerned
            for waived in report.waived
            if (waived.waiver.line, waived.waiver.rules) == (0, waiver.rules)
        }
        idle = {
            rule: number
            for number, report in reversed(concerned)
            for rule in report.judged
            if rule.upper() in waiver.rules and rule not in used
        }
        if not idle or (not waiver.files and len(concerned) < _SEVERAL):
            continue
        where = "this protocol"
        if len(concerned) > 1:
            where = f"the {len(concerned)} checked protocols that it is for"
        remark = Remark(
            f"The waiver of {', '.join(sorted(idle))} in {shown(root / FILE)} is stale: "
            f"nothing is found in {where}."
        )
        first = min(idle.values())
        told[first] = dataclasses.replace(told[first], settled=(*told[first].settled, remark))
    return told


_SEVERAL = 2


def _for_file(file: str, waivers: Sequence[ConfiguredWaiver], root: Path) -> list[ConfiguredWaiver]:
    path = Path(os.path.relpath(Path(file).resolve(), root.resolve())).as_posix()
    return [w for w in waivers if not w.files or any(_matches(path, p) for p in w.files)]


def _matches(path: str, pattern: str) -> bool:
    return fnmatch.fnmatchcase(path, pattern) or fnmatch.fnmatchcase(path, f"{pattern}/*")
