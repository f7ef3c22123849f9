# expect: pcr pass
"""The rest of each row is filled with buffer, so that no well of the reader stays dry."""

metadata = {"protocolName": "Droplet PCR", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 4)]
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, buffer, water = tubes["A1"], tubes["A2"], tubes["A3"]
    dna = tubes.rows()[1][:5]
    reactions, ntc = plate.wells()[:5], plate["F1"]
    blanks = plate.wells()[6:8]
    p20.transfer(16, master_mix, [*reactions, ntc], new_tip="once")
    p20.transfer(4, dna, reactions, new_tip="always")
    p20.transfer(4, water, ntc)
    p20.transfer(20, buffer, blanks, new_tip="once")
