"""A dry run end to end: real guard, real sidecar over a socket, simulated camera."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.dryrun import TRUSTING, DryRunSettings, dry_run
from aegis_ot.errors import ConfigurationError, RehearsalError
from aegis_ot.reports.run_html import run_report_html
from aegis_ot.sidecar import make_analyser
from aegis_ot.sidecar.overview import runs_overview
from aegis_ot.sidecar.store import Store
from aegis_ot.vocabulary import KeyframeKind, Outcome, Route
from aegis_ot.workbench.engines import Engine

TEXT = """
metadata = {"apiLevel": "2.16"}
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "plate")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, "dye")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    red = protocol.define_liquid("red dye", "", "#ff0000")
    reservoir["A1"].load_liquid(red, 10000)
    for well in plate.wells()[:10]:
        p300.transfer(150, reservoir["A1"], well)
"""
SCRIPT = Script(TEXT, "ten_wells.py")


@pytest.fixture(scope="module")
def stopped():
    settings = DryRunSettings(faults=("no_dispense@1:A2",), on_fail="stop")
    return dry_run(SCRIPT, settings, make_analyser())


def test_a_normal_run_has_no_flagged_well():
    result = dry_run(SCRIPT, DryRunSettings(), make_analyser())
    assert result.outcome == "succeeded"
    assert [row.address for row in result.wells] == [
        *(f"1:{row}1" for row in "ABCDEFGH"), "1:A2", "1:B2",
    ]  # fmt: skip
    assert result.flagged == ()
    assert {row.route for row in result.wells[:6]} == {Route.CALIBRATION}


def test_a_liquid_that_no_well_shows_is_named():
    faults = tuple(f"no_aspirate@#{number}" for number in range(1, 11))
    result = dry_run(SCRIPT, DryRunSettings(faults), make_analyser(TRUSTING))
    assert "In no well was red dye seen to leave the tip of the left p300" in result.notes[0]
    assert result.notes[0] in run_report_html([result.reported])
    sound = dry_run(SCRIPT, DryRunSettings(), make_analyser(TRUSTING))
    assert sound.notes == ()


def test_a_question_that_nobody_answers_leaves_its_wells_undecided():
    """With ``no_aspirate`` in tests/cli/test_demo.py."""
    faults = tuple(f"no_dispense@#{number}" for number in range(1, 11))
    result = dry_run(SCRIPT, DryRunSettings(faults), make_analyser())
    assert {row.outcome for row in result.wells} == {Outcome.UNDECIDED}
    assert len(result.flagged) == 10
    assert "its wells stay undecided; --first-wells trust" in result.notes[0]


def test_layer_1_hears_what_the_guard_says_in_the_protocol():
    text = """from aegis_ot import guard
@guard(roles={"source": ["2:A1"]})
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    p300.transfer(150, reservoir["A1"], plate["A1"])
metadata = {"apiLevel": "2.16"}
"""
    told = dry_run(Script(text, "told.py"), DryRunSettings(), make_analyser())
    silent = dry_run(
        Script(text.replace('roles={"source": ["2:A1"]}', ""), "silent.py"),
        DryRunSettings(),
        make_analyser(),
    )
    assert told.report.roles != silent.report.roles
    assert "source" in {role.role for role in told.report.roles}


def test_a_planted_fault_stops_the_run_before_another_well_is_touched(stopped):
    assert stopped.outcome == "stopped"
    assert [row.address for row in stopped.flagged] == ["1:A2"]
    assert stopped.wells[-1].outcome is Outcome.FAIL
    assert stopped.touched_after_failure == ()
    assert "A2 of plate" in stopped.detail


def test_the_report_holds_the_four_frames_of_the_flagged_well(stopped):
    page = run_report_html([stopped.reported])
    (flagged,) = stopped.reported.flagged
    assert set(flagged.frames) == set(KeyframeKind)
    assert page.count("data:image/jpeg;base64,") == sum(
        f.tip is not None for f in flagged.frames.values()
    )
    assert "simulated" in page
    assert "A2: failed, no dispense" in page
    assert "Wells touched after the failed dispense: none." in page
    assert "http" not in page.replace("http-equiv", "")


def test_a_protocol_that_raises_tells_its_line():
    broken = Script(TEXT + '    plate["Z1"]\n', "broken.py")
    with pytest.raises(RehearsalError, match="line 12"):
        dry_run(broken, DryRunSettings(), make_analyser())


def test_a_protocol_that_ends_the_process_is_told():
    leaving = Script("import sys\n" + TEXT + "    sys.exit(0)\n", "leaving.py")
    with pytest.raises(RehearsalError, match=r"leaving.py, line 13: .*sys.exit"):
        dry_run(leaving, DryRunSettings(), make_analyser())


def test_a_protocol_that_does_not_end_is_told():
    endless = Script(TEXT + "    while True: pass\n", "endless.py")
    with pytest.raises(RehearsalError, match="did not end within 2 s"):
        dry_run(endless, DryRunSettings(timeout_s=2.0), make_analyser())


def test_a_fault_that_makes_no_sense_is_explained():
    with pytest.raises(ConfigurationError, match="explode"):
        dry_run(SCRIPT, DryRunSettings(faults=("explode@A1",)), make_analyser())


def test_a_fault_in_a_well_that_gets_nothing_is_refused():
    with pytest.raises(ConfigurationError, match="9:H9"):
        dry_run(SCRIPT, DryRunSettings(faults=("partial:50@9:H9",)), make_analyser())


def test_a_run_is_kept_where_that_is_asked_for(stopped, tmp_path):
    settings = DryRunSettings(faults=("no_dispense@1:A2",), on_fail="stop", data=tmp_path)
    result = dry_run(SCRIPT, settings, make_analyser())
    store = Store(tmp_path, alone=True)
    (row,) = runs_overview(store)
    assert row["run"] == result.reported.account["run"]
    assert row["finished"]["outcome"] == "aborted"
    assert row["wells"]["fail"] == 1
    assert row["layer1"]["verdict"] == result.report.verdict.value
    assert store.frame(row["run"], 0)
    store.close()
    assert [row.score for row in stopped.wells] == [row.score for row in result.wells]


@pytest.mark.parametrize("fault", ["partial:50", "no_dispense"])
def test_one_fault_on_a_tip_that_is_used_again_flags_one_well(fault):
    again = TEXT.replace(
        'for well in plate.wells()[:10]:\n        p300.transfer(150, reservoir["A1"], well)',
        'p300.transfer(120, reservoir["A1"], plate.wells()[:7], new_tip="once")',
    )
    assert "once" in again
    settings = DryRunSettings(faults=(f"{fault}@1:D1",))
    result = dry_run(Script(again, "one_tip.py"), settings, make_analyser())
    assert [row.address for row in result.flagged] == ["1:D1"]
    assert "as reported there" in result.wells[4].reason


def test_transient_faults_are_put_right_and_told():
    faults = ("no_aspirate@1:H1x1", "partial:50@1:B2x1")
    recover = {"no_aspirate": "retry", "partial_dispense": "top_up"}
    settings = DryRunSettings(faults=faults, recover=recover, on_fail="stop")
    result = dry_run(SCRIPT, settings, make_analyser())
    assert (result.outcome, result.flagged) == ("succeeded", ())
    right = [row for row in result.wells if row.recovered]
    assert [(row.address, row.failure.value) for row in right] == [
        ("1:H1", "no_aspirate"), ("1:B2", "partial_dispense"),
    ]  # fmt: skip
    topped_up = result.wells[-1]
    assert topped_up.address == "1:B2"
    assert topped_up.volume_ul == pytest.approx(75.0, abs=15.0)
    page = run_report_html([result.reported])
    assert "put right by delivery 8" in page


@pytest.mark.timeout(300)
def test_an_engine_runs_what_the_opentrons_here_does_not_take(monkeypatch, stopped):
    """Its interpreter is this one's: what is tested is the way there and back."""
    engine = Engine("9.0.0", (2, 28), sys.executable)
    monkeypatch.setattr("aegis_ot.dryrun.runner.engine_for", lambda need: engine)
    settings = DryRunSettings(faults=("no_dispense@1:A2",), on_fail="stop")
    result = dry_run(SCRIPT, settings, make_analyser())
    assert (result.outcome, result.detail) == (stopped.outcome, stopped.detail)
    assert [(row.address, row.outcome) for row in result.wells] == [
        (row.address, row.outcome) for row in stopped.wells
    ]
    assert result.touched_after_failure == stopped.touched_after_failure
    odd = Script('metadata = {"apiLevel": "2.16"}\ndef run(protocol):\n    1 / 0\n', "odd.py")
    with pytest.raises(RehearsalError, match=r"odd\.py, line 3: .*ZeroDivisionError"):
        dry_run(odd, settings, make_analyser())
    with pytest.raises(ConfigurationError, match=r"9\.0\.0, and the live page .*Leave --open out"):
        dry_run(SCRIPT, replace(settings, live=True), make_analyser())


def test_a_protocol_whose_engine_lacks_is_named_with_the_line_to_type(tmp_path, monkeypatch):
    monkeypatch.setenv("AEGIS_OT_ENGINES", str(tmp_path))
    newer = Script('metadata = {"apiLevel": "2.28"}\ndef run(protocol): ...\n', "newer.py")
    with pytest.raises(ConfigurationError, match=r"^newer\.py: .*aegis-ot engines install 9\.0\.0"):
        dry_run(newer, DryRunSettings(), make_analyser())
