"""Applies the waivers of the project's configuration; those in a protocol are Layer 1's own."""

from __future__ import annotations

import fnmatch
import os
from collections.abc import Sequence
from pathlib import Path

from ..preflight.judging import Waived, Waiver
from ..vocabulary import Finding
from .configuration import TABLE, ConfiguredWaiver


def waive(
    file: str, findings: Sequence[Finding], waivers: Sequence[ConfiguredWaiver], root: Path
) -> tuple[list[Finding], list[Waived], list[str]]:
    """Findings that stand, findings that are waived, and stale waivers, for one file.

    A waiver that names files and covers nothing in one of them is stale there; a waiver for
    all files may well cover nothing in this one.
    """
    path = Path(os.path.relpath(Path(file).resolve(), root.resolve())).as_posix()
    here = [w for w in waivers if not w.files or any(_matches(path, p) for p in w.files)]
    standing: list[Finding] = []
    waived: list[Waived] = []
    used: set[int] = set()
    for finding in findings:
        cover = next((n for n, w in enumerate(here) if finding.rule.upper() in w.rules), None)
        if cover is None:
            standing.append(finding)
            continue
        used.add(cover)
        by = here[cover]
        waived.append(Waived(finding, Waiver(0, (), by.rules, by.reason)))
    stale = [
        f"The waiver of {', '.join(w.rules)} in [{TABLE}] is stale: nothing is found in this file."
        for n, w in enumerate(here)
        if w.files and n not in used
    ]
    return standing, waived, stale


def _matches(path: str, pattern: str) -> bool:
    return fnmatch.fnmatchcase(path, pattern) or fnmatch.fnmatchcase(path, f"{pattern}/*")
