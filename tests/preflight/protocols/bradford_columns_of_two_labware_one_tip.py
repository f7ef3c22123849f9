# expect: bradford fail BRD-2
"""Protein in yoghurt serum (Bradford).

                vials (slot 3)          microplate (slot 1)
  ovalbumin     B1 0, B2 0.2,           C1, C2,
                B3 0.6 mg/mL            C3
  yoghurts      D1 ... D6               F1 ... F6

The dye stands in the trough.
"""

metadata = {"protocolName": "Yoghurt", "apiLevel": "2.13"}


def run(protocol):
    to = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    fr = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    dye = protocol.load_labware("nest_1_reservoir_195ml", 6)["A1"]
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 8)
    more = protocol.load_labware("opentrons_96_tiprack_300ul", 9)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[more])

    p20.transfer(10, fr.rows()[1][:3], to.rows()[2][:3], new_tip="once")
    p20.transfer(10, fr.rows()[3][:6], to.rows()[5][:6], new_tip="once")
    for well in to.rows()[2][:3] + to.rows()[5][:6]:
        p300.transfer(190, dye, well, mix_after=(3, 100), new_tip="always")
