# expect: generic pass
"""Set up restriction digests: the mix is made in the run and shared out."""

metadata = {"apiLevel": "2.13", "protocolName": "EcoRI digests"}
DIGESTS = 20


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "reagents")
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    buffer, enzyme = rack["A1"], rack["A2"]
    mix = rack["D1"]  # empty tube

    n = DIGESTS + 3
    p300.transfer(n * 20, buffer, mix, new_tip="once")
    p300.transfer(n * 5, enzyme, mix, new_tip="once", mix_after=(5, 150))
    p300.distribute(25, mix, plate.wells()[:DIGESTS], disposal_volume=10, new_tip="once")
