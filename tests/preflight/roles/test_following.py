"""A name at a source is worth what it says of the wells that its liquid goes to."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.judging import Report, judge
from aegis_ot.vocabulary import Severity

from ..reading import read

PCR = """
    mix = tubes["A1"]
    dna = tubes["A2"]
    {tube} = tubes["A3"]
    water = tubes["A4"]
    p20.transfer(10, mix, plate.columns()[0], new_tip="once")
"""
CELLS = """
    cells = protocol.define_liquid("MCF7 cells", "", "#ffffff")
    for well in plate.columns()[0]:
        well.load_liquid(cells, 100)
    tubes["B1"].load_liquid(protocol.define_liquid("cisplatin 20 uM", "", "#ffffff"), 500)
    tubes["B2"].load_liquid(protocol.define_liquid("{vehicle}", "", "#ffffff"), 500)
"""


def _judged(body: str, assay: str = "pcr") -> Report:
    return judge(read(body, assay=assay))


def _errors(report: Report) -> dict[str, set[str]]:
    return {
        finding.rule: {well.address for well in finding.wells}
        for finding in report.findings
        if finding.severity is Severity.ERROR
    }


@pytest.mark.parametrize("tube", ["ntc", "h2o_ntc", "neg_control", "blank", "no_template"])
def test_the_wells_of_a_controls_tube_are_the_control(tube: str) -> None:
    begun = PCR.format(tube=tube)
    body = f"{begun}    p20.transfer(5, {tube}, [plate['G1'], plate['H1']])\n"
    wrong = _judged(body + "    p20.transfer(5, dna, plate.columns()[0][:7], new_tip='always')")
    right = _judged(body + "    p20.transfer(5, dna, plate.columns()[0][:6], new_tip='always')")
    assert "1:G1" in _errors(wrong)["PCR-4"]
    assert not right.findings
    assert {"PCR-2", "PCR-4"} <= set(right.judged)


def test_a_control_made_in_a_tube_of_its_own_goes_on_to_its_wells() -> None:
    begun = PCR.format(tube="ntc")
    report = _judged(
        f"""{begun}
    p20.transfer(10, ntc, tubes["B1"])
    p20.transfer(5, tubes["B1"], [plate["G1"], plate["H1"]], new_tip="always")
    p20.transfer(5, dna, [plate["A1"], plate["H1"]], new_tip="always")
"""
    )
    assert "1:H1" in _errors(report)["PCR-4"]


def test_a_pool_that_the_control_goes_into_is_no_control() -> None:
    begun = PCR.format(tube="ntc")
    report = _judged(
        f"""{begun}
    p20.transfer(5, ntc, plate["H1"])
    p20.transfer(5, dna, plate.columns()[0][:7], new_tip="always")
    p20.transfer(2, plate.columns()[0], tubes["D6"], new_tip="always")
"""
    )
    assert "PCR-4" not in _errors(report)


def test_a_tube_of_which_all_wells_are_given_is_water_whatever_it_is_called() -> None:
    begun = PCR.format(tube="ntc_water")
    report = _judged(
        f"""{begun}
    p20.transfer(5, ntc_water, plate.columns()[0], new_tip="always")
    p20.transfer(5, dna, plate.columns()[0][:7], new_tip="always")
"""
    )
    assert not report.findings
    assert {"PCR-2", "PCR-4"} <= {undecided.rule for undecided in report.undecided}


def test_a_tube_whose_liquid_goes_nowhere_tells_no_control() -> None:
    begun = PCR.format(tube="ntc")
    report = _judged(f"{begun}    p20.transfer(5, dna, plate.columns()[0], new_tip='always')")
    assert {"PCR-2", "PCR-4"} <= {undecided.rule for undecided in report.undecided}


@pytest.mark.parametrize(
    ("name", "rules"),
    [("genomic DNA 7", {"PCR-2", "PCR-5"}), ("Positive control", {"PCR-2", "PCR-5"})],
)
def test_a_well_that_template_was_loaded_into_holds_template(name: str, rules: set[str]) -> None:
    report = _judged(
        f"""
        mix = tubes["A1"]
        held = protocol.define_liquid("{name}", "", "#ffffff")
        for well in plate.columns()[0][:4]:
            well.load_liquid(held, 5)
        for well in plate.columns()[0][4:]:
            well.load_liquid(protocol.define_liquid("H2O for the NTC", "", "#ffffff"), 5)
        p20.transfer(10, mix, plate.columns()[0], new_tip="once", mix_after=(2, 10))
        """
    )
    assert set(_errors(report)) == rules


def test_drug_in_the_wells_of_the_vehicle_control_is_told() -> None:
    report = _judged(
        CELLS.format(vehicle="Ethanol control (vehicle)")
        + """
    p20.transfer(10, tubes["B2"], plate.columns()[0][5:], new_tip="always")
    p20.transfer(10, tubes["B1"], plate.columns()[0], new_tip="always")
""",
        "cell_treatment",
    )
    assert {"1:F1", "1:G1", "1:H1"} <= _errors(report)["CELL-1"]


def test_vehicle_that_fills_up_the_wells_of_low_doses_makes_them_no_controls() -> None:
    report = _judged(
        CELLS.format(vehicle="DMSO")
        + """
    p20.transfer(10, tubes["B2"], plate.columns()[0][1:], new_tip="always")
    p20.transfer(10, tubes["B1"], plate.columns()[0][:7], new_tip="always")
""",
        "cell_treatment",
    )
    assert not report.findings
    assert "CELL-1" in {undecided.rule for undecided in report.undecided}


def test_wells_known_only_by_the_vehicle_that_they_get_do_not_show_that_all_get_it() -> None:
    report = _judged(
        CELLS.format(vehicle="DMSO vehicle control")
        + """
    p20.transfer(10, tubes["B2"], plate.columns()[0][6:7], new_tip="always")
    p20.transfer(10, tubes["B1"], plate.columns()[0][:6], new_tip="always")
""",
        "cell_treatment",
    )
    assert "CELL-2" in {undecided.rule for undecided in report.undecided}
