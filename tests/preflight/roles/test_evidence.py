"""What a role's evidence is worth: comments alone never stop a run, conflicts are told."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.preflight import Database, Options, Report, Script, check_script, load_database
from aegis_ot.vocabulary import VerdictWord

PROTOCOL = """
metadata = {{"protocolName": "PCR set-up", "apiLevel": "2.15"}}
{docstring}

def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4, "{label}")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
    master_mix = rack["A1"]
    template = rack["B1"]
    {before}
    p20.transfer(15, master_mix, [plate["A1"], plate["H12"]])
    p20.pick_up_tip()
    for well in (plate["A1"], plate["H12"]):
        p20.aspirate(5, template)
        p20.dispense(2.5, plate["A1"])
        p20.mix(2, 5, well)
        p20.blow_out(plate["A1"])
    p20.drop_tip()
"""


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


def check(database: Database, docstring: str = "", before: str = "pass", label: str = "") -> Report:
    text = PROTOCOL.format(docstring=docstring, before=before, label=label or "PCR plate")
    return check_script(Script(text, "p.py"), database, Options(select=("PCR-2",)))


def test_a_name_for_the_control_makes_carry_over_an_error(database: Database) -> None:
    report = check(database, before='ntc = plate["H12"]')
    assert report.verdict is VerdictWord.FAIL
    assert "comment" not in report.findings[0].message


@pytest.mark.parametrize(
    "said",
    [{"docstring": "# NTC in H12"}, {"before": 'last = plate["H12"]  # NTC'}],
    ids=["a comment that names the well", "a comment beside an assignment"],
)
def test_a_comment_alone_makes_it_a_warning_that_says_so(database: Database, said) -> None:
    report = check(database, **said)
    assert report.verdict is VerdictWord.WARN
    (finding,) = report.findings
    assert finding.rule == "PCR-2"
    assert "Only a comment says so" in finding.message
    assert "NTC" in finding.message


def test_a_comment_beside_a_name_changes_nothing(database: Database) -> None:
    report = check(database, docstring="# NTC in H12", before='ntc = plate["H12"]')
    assert report.verdict is VerdictWord.FAIL


def test_no_word_at_all_leaves_the_rule_open(database: Database) -> None:
    report = check(database)
    assert report.findings == ()
    assert [question.rule for question in report.undecided] == ["PCR-2"]


def test_evidence_that_conflicts_is_told_once_for_all_its_wells(database: Database) -> None:
    report = check(database, before='ntc = plate["H12"]; positive_control = plate["H12"]')
    told = [remark.message for remark in report.remarks]
    assert len(told) == 1
    assert "4:H12" in told[0]
    assert "`ntc`" in told[0]
    assert "`positive_control`" in told[0]


def test_what_is_said_of_all_doses_alike_is_no_dose(database: Database) -> None:
    path = Path(__file__).parent.parent / "protocols" / "cell_doses_of_a_dataclass_falling.py"
    text = path.read_text(encoding="utf-8")
    for said, untold in (("500.0", "'north'"), ("50.0", "'east'"), ("5.0", "'south'")):
        text = text.replace(f"Arm({said}", f"Arm({untold}")
    report = check_script(Script(text, "p.py"), database, Options(select=("CELL-4",)))
    assert report.findings == ()
    assert [question.rule for question in report.undecided] == ["CELL-4"]
