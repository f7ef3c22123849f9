# expect: cell_treatment pass
metadata = {"protocolName": "P. aeruginosa biofilm, MBEC", "apiLevel": "2.11"}


def run(protocol):
    """24 h biofilms in the plate. Rows C and D: one each, row A none."""
    rows = protocol.load_labware("corning_96_wellplate_360ul_flat", 4, "biofilm plate").rows()
    abx = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5, "stocks")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    broth, tobra, genta = abx["A1"], abx["B1"], abx["B2"]
    growth_control = rows[0][:6]
    for well in growth_control:
        p300.transfer(100, broth, well, new_tip="always")
    for tube, row in ((tobra, rows[2]), (genta, rows[3])):
        for well in row[:6]:
            p300.transfer(100, tube, well, new_tip="always")
