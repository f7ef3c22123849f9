# expect: pcr warn PCR-1
"""Melting curves of proteins in the qPCR machine: what a comment calls a mix makes no error."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR melting curves"}


def run(protocol):
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 2)
    pcr1 = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    samples = [rack["B1"]]
    # sybr mix to the upper wells
    p20.pick_up_tip()
    for row in range(4):
        p20.aspirate(10, rack["A1"])
        p20.dispense(10, pcr1.rows()[row][0])
    p20.drop_tip()
    for row in range(8):
        p20.pick_up_tip()
        p20.aspirate(10, samples[0])
        p20.dispense(10, pcr1.rows()[row][0])
        p20.drop_tip()
