"""Which labware a plate map of the protocol speaks of."""

from __future__ import annotations

from aegis_ot.preflight import Database, Options, Script, check_script, load_database

TWO_PLATES = """
metadata = {"protocolName": "Two lines of cells, one map", "apiLevel": "2.13"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    upper = protocol.load_labware("corning_96_wellplate_360ul_flat", 4, "HT-29 cells")
    lower = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, "Caco-2 cells")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle, drug = tubes["A1"], tubes["A2"]
    layout = {}
    for entry in "B2+C2+D2=vehicle B3+C3+D3=drug".split():
        wells, kind = entry.split("=")
        layout[kind] = wells.split("+")
    for well in layout["vehicle"][SKIPPED:]:
        p20.transfer(5, vehicle, upper[well], new_tip="always")
        p20.transfer(5, vehicle, lower[well], new_tip="always")
    for well in layout["drug"]:
        p20.transfer(5, drug, upper[well], new_tip="always")
        p20.transfer(5, drug, lower[well], new_tip="always")
"""


def left_out(skipped: str, database: Database) -> set[tuple[str, str]]:
    """Slot and name of the vehicle controls that get no vehicle."""
    text = TWO_PLATES.replace("SKIPPED", skipped)
    report = check_script(Script(text, "p.py"), database, Options(select=("CELL-2",)))
    wells = {ref for finding in report.findings for ref in finding.wells}
    return {(ref.slot, ref.name) for ref in wells if ref.slot in ("4", "5")}


def test_a_map_that_two_plates_share_speaks_of_both_where_one_well_is_left_out() -> None:
    database = load_database()
    assert left_out("1", database) == {("4", "B2"), ("5", "B2")}
    assert left_out("0", database) == set()
