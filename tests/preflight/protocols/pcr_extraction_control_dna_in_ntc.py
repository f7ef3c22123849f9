"""Parasites in stool, real-time PCR set-up the last eluate is that of no stool."""

metadata = {"apiLevel": "2.15"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "PCR plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    pip = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    mix = protocol.define_liquid("master mix", "with probe", "#00ff00")
    stool = protocol.define_liquid("stool DNA", "eluate", "#884400")
    water = protocol.define_liquid("water", "PCR grade", "#0000ff")
    rack["A1"].load_liquid(mix, 300)
    for tube in rack.rows()[1]:
        tube.load_liquid(stool, 60)
    rack["D6"].load_liquid(water, 500)

    eluates = rack.rows()[1]
    negative_extraction_control = plate["F1"]
    ntc = plate["G1"]
    pip.transfer(15, rack["A1"], plate.columns()[0][:7])
    pip.transfer(5, eluates[0], ntc)
    for eluate, well in zip(eluates, plate.columns()[0]):
        pip.transfer(5, eluate, well, mix_after=(2, 10))
