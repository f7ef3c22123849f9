# expect: pcr fail PCR-2 PCR-5
"""PCR, written in few lines."""

metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}


def run(protocol):
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "reagents")
    dna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "DNA templates")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = rack["D6"], rack["D5"]
    ntc = plate["C1"]
    p20.transfer(18, master_mix, plate.wells()[:3], new_tip="always")
    p20.transfer(2, dna["B1"], plate["B1"])
    p20.pick_up_tip()
    p20.aspirate(2, dna["A1"]); p20.dispense(2, plate["A1"]); p20.aspirate(2, water); p20.dispense(2, ntc)
    p20.drop_tip()
