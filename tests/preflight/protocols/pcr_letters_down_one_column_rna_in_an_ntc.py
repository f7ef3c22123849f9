# expect: pcr warn PCR-4
# Virus RNA by RT-qPCR, one strip of the plate only.
# PCR plate, column 6: A-D samples, E-F mock, G-H water (NTC)

metadata = {"protocolName": "RT-qPCR strip", "apiLevel": "2.11"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "3")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "6")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "9")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    strip = plate.columns_by_name()["6"]
    rna, water = tubes.wells()[:7], tubes["C6"]

    p20.distribute(15, tubes["D6"], strip, new_tip="once")  # master mix
    for tube, well in zip(rna, strip):
        p20.transfer(5, tube, well, new_tip="always")
    p20.transfer(5, water, strip[7:], new_tip="always")
