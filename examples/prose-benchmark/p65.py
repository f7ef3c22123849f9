"""Protein of snail slime, Bradford

Samples: A1-A6 of the rack
Standards in the rack: D1 blank, D2 BSA 50, D3 BSA 100,
    D4 BSA 300, D5 BSA 900 ug/mL
Trough, slot 9: dye in A1
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    f = protocol.load_labware("corning_96_wellplate_360ul_flat", 6)
    v = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    u = protocol.load_labware("nest_12_reservoir_15ml", 9)
    t1 = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    t2 = protocol.load_labware("opentrons_96_tiprack_300ul", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t1])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t2])
    p20.pick_up_tip()
    for n in (0, 1, 3, 2, 4):
        p20.aspirate(10, v.rows()[3][n])
        p20.dispense(10, f.rows()[7][n])
    p20.drop_tip()
    p20.transfer(10, v.rows()[0], f.rows()[0][:6], new_tip="always")
    for well in f.rows()[7][:5] + f.rows()[0][:6]:
        p300.transfer(200, u["A1"], well, mix_after=(2, 100), new_tip="always")
