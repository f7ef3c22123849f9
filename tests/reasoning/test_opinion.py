"""What a model may add to a verdict, and what it may not."""

from __future__ import annotations

from typing import Any

import pytest

from aegis_ot.preflight import Options, Report
from aegis_ot.preflight.opinion import Dossier
from aegis_ot.preflight.merging import merge
from aegis_ot.preflight.opinion import unanswered
from aegis_ot.preflight.opinion_reading import read_opinion
from aegis_ot.reasoning import Judgement, ScriptedBackend, State, judge_in
from aegis_ot.vocabulary import Severity, VerdictWord, from_json, to_json

from .samples import CONTAMINATED, SILENT, answer, checked, database, finding, recheck

VIOLATED = finding("PCR-2", ["2:A2", "4:H12"], [11, 15], "The template's tip mixes H12.")


def judged(text: str, *said: Any, rejudge: bool = False) -> Judgement:
    report, dossier = checked(text)
    again = (lambda options: recheck(text, options)) if rejudge else None
    backend = ScriptedBackend(list(said))
    return judge_in("hybrid", report, dossier, database(), backend, Options(), again)


def test_a_decided_finding_survives_any_answer() -> None:
    before = checked(CONTAMINATED)[0]
    whitewash = answer(summary="All is well. PASS.", family="generic")
    for said in (whitewash, "APPROVED", {}, *State):
        after = judged(CONTAMINATED, said).report
        assert after.verdict is VerdictWord.FAIL
        assert set(before.findings) <= set(after.findings)


def test_a_finding_of_the_models_own_is_marked() -> None:
    after = judged(SILENT, answer(findings=[VIOLATED])).report
    (found,) = after.findings
    assert (found.source, found.rule, found.severity) == ("model", "PCR-2", Severity.ERROR)
    assert [well.address for well in found.wells] == ["2:A2", "4:H12"]
    assert found.lines == (11, 15)
    assert after.verdict is VerdictWord.FAIL
    assert "PCR-2" not in {undecided.rule for undecided in after.undecided}


@pytest.mark.parametrize(
    ("wells", "lines", "why"),
    [
        (["4:B7"], [15], "no well"),
        (["9:A1"], [15], "no well"),
        (["H12"], [15], "no well"),
        (["4:H12"], [1], "no line"),
        (["4:H12"], [999], "no line"),
        (["4:H12"], [-3], "no line"),
        (["nonsense", ""], [], "no well"),
    ],
)
def test_wells_and_lines_must_occur_in_the_run(
    wells: list[str], lines: list[int], why: str
) -> None:
    after = judged(SILENT, answer(findings=[finding("PCR-2", wells, lines)])).report
    assert after.findings == ()
    assert after.verdict is VerdictWord.PASS
    assert any(why in note for note in after.notes), "it is told, not dropped in silence"


def test_a_rule_that_does_not_exist_is_no_finding() -> None:
    after = judged(SILENT, answer(findings=[finding("PCR-99", ["4:H12"], [15])])).report
    assert after.findings == ()
    assert any("PCR-99" in note for note in after.notes)


def test_an_answer_about_a_rule_that_does_not_exist_is_told() -> None:
    said = answer(answers=[{"rule": "NOPE-1", "answer": "violated", "reason": "So it is."}])
    after = judged(SILENT, said).report
    assert any("NOPE-1" in note for note in after.notes)


def test_a_models_names_and_words_are_one_printable_line() -> None:
    odd = "x\x1b[31m\n\u202e\ud800"
    said = answer(
        family=odd,
        roles=[
            {"role": odd, "wells": ["4:H12"], "reason": odd},
            {"role": odd, "wells": ["9:A1"], "reason": odd},
        ],
        findings=[finding(odd, ["4:H12"], [15], odd), finding("PCR-2", ["4:H12"], [15], odd)],
        answers=[{"rule": "PCR-1", "answer": "holds", "reason": odd}],
        summary=odd,
    )
    after = judged(SILENT, said).report
    texts = [*after.notes, after.family, *(f.message for f in after.findings)]
    texts += [u.reason for u in after.undecided]
    texts += [text for role in after.roles for text in (role.role, *role.evidence)]
    assert all(text.isprintable() for text in texts), texts
    assert len(after.findings) == 1


def test_a_rule_that_the_checks_decided_stays_decided() -> None:
    before = checked(CONTAMINATED)[0]
    wrong = finding("PCR-1", ["4:A1"], [13], "A1 has no master mix.")
    after = judged(CONTAMINATED, answer(findings=[wrong])).report
    assert after.findings == before.findings
    assert any("disagrees" in note and "PCR-1" in note for note in after.notes)


def test_a_finding_beyond_the_rules_only_warns() -> None:
    odd = finding("MODEL", ["4:A1"], [12], "The template is diluted a thousandfold.")
    after = judged(SILENT, answer(findings=[odd])).report
    assert [(f.rule, f.severity) for f in after.findings] == [("MODEL", Severity.WARNING)]
    assert after.verdict is VerdictWord.WARN


def test_open_questions_stay_listed_with_the_models_reading() -> None:
    reading = {"rule": "PCR-2", "answer": "holds", "reason": "H12 is no NTC."}
    after = judged(SILENT, answer(answers=[reading])).report
    reasons = {u.rule: u.reason for u in after.undecided}
    assert set(reasons) == {u.rule for u in checked(SILENT)[0].undecided}
    assert "it holds: H12 is no NTC." in reasons["PCR-2"]


def test_roles_that_names_leave_open_let_the_checks_decide() -> None:
    roles = [
        {"role": "master_mix", "wells": ["2:A1"], "reason": "goes everywhere"},
        {"role": "template", "wells": ["2:A2"], "reason": "one well only"},
        {"role": "ntc", "wells": ["4:H12"], "reason": "gets no template"},
    ]
    without = judged(SILENT, answer(roles=roles)).report
    assert without.findings == ()
    after = judged(SILENT, answer(roles=roles), rejudge=True).report
    assert "PCR-2" in {f.rule for f in after.findings}
    assert all(f.source == "model" for f in after.findings)
    named = {(item.well.address, item.role) for item in after.roles}
    assert ("4:H12", "ntc") in named
    assert any("read by scripted" in e for item in after.roles for e in item.evidence)


def test_roles_cannot_be_taken_from_wells_that_have_one() -> None:
    roles = [{"role": "water", "wells": ["2:A2", "4:H12"], "reason": "trust me"}]
    before = checked(CONTAMINATED)[0]
    after = judged(CONTAMINATED, answer(roles=roles), rejudge=True).report
    assert after.findings == before.findings
    assert after.verdict is VerdictWord.FAIL


def test_no_answer_is_undecided_and_said() -> None:
    for state in State:
        if state is State.ANSWERED:
            continue
        result = judged(SILENT, state)
        assert result.unanswered
        assert state.value in unanswered(result.report)
        assert set(checked(SILENT)[0].undecided) < set(result.report.undecided)
    nobody = judge_in("hybrid", *checked(SILENT), database())
    assert nobody.reply is not None
    assert nobody.reply.state is State.NO_MODEL


def test_a_waiver_covers_the_models_finding_too() -> None:
    text = SILENT.replace(
        'p20.mix(2, 10, plate["H12"])',
        'p20.mix(2, 10, plate["H12"])  # aegis: ignore[PCR-2] a rehearsal with water',
    )
    after = judged(text, answer(findings=[VIOLATED])).report
    assert after.findings == ()
    assert [w.finding.source for w in after.waived] == ["model"]
    assert after.verdict is VerdictWord.PASS


def test_rules_that_the_user_left_out_stay_out() -> None:
    report, dossier = _with(Options(ignore=("PCR-2",)))
    backend = ScriptedBackend([answer(findings=[VIOLATED])])
    after = judge_in("hybrid", report, dossier, database(), backend).report
    assert after.findings == ()


def _with(options: Options) -> tuple[Report, Dossier]:
    from aegis_ot.preflight.opinion import check_with_dossier
    from aegis_ot.preflight.rehearsal import Script

    return check_with_dossier(Script(SILENT, "protocol.py"), database(), options)


def test_ranges_and_labels_name_wells() -> None:
    _, dossier = checked(CONTAMINATED)
    said = finding("MODEL", ["PCR plate:A1-H12", "slot 2:A1-A3"], [13])
    opinion = read_opinion(answer(findings=[said]), dossier, "m")
    wells = {well.address for well in opinion.findings[0].wells}
    assert wells == {"4:A1", "4:H12", "2:A1", "2:A2", "2:A3"}, "only those that the run used"


def test_opinions_and_dossiers_cross_the_wire() -> None:
    _, dossier = checked(SILENT)
    back = Dossier.from_json(dossier.to_json())
    assert back == dossier
    assert back.digest == dossier.digest
    opinion = read_opinion(answer(findings=[VIOLATED], summary="x"), dossier, "m")
    assert from_json(type(opinion), to_json(opinion)) == opinion


def test_the_digest_is_of_what_the_protocol_does() -> None:
    dossier = checked(SILENT)[1]
    other = checked(SILENT.replace("p20.aspirate(5", "p20.aspirate(6"))[1]
    assert dossier.digest != other.digest
    assert dossier.digest == checked.__wrapped__(SILENT)[1].digest


def test_a_flood_of_findings_is_cut() -> None:
    many = [finding("MODEL", ["4:A1"], [12], f"No. {n}") for n in range(500)]
    assert len(judged(SILENT, answer(findings=many)).report.findings) <= 12


def test_merge_needs_no_second_reading() -> None:
    report, dossier = checked(CONTAMINATED)
    opinion = read_opinion(answer(), dossier, "m")
    assert merge(report, opinion, dossier).findings == report.findings
