# expect: pcr warn PCR-6
"""The mix for three replicates is meant for the first well of each row, and stays there."""

metadata = {"protocolName": "qPCR in triplicate", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (1, 4)]
    tips300 = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips300])
    master_mix = rack["A1"]
    template_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 6, "template")
    first, *others = plate.rows()[0][:3]

    p300.transfer(60, master_mix, plate.columns()[0], new_tip="once")
    for column in plate.columns()[1:3]:
        p300.transfer(20, master_mix, column, new_tip="once")
    for column in (first, *others):
        m20.transfer(4, template_plate["A1"], column)
