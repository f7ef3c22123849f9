"""Whole protocols, from text to all that is said of them: wells, lines, words and what is open.

What comes out is compared with a snapshot; after a change read the difference well by well before
you accept it with ``--snapshot-update``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from syrupy.assertion import SnapshotAssertion

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.preflight import Options, Report, check_script
from aegis_ot.preflight.source import source_lines
from aegis_ot.vocabulary import Finding
from aegis_ot.workbench.guard_arguments import guard_arguments
from aegis_ot.workbench.run import options_for

FILES = sorted((Path(__file__).parent / "protocols").glob("*.py"))
SHOWN = 12


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_diagnostics(path: Path, snapshot: SnapshotAssertion) -> None:
    text = path.read_text(encoding="utf-8")
    options = options_for(guard_arguments(text), Options())
    report = check_script(Script(text, path.name), options=options)
    assert "\n".join(diagnostics(report, source_lines(text))) == snapshot
    for finding in report.findings:
        assert finding.lines
        assert finding.wells
        assert finding.why
        assert finding.fix


def diagnostics(report: Report, lines: list[str]) -> Iterator[str]:
    """Everything that is said of a protocol, for people to compare."""
    yield f"{report.verdict.value}, {report.family}"
    for finding in report.findings:
        yield f"{finding.rule} {finding.severity.value}: {finding.message}"
        yield from _sites(finding, lines)
        yield f"    fix: {finding.fix}"
    for undecided in report.undecided:
        yield f"{undecided.rule} undecided: {undecided.reason}"
    for remark in report.remarks:
        yield f"remark, line {remark.line}: {remark.message}"


def _sites(finding: Finding, lines: list[str]) -> Iterator[str]:
    addresses = [well.address for well in finding.wells]
    if len(addresses) > SHOWN:
        addresses = [*addresses[: SHOWN - 2], "...", addresses[-1], f"({len(addresses)} wells)"]
    yield f"    wells: {' '.join(addresses)}"
    for line in finding.lines:
        yield f"    line {line}: {lines[line - 1].strip()}"
