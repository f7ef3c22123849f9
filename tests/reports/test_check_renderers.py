"""Each renderer against its snapshot, and against what its format demands."""

from __future__ import annotations

import dataclasses
import json
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import jsonschema
import pytest
from syrupy.assertion import SnapshotAssertion

from aegis_ot._version import DOCUMENTATION
from aegis_ot.llm import Judgement, Reply, State, TokenUsage
from aegis_ot.preflight import load_rules
from aegis_ot.preflight.opinion import no_answer
from aegis_ot.reports import FORMATS, renderer
from aegis_ot.reports.check_github import check_github
from aegis_ot.reports.check_html import check_html
from aegis_ot.reports.check_json import check_json
from aegis_ot.reports.check_junit import check_junit
from aegis_ot.reports.check_sarif import check_sarif
from aegis_ot.reports.check_text import check_text
from aegis_ot.vocabulary import Finding, Opinion, Severity, Site, Undecided
from aegis_ot.workbench import CheckedProtocol, CheckRun

from .sample import CARRY, DATABASE, LINES, RUN, report, well
from .sarif_constraints import SARIF

ROOT = Path(__file__).resolve().parents[2]
OWN_RULES = ROOT / "examples" / "rules" / "luciferase.json"
EMPTY = CheckRun((), DATABASE, "1.2.3")


@pytest.mark.parametrize("name", FORMATS)
def test_snapshot(name: str, snapshot: SnapshotAssertion) -> None:
    assert renderer(name)(RUN) == snapshot


@pytest.mark.parametrize("name", FORMATS)
def test_nothing_checked_is_rendered_too(name: str) -> None:
    assert renderer(name)(EMPTY).endswith("\n") or name == "html"


def test_text_has_colours_only_when_asked() -> None:
    plain, coloured = check_text(RUN), check_text(RUN, colour=True)
    assert "\x1b[" not in plain
    assert re.sub(r"\x1b\[[\d;]*m", "", coloured) == plain


def test_carets_stand_under_the_statement_without_its_comment() -> None:
    lines = check_text(RUN).splitlines()
    number = next(n for n, line in enumerate(lines) if "p20.aspirate(5, template)" in line)
    source, carets = lines[number], lines[number + 1]
    start, end = carets.index("^"), carets.rindex("^") + 1
    assert source[start:end] == "p20.aspirate(5, template)"


def test_text_tells_the_fourth_finding_of_a_kind_and_later_ones_in_a_line() -> None:
    def overfilled(number: int) -> Finding:
        message = f"A{number} of the plate is filled to 380 µL at line {number}; it holds 360 µL."
        sites = tuple(Site(line, well(f"A{number}")) for line in (100 + number, number))
        return Finding("GEN-3", Severity.ERROR, message, sites, "Why.")

    other = dataclasses.replace(overfilled(6), message="A6 holds 40 µL less than is drawn.")
    findings = (*map(overfilled, range(1, 6)), other)
    shown = check_text(CheckRun((CheckedProtocol("f.py", report(*findings)),), DATABASE, "1"))
    assert shown.count("= why: Why.") == 4, "the first three, and the one of another kind"
    assert "GEN-3 volumes [error]: likewise at f.py:4 (3:A4; line 104)\nGEN-3" in shown
    assert "GEN-3 volumes [error]: likewise at f.py:5 (3:A5; line 105)\n\nGEN-3" in shown
    assert "A6 holds 40 µL less" in shown


@pytest.mark.parametrize(
    ("code", "cells"), [('試薬 = "é"; go()', 16), ('te\N{COMBINING ACUTE ACCENT} = "µ"; go()', 14)]
)
def test_carets_are_as_wide_as_a_terminal_shows_the_statement(code: str, cells: int) -> None:
    lines = ("", "", "", "", f"    {code}  # 試", "", "", "")
    run = CheckRun((CheckedProtocol("f.py", report(CARRY), lines=lines),), DATABASE, "1")
    shown = check_text(run).splitlines()
    carets = shown[next(n for n, line in enumerate(shown) if code in line) + 1]
    assert carets.count("^") == cells
    assert "    ^" in carets


def test_json_has_exactly_the_fields_of_the_specification() -> None:
    run = CheckRun(
        (CheckedProtocol("f.py", report(CARRY), lines=LINES), CheckedProtocol("g.py", report())),
        DATABASE,
        "1.2.3",
    )
    data = json.loads(check_json(run))
    assert set(data) == {"schema_version", "version", "summary", "protocols"}
    for protocol in data["protocols"]:
        assert set(protocol) == {"file", "family", "verdict", "findings", "undecided", "rules"}
    (finding,) = data["protocols"][0]["findings"]
    assert set(finding) == {"rule", "severity", "wells", "lines", "message", "fix"}
    assert finding["wells"] == ["2:B1", "3:H12", "3:G12"]
    assert finding["lines"] == [5, 8]
    assert [p["verdict"] for p in data["protocols"]] == ["fail", "pass"]


def test_json_says_of_each_rule_what_became_of_it_and_sums_up() -> None:
    judged = dataclasses.replace(report(CARRY), judged=("PCR-2", "PCR-6"))
    open_ = dataclasses.replace(judged, undecided=(Undecided("GEN-3", "No volume is known"),))
    run = CheckRun(
        (CheckedProtocol("f.py", open_, off=("PCR-6",)), CheckedProtocol("g.py")), DATABASE, "1.2.3"
    )
    data = json.loads(check_json(run))
    assert data["protocols"][0]["rules"] == {
        "PCR-2": "decided", "PCR-6": "off", "PCR-1": "not_applicable", "GEN-3": "undecided",
    }  # fmt: skip
    assert data["protocols"][1]["rules"] == {}
    summary = data["summary"]
    assert (summary["protocols"], summary["fail"], summary["error"]) == (2, 1, 1)
    assert (summary["errors"], summary["undecided"], summary["exit_code"]) == (1, 1, 2)


def test_github_carries_the_line_to_paste() -> None:
    undecided = Undecided("PCR-2", "No well is known", '@guard(roles={"ntc": ["1:A1"]})')
    judged = dataclasses.replace(report(), undecided=(undecided,))
    shown = check_github(CheckRun((CheckedProtocol("f.py", judged),), DATABASE, "1"))
    assert 'Write: @guard(roles={"ntc": ["1:A1"]})' in shown


def test_sarif_says_where_help_on_a_rule_is() -> None:
    log = json.loads(check_sarif(CheckRun((), load_rules([OWN_RULES]), "1.2.3")))
    jsonschema.Draft202012Validator(SARIF).validate(log)
    rules = {rule["id"]: rule for rule in log["runs"][0]["tool"]["driver"]["rules"]}
    page, _, heading = rules["PCR-2"]["helpUri"].partition("#")
    assert page == DOCUMENTATION + "rules/pcr.html"
    text = (ROOT / "docs" / "rules" / "pcr.md").read_text("utf-8").lower()
    assert f"## {heading.replace('pcr-2-', 'pcr-2 ')}\n" in text
    assert f"site_url: {DOCUMENTATION}" in (ROOT / "mkdocs.yml").read_text("utf-8")
    own = next(iter(set(rules) - {rule.id for rule in load_rules().rules}))
    assert "helpUri" not in rules[own]


def test_json_says_why_a_protocol_was_not_judged() -> None:
    broken = json.loads(check_json(RUN))["protocols"][3]
    assert broken["verdict"] == "error"
    assert broken["error"]["line"] == 3


@pytest.mark.parametrize("run", [RUN, EMPTY], ids=["full", "empty"])
def test_sarif_is_valid(run: CheckRun) -> None:
    log = json.loads(check_sarif(run))
    jsonschema.Draft202012Validator(SARIF).validate(log)
    (only,) = log["runs"]
    rules = only["tool"]["driver"]["rules"]
    for result in only["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]


def test_the_sarif_constraints_can_fail() -> None:
    log = json.loads(check_sarif(RUN))
    log["runs"][0]["results"][0]["level"] = "fatal"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(SARIF).validate(log)


def test_sarif_fingerprints_survive_moved_lines() -> None:
    def fingerprint(run: CheckRun) -> str:
        result = json.loads(check_sarif(run))["runs"][0]["results"][0]
        return str(result["partialFingerprints"]["aegisFinding/v1"])

    moved = dataclasses.replace(
        CARRY, sites=tuple(dataclasses.replace(s, line=(s.line or 0) + 1) for s in CARRY.sites)
    )
    here = CheckRun((CheckedProtocol("f.py", report(CARRY), lines=LINES),), DATABASE, "1")
    there = CheckRun((CheckedProtocol("f.py", report(moved), lines=("", *LINES)),), DATABASE, "1")
    assert fingerprint(here) == fingerprint(there)


def test_github_commands_are_one_line_each_and_escaped() -> None:
    for line in check_github(RUN).splitlines()[:-1]:
        assert re.fullmatch(r"::(error|warning|notice) file=[^,:]+(,[a-z]+=[^,:]*)*::.+", line)
    assert "file=protocols/bad%2C odd.py,line=8" in check_github(RUN)
    assert "100 %25" in check_github(RUN)


def test_junit_counts_agree_with_its_cases() -> None:
    root = ElementTree.fromstring(check_junit(RUN).encode())
    assert root.get("tests") == str(len(root.findall("testsuite/testcase")))
    for tag, count in (("failure", "failures"), ("error", "errors"), ("skipped", "skipped")):
        assert root.get(count) == str(len(root.findall(f"testsuite/testcase/{tag}")))
    assert root.get("errors") == "3"


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_tells_of_a_stale_waiver(name: str) -> None:
    assert "The waiver of PCR-5 is stale: nothing is found there." in renderer(name)(RUN)


def test_junit_survives_control_characters() -> None:
    odd = dataclasses.replace(CARRY, message="a bell \x07 rings")
    run = CheckRun((CheckedProtocol("f.py", report(odd), lines=LINES),), DATABASE, "1")
    ElementTree.fromstring(check_junit(run).encode())


def test_html_is_self_contained_and_escaped() -> None:
    page = check_html(RUN)
    assert "<script" not in page
    assert not re.search(r'(src|href)="(?!#)', page)
    assert "&lt;a&gt; &amp; b" in page


def _asked(reply: Reply, *findings: Finding, **more: object) -> CheckRun:
    judged = report(*findings, **more)
    judgement = Judgement(judged, reply)
    checked = CheckedProtocol("f.py", judged, lines=LINES, judgement=judgement)
    return CheckRun((checked,), DATABASE, "1")


BEYOND = Finding(
    "MODEL", Severity.WARNING, "It is diluted a thousandfold.", CARRY.sites, source="model"
)


@pytest.mark.parametrize("name", FORMATS)
def test_what_the_model_found_is_marked_and_what_the_checks_found_is_not(name: str) -> None:
    reply = Reply(State.ANSWERED, "some-model", {}, usage=TokenUsage(100, 300, 0, 50), seconds=2.0)
    mark = '"source": "model"' if name == "json" else "found by the model"
    for finding in (dataclasses.replace(CARRY, source="model"), BEYOND):
        shown = renderer(name)(_asked(reply, finding))
        assert shown.count(mark) == 1, shown
        assert finding.message in shown
    assert mark not in renderer(name)(_asked(reply, CARRY))


@pytest.mark.parametrize("name", FORMATS)
def test_a_model_that_gave_no_answer_is_told_by_its_state(name: str) -> None:
    reply = Reply(State.RATE_LIMITED, "some-model", detail="slow down")
    question = no_answer(Opinion("rate_limited", "some-model", "slow down"))
    run = _asked(reply, undecided=(question,))
    assert run.exit_code == 2
    shown = renderer(name)(run)
    assert "some-model gave no answer (rate_limited): slow down" in shown
    assert "error" in shown or name == "json"


def test_names_command_neither_the_terminal_nor_the_runner_of_a_ci() -> None:
    hostile = "x\x1b[2J\n::error file=a.py::owned\r\n##[error]owned"
    finding = Finding(
        "GEN-3", Severity.ERROR, hostile, (Site(1, well("A1", label=hostile)),), hostile
    )
    checked = CheckedProtocol(
        f"::error::{hostile}.py", report(finding, notes=(hostile,)), lines=(f"a = 1  # {hostile}",)
    )
    told = CheckRun((checked,), DATABASE, "1")
    for text in (check_text(told), check_github(told)):
        assert not re.search(r"[\x1b\r]", text)
    lines = check_text(told).splitlines()
    assert not any(line.lstrip().startswith("::") or "##[" in line for line in lines)
    commands = [line for line in check_github(told).splitlines() if line.startswith("::")]
    assert all(re.match(r"::(error|warning|notice) file=", line) for line in commands)
    assert sum(line.startswith("::error") for line in commands) == 1
