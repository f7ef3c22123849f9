"""``--all-parameters`` on a protocol with real parameters."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.preflight import load_rules
from aegis_ot.vocabulary import VerdictWord
from aegis_ot.workbench import CheckedProtocol, CheckSettings, check_files

PROTOCOL = """
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}
metadata = {"protocolName": "qPCR set-up with NTC"}


def add_parameters(p):
    p.add_bool(variable_name="late", display_name="late", default=False)
    p.add_str(variable_name="tips", display_name="tips", default="always",
              choices=[{"display_name": "fresh", "value": "always"},
                       {"display_name": "one", "value": "once"}])
    p.add_int(variable_name="repeats", display_name="free", default=1, minimum=1, maximum=1)


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", "1")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", "3", "qPCR plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    templates = tubes.wells()[8:10]
    reactions = plate.wells()[:2]
    ntc = plate["H12"]
    p20.transfer(15, master_mix, reactions + [ntc], new_tip="always")
    p20.transfer(5, water, ntc)
    if ctx.params.late{bad}:
        raise ValueError("not yet")
    p20.transfer(5, templates, reactions, new_tip=ctx.params.tips)
"""


@pytest.fixture(scope="module")
def explored(tmp_path_factory: pytest.TempPathFactory) -> dict[str, CheckedProtocol]:
    folder = tmp_path_factory.mktemp("parameters")
    files = []
    for name, bad in (("breaks.py", " and False"), ("refuses.py", "")):
        files.append(folder / name)
        files[-1].write_text(PROTOCOL.replace("{bad}", bad), encoding="utf-8")
    settings = CheckSettings(all_parameters=True, timeout_s=60)
    run = check_files(files, settings, load_rules())
    return {Path(checked.file).name: checked for checked in run.protocols}


def test_it_says_which_values_break_a_rule(explored: dict[str, CheckedProtocol]) -> None:
    checked = explored["breaks.py"]
    exploration = checked.exploration
    assert exploration is not None
    assert (exploration.runs, exploration.combinations) == (4, 4)
    assert [(b.rule, b.values, b.runs) for b in exploration.broken] == [("PCR-3", "tips=once", 2)]
    assert [f.message.split(":")[0] for f in checked.findings] == ["With tips=once"]
    assert checked.verdict is VerdictWord.FAIL
    assert exploration.not_varied[0].startswith("repeats")


def test_values_that_cannot_be_rehearsed_are_named_and_never_clean(
    explored: dict[str, CheckedProtocol],
) -> None:
    checked = explored["refuses.py"]
    assert checked.exploration is not None
    ((values, problem),) = checked.exploration.failures
    assert values == "late=True"
    assert problem.line == 26
    assert "not yet" in problem.message
    assert checked.verdict is VerdictWord.ERROR
