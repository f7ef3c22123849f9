# expect: cell_treatment fail CELL-1 CELL-2
"""Blocking antibody on a co-culture; whole columns."""

metadata = {"apiLevel": "2.15"}

# column -> (what, lane)
COLUMNS = {
    1: ("none", None),
    2: ("vehicle", "A1"),
    3: ("drug", "A3"),
    4: ("drug", "A4"),
    5: ("vehicle", "A1"),
    6: ("drug", "A3"),
    7: ("drug", "A4"),
}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    lanes = protocol.load_labware("nest_12_reservoir_15ml", "2", "antibodies")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "3", "co-culture cells")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    for wanted in ("vehicle", "drug"):
        for number, (what, lane) in COLUMNS.items():
            if what == wanted:
                m300.transfer(
                    30, lanes[lane if number != 5 else "A3"], cells[f"A{number}"], new_tip="always"
                )
