"""What a model may add to a verdict, and what it may not."""

from __future__ import annotations

from typing import Any

import pytest

from aegis_ot.llm import Judgement, ScriptedBackend, State, hybrid
from aegis_ot.llm.read_answer import read_opinion
from aegis_ot.preflight import Options
from aegis_ot.preflight.judging import unanswered
from aegis_ot.preflight.opinion import merge
from aegis_ot.vocabulary import Dossier, Severity, VerdictWord, from_json, to_json

from .samples import (
    CONTAMINATED,
    PROSE,
    READ,
    SILENT,
    answer,
    checked,
    examined,
    finding,
    proposal,
    reading_of,
)

VIOLATED = finding("PCR-2", ["2:A2", "4:H12"], [11, 15], "The template's tip mixes H12.")


def judged(text: str, *said: Any, options: Options | None = None) -> Judgement:
    known = examined.__wrapped__(text, options) if options else examined(text)
    return hybrid(*known, ScriptedBackend(list(said)))


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
    assert (found.source, found.rule, found.severity) == ("model", "PCR-2", Severity.WARNING)
    assert [well.address for well in found.wells] == ["2:A2", "4:H12"]
    assert found.lines == (11, 15)
    assert after.verdict is VerdictWord.WARN
    assert "PCR-2" not in {undecided.rule for undecided in after.undecided}


@pytest.mark.parametrize(
    ("wells", "lines", "why"),
    [
        (["4:B7"], [15], "no well"),
        (["9:A1"], [15], "no well"),
        (["A1"], [15], "no well"),
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
    said = answer(answers=[reading_of("NOPE-1", "violated", ["4:H12"], [15])])
    after = judged(SILENT, said).report
    assert any("NOPE-1" in note for note in after.notes)


def test_a_models_names_and_words_are_one_printable_line() -> None:
    odd = "x\x1b[31m\n\u202e\ud800"
    said = answer(
        family=odd,
        roles=[
            proposal(odd, ["4:H12"], 3, odd),
            proposal("ntc", [odd], 3, odd, [odd]),
        ],
        findings=[finding(odd, ["4:H12"], [15], odd), finding("PCR-2", ["4:H12"], [15], odd)],
        answers=[reading_of("PCR-1", "holds", [odd], [1], odd)],
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


def test_an_answer_against_a_decided_rule_is_told_in_a_note() -> None:
    before = checked(CONTAMINATED)[0]
    said = reading_of("PCR-1", "violated", ["4:A1"], [13], "A1 has no master mix.")
    after = judged(CONTAMINATED, answer(answers=[said])).report
    assert after.findings == before.findings
    assert any("disagrees" in one and "A1 has no master mix." in one for one in after.notes)


def test_a_finding_beyond_the_rules_only_warns() -> None:
    odd = finding("MODEL", ["4:A1"], [12], "The template is diluted a thousandfold.")
    after = judged(SILENT, answer(findings=[odd])).report
    assert [(f.rule, f.severity) for f in after.findings] == [("MODEL", Severity.WARNING)]
    assert after.verdict is VerdictWord.WARN


def test_open_questions_stay_listed_with_the_models_reading() -> None:
    holds = reading_of("PCR-2", "holds", [], [], "H12 is no NTC.")
    after = judged(SILENT, answer(answers=[holds])).report
    reasons = {u.rule: u.reason for u in after.undecided}
    assert set(reasons) == {u.rule for u in checked(SILENT)[0].undecided}
    assert "it holds: H12 is no NTC." in reasons["PCR-2"]


def test_a_rule_that_does_not_apply_can_be_said_not_to() -> None:
    said = reading_of("PCR-2", "not_applicable", [], [], "Nothing is amplified.")
    after = judged(SILENT, answer(answers=[said])).report
    reasons = {u.rule: u.reason for u in after.undecided}
    assert "it does not apply: Nothing is amplified." in reasons["PCR-2"]


def test_roles_under_a_decided_rule_tell_what_it_would_find() -> None:
    text = CONTAMINATED.replace("# NOTE_HERE", "# B1 is a second no-template control") + (
        '    p20.transfer(15, master_mix, plate["B1"])\n'
        '    p20.transfer(5, template, plate["B1"])\n'
    )
    before = checked(text)[0]
    assert "PCR-4" in before.judged
    told = proposal("ntc", ["4:B1"], 4, "B1 is a second no-template control")
    after = judged(text, answer(roles=[told])).report
    assert after.findings == before.findings
    (note,) = [one for one in after.notes if "PCR-4 would find" in one]
    assert "B1" in note


def test_levels_that_the_model_reads_are_offered_with_its_roles() -> None:
    text = """
    # The tubes A1, B1 and C1 hold the BSA standards: 0.5, 1 and 2 mg/mL.
    metadata = {"apiLevel": "2.15", "protocolName": "Bradford assay"}
    def run(protocol):
        tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
        rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4)
        p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
        p20.transfer(10, rack.columns()[0][:3], plate.columns()[0][:3], new_tip="always")
    """
    quote = "The tubes A1, B1 and C1 hold the BSA standards: 0.5, 1 and 2 mg/mL."
    told = ["0.5 mg/mL", "1 mg/mL", "2 mg/mL"]
    said = proposal("standard", ["2:A1", "2:B1", "2:C1"], 2, quote, told)
    after = judged(text, answer(family="bradford", roles=[said])).report
    asked = {one.rule: one for one in after.undecided}["BRD-1"]
    assert '"2:A1 = 0.5 mg/mL", "2:B1 = 1 mg/mL", "2:C1 = 2 mg/mL"' in asked.paste
    assert asked.to_write == "write, if it reads them right"


def test_an_answer_violated_is_a_warning_with_its_wells_and_lines() -> None:
    said = reading_of("PCR-2", "violated", ["2:A2", "4:H12"], [13, 15], "Its tip mixes H12.")
    after = judged(SILENT, answer(answers=[said])).report
    (found,) = after.findings
    assert (found.rule, found.source, found.severity) == ("PCR-2", "model", Severity.WARNING)
    assert [well.address for well in found.wells] == ["2:A2", "4:H12"]
    assert found.lines == (13, 15)
    assert found.message == "Its tip mixes H12."
    assert "PCR-2" not in {undecided.rule for undecided in after.undecided}


def test_an_answer_violated_may_cite_its_wells_and_lines_in_its_reason() -> None:
    told = "Tip 2 goes from 2:A2 into H12 at lines 13 and 15."
    after = judged(SILENT, answer(answers=[reading_of("PCR-2", "violated", [], [], told)])).report
    (found,) = after.findings
    assert (found.source, found.severity) == ("model", Severity.WARNING)
    assert [well.address for well in found.wells] == ["2:A2", "4:H12"]
    assert found.lines == (13, 15)
    assert found.message == told


def test_an_answer_violated_that_stands_under_findings_too_is_told_once() -> None:
    said = reading_of("PCR-2", "violated", ["4:H12"], [15])
    after = judged(SILENT, answer(answers=[said], findings=[VIOLATED])).report
    assert [found.message for found in after.findings] == [VIOLATED["message"]]


def test_an_answer_violated_without_wells_of_the_run_stays_a_question() -> None:
    said = reading_of("PCR-2", "violated", ["4:B7"], [15])
    after = judged(SILENT, answer(answers=[said])).report
    assert after.findings == ()
    reasons = {u.rule: u.reason for u in after.undecided}
    assert "it is violated: So it is." in reasons["PCR-2"]
    assert any("names no well" in note for note in after.notes)


def test_roles_that_only_prose_tells_let_the_checks_decide() -> None:
    assert checked(PROSE)[0].findings == ()
    after = judged(PROSE, answer(roles=READ)).report
    found = {f.rule: f for f in after.findings}
    assert "PCR-2" in found
    assert all(f.source == "model" for f in after.findings)
    assert all(f.severity is Severity.WARNING for f in after.findings)
    assert after.verdict is VerdictWord.WARN
    assert "read by scripted at line" in found["PCR-2"].message, "it says on what it rests"
    named = {(item.well.address, item.role): item.evidence for item in after.roles}
    (said,) = named["4:H12", "ntc"]
    assert said == "read by scripted at line 5: 'The last well is our no-template control.'"


def test_the_roles_that_would_decide_a_question_are_told_to_be_pasted() -> None:
    after = judged(PROSE, answer(roles=READ)).report
    pasted = {u.rule: u.paste for u in after.undecided}
    assert pasted["PCR-3"] == (
        '@guard(roles={"master_mix": ["2:A1"], "template": ["2:A2"], "ntc": ["4:H12"]})'
    )
    roles = {"master_mix": ["2:A1"], "template": ["2:A2"], "ntc": ["4:H12"]}
    given = examined.__wrapped__(PROSE, Options(roles=roles))[0]
    assert given.undecided == ()
    errors = {f.rule for f in given.findings if f.severity is Severity.ERROR}
    assert "PCR-2" in errors, "what the user says is no doubt"


def test_a_check_that_sees_the_same_tells_it() -> None:
    said = reading_of("PCR-2", "violated", ["2:A2", "4:H12"], [12, 16], "H12 is touched.")
    after = judged(PROSE, answer(roles=READ, answers=[said])).report
    (found,) = [f for f in after.findings if f.rule == "PCR-2"]
    assert "H12 is touched" not in found.message
    assert found.fix


def test_where_warnings_are_errors_so_are_the_models() -> None:
    after = judged(PROSE, answer(roles=READ), options=Options(strict=True)).report
    assert {f.severity for f in after.findings} == {Severity.ERROR}
    assert after.verdict is VerdictWord.FAIL
    after = judged(SILENT, answer(findings=[VIOLATED]), options=Options(strict=True)).report
    assert [f.severity for f in after.findings] == [Severity.ERROR]


def test_a_proposal_that_is_not_accepted_is_told_with_the_reason() -> None:
    made_up = proposal("ntc", ["4:H12"], 4, "H12 is the NTC")
    after = judged(PROSE, answer(roles=[*READ[:2], made_up])).report
    assert "PCR-2" not in {f.rule for f in after.findings}
    (note,) = after.notes
    assert note == (
        "scripted, role of 4:H12 as ntc, not accepted: 'H12 is the NTC' does not stand at line 4."
    )


def test_roles_cannot_be_taken_from_wells_that_have_one() -> None:
    line = 1 + CONTAMINATED.splitlines().index(
        '    master_mix, template, water = tubes["A1"], tubes["A2"], tubes["A3"]'
    )
    roles = [proposal("water", ["2:A2"], line, "template, water")]
    before = checked(CONTAMINATED)[0]
    after = judged(CONTAMINATED, answer(roles=roles)).report
    assert after.findings == before.findings
    assert after.verdict is VerdictWord.FAIL
    assert any("2:A2 is template by name `template`" in note for note in after.notes)


def test_the_models_family_counts_where_the_checks_only_guess() -> None:
    unknown = SILENT.replace("PCR set-up", "Tuesday")
    report, dossier, _ = examined(unknown)
    assert (report.family, dossier.family_known) == ("generic", False)
    quoted = proposal("master_mix", ["2:A1"], 10, 'p20.transfer(15, tubes["A1"]')
    after = judged(unknown, answer(family="pcr", roles=[quoted])).report
    assert ("2:A1", "master_mix") in {(item.well.address, item.role) for item in after.roles}
    known = judged(SILENT, answer(family="cell_treatment", roles=[])).report
    assert known.family == "pcr", "what is known stays"


def test_no_answer_is_undecided_and_said() -> None:
    for state in State:
        if state is State.ANSWERED:
            continue
        result = judged(SILENT, state)
        assert result.unanswered
        assert state.value in unanswered(result.report)
        assert set(checked(SILENT)[0].undecided) < set(result.report.undecided)
    nobody = hybrid(*examined(SILENT))
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
    left_out = Options(ignore=("PCR-2",))
    said = answer(findings=[VIOLATED], answers=[reading_of("PCR-2", "violated", ["4:H12"], [15])])
    assert judged(SILENT, said, options=left_out).report.findings == ()
    roles = judged(PROSE, answer(roles=READ), options=left_out).report
    assert "PCR-2" not in {f.rule for f in roles.findings}


def test_ranges_and_labels_name_wells() -> None:
    _, dossier = checked(CONTAMINATED)
    said = finding("MODEL", ["PCR plate:A1-H12", "Slot 2:A1-A3"], [13])
    opinion = read_opinion(answer(findings=[said]), dossier, "m")
    wells = {well.address for well in opinion.findings[0].wells}
    assert wells == {"4:A1", "4:H12", "2:A1", "2:A2", "2:A3"}, "only those that the run used"


def test_opinions_and_dossiers_cross_the_wire() -> None:
    _, dossier = checked(SILENT)
    back = from_json(Dossier, to_json(dossier))
    assert back == dossier
    assert back.digest == dossier.digest
    said = answer(findings=[VIOLATED], summary="x", roles=READ)
    opinion = read_opinion(said, dossier, "m")
    assert len(opinion.proposals) == 3
    assert from_json(type(opinion), to_json(opinion)) == opinion


def test_the_digest_is_of_what_the_protocol_does() -> None:
    dossier = checked(SILENT)[1]
    other = checked(SILENT.replace("p20.aspirate(5", "p20.aspirate(6"))[1]
    assert dossier.digest != other.digest
    assert dossier.digest == examined.__wrapped__(SILENT)[1].digest


def test_a_flood_of_findings_is_cut() -> None:
    many = [finding("MODEL", ["4:A1"], [12], f"No. {n}") for n in range(500)]
    assert len(judged(SILENT, answer(findings=many)).report.findings) <= 12


def test_a_flood_of_proposals_is_cut() -> None:
    many = [proposal("ntc", ["4:H12"], 4, "no")] * 500
    assert len(read_opinion(answer(roles=many), checked(SILENT)[1], "m").proposals) <= 24


def test_an_answer_that_says_nothing_changes_nothing() -> None:
    report, dossier, reading = examined(CONTAMINATED)
    assert merge(report, read_opinion(answer(), dossier, "m"), reading) == report
