# expect: bradford pass BRD-1! BRD-2! BRD-3!
"""
Protein in urine, Coomassie

   Material             Position                Amount
   ------------------------------------------------------
   Coomassie            trough in slot 7, A1    20 mL
   saline (blank)       rack in slot 4, D1      300 uL
   albumin 0.1 mg/mL    rack in slot 4, D2      300 uL
   albumin 0.3 mg/mL    rack in slot 4, D3      300 uL
   albumin 0.9 mg/mL    rack in slot 4, D4      300 uL
   urines 1 to 6        rack in slot 4, B1-B6   150 uL
"""

metadata = {"protocolName": "Urine", "apiLevel": "2.13"}


def run(protocol):
    reader = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    rk = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tg = protocol.load_labware("nest_12_reservoir_15ml", 7)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 8)
    more = protocol.load_labware("opentrons_96_tiprack_300ul", 9)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[more])

    p20.pick_up_tip()
    for a, b in zip(rk.rows()[3][:4], reader.rows()[0]):
        p20.aspirate(10, a)
        p20.dispense(10, b)
    p20.drop_tip()
    for a, b in zip(rk.rows()[1], reader.rows()[2]):
        p20.transfer(10, a, b)
    for b in reader.rows()[0][:4] + reader.rows()[2][:6]:
        p300.transfer(190, tg["A1"], b, mix_after=(3, 100), new_tip="always")
