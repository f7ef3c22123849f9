# expect: pcr pass PCR-4!
"""Mycoplasma test of six cultures.

The strip stands in column 1 of the plate:

   A  culture 1      E  culture 5
   B  culture 2      F  culture 6
   C  culture 3      G  positive control
   D  culture 4      H  no template
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "7")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "1", "plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    strip = plate.columns()[0]
    master_mix, water, genome = rack["C5"], rack["C6"], rack["D6"]
    for well in strip:
        p20.transfer(18, master_mix, well, new_tip="always")
    for supernatant, well in zip(rack.wells()[:6], strip):
        p20.transfer(2, supernatant, well, new_tip="always")
    p20.transfer(2, genome, strip[6])
    p20.transfer(2, water, strip[7])
