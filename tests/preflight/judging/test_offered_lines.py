"""A line to paste names no well whose role is known, and hides nothing that is wrong."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.judging import Interpretation, Report, judge

SHELF = Path(__file__).parents[3] / "examples" / "prose-benchmark"
FILES = sorted(SHELF.glob("p*.py"))[::8]
OFFER = "@guard(roles="


def _errors(report: Report) -> set[tuple[str, str]]:
    return {
        (finding.rule, well.address)
        for finding in report.findings
        for well in finding.wells
        if finding.severity.value == "error"
    }


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_is_offered_hides_nothing(path: Path) -> None:
    recording = record(Script(path.read_text(encoding="utf-8"), path.name))
    rule_set, options = load_rules(), Options()
    before = judge(Interpretation(recording, rule_set, options))
    for line in {one.paste for one in before.undecided if one.paste.startswith(OFFER)}:
        if "= ..." in line:
            continue  # concentrations are left to write, and without them it is refused
        roles = json.loads(line[len(OFFER) : -1])
        after = judge(Interpretation(recording, rule_set, replace(options, roles=roles)))
        assert _errors(before) <= _errors(after), line
