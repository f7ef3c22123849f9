"""Applies the waivers of the project's configuration; those in a protocol are Layer 1's own."""

from __future__ import annotations

import fnmatch
import os
from collections.abc import Sequence
from pathlib import Path

from ..preflight import Report
from ..preflight.judging import Waived, Waiver
from ..vocabulary import Finding, Remark
from .configuration import TABLE, ConfiguredWaiver


def waive(
    file: str, report: Report, waivers: Sequence[ConfiguredWaiver], root: Path
) -> tuple[list[Finding], list[Waived], list[Remark]]:
    """Findings that stand, findings that are waived, and stale waivers, for one file.

    A waiver that names files and covers nothing in one of them is stale there, if its rule was
    judged; a waiver for all files may well cover nothing in this one.
    """
    path = Path(os.path.relpath(Path(file).resolve(), root.resolve())).as_posix()
    here = [w for w in waivers if not w.files or any(_matches(path, p) for p in w.files)]
    standing: list[Finding] = []
    waived: list[Waived] = []
    used: set[tuple[int, str]] = set()
    for finding in report.findings:
        cover = next((n for n, w in enumerate(here) if finding.rule.upper() in w.rules), None)
        if cover is None:
            standing.append(finding)
            continue
        used.add((cover, finding.rule.upper()))
        by = here[cover]
        waived.append(Waived(finding, Waiver(0, (), by.rules, by.reason)))
    stale = []
    for number, waiver in enumerate(here):
        idle = [
            rule
            for rule in report.judged
            if rule.upper() in waiver.rules and (number, rule.upper()) not in used
        ]
        if waiver.files and idle:
            told = f"The waiver of {', '.join(idle)} in [{TABLE}] is stale: nothing is found in "
            stale.append(Remark(f"{told}this file."))
    return standing, waived, stale


def _matches(path: str, pattern: str) -> bool:
    return fnmatch.fnmatchcase(path, pattern) or fnmatch.fnmatchcase(path, f"{pattern}/*")
