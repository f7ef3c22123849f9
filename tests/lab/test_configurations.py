from __future__ import annotations

import pytest

from aegis_ot.llm import ReplayBackend, ScriptedBackend, State
from aegis_ot.llm.backends.recording import RecordingBackend
from aegis_ot.vocabulary import Severity, VerdictWord
from aegis_ot_lab.configurations import judge_in
from tests.llm.samples import CONTAMINATED, SILENT, answer, examined, finding, rule_set

BLIND = {
    "family": "pcr",
    "findings": [finding("PCR-2", ["2:A2", "4:H12", "4:H13", "7:A1"], [15, 18, 400])],
    "summary": "The NTC is touched.",
}


def test_rules_only_asks_nobody() -> None:
    report, dossier, reading = examined(CONTAMINATED)
    backend = ScriptedBackend([])
    result = judge_in("rules-only", report, dossier, reading, backend)
    assert result.report is report
    assert result.reply is None
    assert not result.unanswered
    assert backend.requests == []


def test_trace_blind_is_the_models_verdict_alone() -> None:
    report, dossier, reading = examined(CONTAMINATED)
    backend = ScriptedBackend([BLIND])
    result = judge_in("trace-blind", report, dossier, reading, backend)
    (found,) = result.report.findings
    assert (found.rule, found.source, found.severity) == ("PCR-2", "model", Severity.ERROR)
    assert {well.address for well in found.wells} == {"2:A2", "4:H12"}, "wells of the deck only"
    assert set(found.lines) == {15, 18}
    assert result.report.verdict is VerdictWord.FAIL
    question = str(backend.requests[0].messages[0].parts[0])
    assert "Trace:" not in question
    assert "Roles" not in question
    assert "PCR-2" in backend.requests[0].system[1].text


def test_without_checks_a_model_that_finds_nothing_passes_it() -> None:
    report, dossier, reading = examined(CONTAMINATED)
    nothing = {"family": "generic", "findings": [], "summary": ""}
    result = judge_in("trace-blind", report, dossier, reading, ScriptedBackend([nothing]))
    assert result.report.verdict is VerdictWord.PASS
    assert result.report.family == "generic"


def test_llm_only_sees_no_rules() -> None:
    report, dossier, reading = examined(SILENT)
    said = BLIND | {"findings": [finding("MODEL", ["4:H12"], [15])]}
    backend = ScriptedBackend([said])
    result = judge_in("llm-only", report, dossier, reading, backend)
    told = "".join(passage.text for passage in backend.requests[0].system)
    assert not any(rule.id in told for rule in rule_set().rules)
    assert result.report.verdict is VerdictWord.FAIL
    # What it calls a rule is its own name for it, and flags the protocol all the same.
    named = BLIND | {"findings": [finding("cross-contamination", ["4:H12"], [15])]}
    result = judge_in("llm-only", report, dossier, reading, ScriptedBackend([named]))
    assert [found.rule for found in result.report.findings] == ["MODEL"]


@pytest.mark.parametrize("configuration", ["trace-blind", "llm-only"])
def test_a_model_alone_that_does_not_answer_is_an_error_never_a_pass(configuration: str) -> None:
    report, dossier, reading = examined(SILENT)
    for state in (State.TIMEOUT, State.REFUSED, State.INVALID):
        backend = ScriptedBackend([state])
        result = judge_in(configuration, report, dossier, reading, backend)
        assert result.unanswered
        assert result.report.verdict is VerdictWord.ERROR
        assert result.report.undecided


def test_every_configuration_works_on_recordings(tmp_path) -> None:  # type: ignore[no-untyped-def]
    report, dossier, reading = examined(CONTAMINATED)
    for name, said in (("hybrid", answer()), ("trace-blind", BLIND), ("llm-only", BLIND)):
        folder = tmp_path / name
        recorder = RecordingBackend(ScriptedBackend([said]), folder)
        live = judge_in(name, report, dossier, reading, recorder)
        again = judge_in(name, report, dossier, reading, ReplayBackend(folder))
        assert again.report == live.report
