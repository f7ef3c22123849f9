"""What must not be given to a control; what it is given may be unknown."""

from __future__ import annotations

from aegis_ot.preflight import Report, Script, check_script, load_rules

PROTOCOL = '''"""Two loci on four extracts; what differs between the loci is in D5 and D6."""

metadata = {{"apiLevel": "2.15"}}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = rack["A1"], rack["B1"]
    templates = rack.columns()[1]
    reactions = plate.wells()[:4]
    ntc_wells = [plate["H1"], plate["H2"]]
    spare = [plate["G1"], plate["G2"]]
    for well in reactions + spare + ntc_wells:
        p20.transfer(10, master_mix, well.top(-1), new_tip="always")
    for template, well in zip(templates, reactions):
        p20.transfer(4, template, well, mix_after=(2, 5), new_tip="always")
    p20.transfer(4, water, ntc_wells, new_tip="always")
    p20.transfer(2, rack["D6"], {first}, mix_after=(2, 5), new_tip="always")
    p20.transfer(2, rack["D5"], {second}, mix_after=(2, 5), new_tip="always")
'''


def _undecided(first: str, second: str) -> dict[str, str]:
    report: Report = check_script(
        Script(PROTOCOL.format(first=first, second=second), "loci.py"), load_rules()
    )
    assert not [found for found in report.findings if found.rule != "PCR-6"]
    return {undecided.rule: undecided.reason for undecided in report.undecided}


def test_an_unknown_tube_in_the_templates_place_leaves_it_open_in_a_control() -> None:
    reason = _undecided("[spare[0], ntc_wells[0]]", "reactions")["PCR-4"]
    assert "D6" in reason
    assert "H1" in reason


def test_what_goes_into_all_wells_or_into_controls_alone_leaves_nothing_open() -> None:
    assert "PCR-4" not in _undecided("reactions + spare + ntc_wells", "reactions")
    assert "PCR-4" not in _undecided("ntc_wells", "reactions + spare")


def test_nor_does_what_goes_where_template_goes_as_well() -> None:
    assert "PCR-4" not in _undecided("[reactions[0], ntc_wells[0]]", "[*reactions[1:], *spare]")
