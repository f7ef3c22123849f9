# expect: cell_treatment pass CELL-1!
"""LPS on RAW 264.7 macrophages, cytokines after 6 h."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1", "RAW 264.7")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    lps = rack["A1"]
    no_lps = cells.columns()[0]
    with_lps = cells.columns()[1] + cells.columns()[2]
    for well in with_lps:
        p300.transfer(50, lps, well, new_tip="always")
