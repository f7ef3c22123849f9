# expect: bradford pass BRD-1! BRD-2! BRD-3!
"""Total protein of moss extracts, Coomassie in a plate

Slot 2: tube rack, moss extracts
Slot 3: tube rack, albumin
Slot 6: trough with the dye
Slot 1: plate

Slot 3: A1 = 0, A2 = 0.25, A3 = 0.5, A4 = 1 mg/mL
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    q = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    r = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    s = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    w = protocol.load_labware("nest_1_reservoir_195ml", 6)
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    p20.transfer(8, s.rows()[0][:4], q.rows()[0][:4], new_tip="always")
    p20.transfer(8, r.rows()[1], q.rows()[1][:6], new_tip="always")
    for well in q.rows()[0][:4] + q.rows()[1][:6]:
        p300.transfer(240, w["A1"], well, mix_after=(3, 120), new_tip="always")
