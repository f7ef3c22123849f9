# expect: bradford pass
"""Standards by column number, one set of tips from the first column to the last."""

metadata = {"apiLevel": "2.15", "protocolName": "Bradford"}
STD = {1: 0, 2: 125, 3: 250, 4: 500, 5: 1000, 6: 2000}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    std_rack = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 7)
    dye = protocol.load_labware("nest_12_reservoir_15ml", 5)["A1"]
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    t300 = protocol.load_labware("opentrons_96_tiprack_300ul", 8)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[t300])
    m20.pick_up_tip()
    for c in sorted(STD):
        m20.aspirate(5, std_rack["A%d" % c])
        m20.dispense(5, plate["A%d" % c])
    m20.drop_tip()
    for c in STD:
        m300.transfer(200, dye, plate["A{}".format(c)], mix_after=(3, 100), new_tip="always")
