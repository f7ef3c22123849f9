"""Protocols in the style of public ones: silent about roles, correct, and never accused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.preflight import check_script, load_database
from aegis_ot.preflight.rehearsal import Script
from aegis_ot.vocabulary import Severity

HERE = Path(__file__).parent.parent / "protocols" / "public_style"
EXPECTED = json.loads((HERE / "expected.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_a_protocol_in_public_style_is_not_accused(name: str) -> None:
    script = Script((HERE / name).read_text(encoding="utf-8"), name)

    report = check_script(script, load_database())

    errors = {
        found.rule: found.message for found in report.findings if found.severity is Severity.ERROR
    }
    assert set(errors) <= set(EXPECTED[name]["may_fire"]), errors
