# expect: pcr pass PCR-1! PCR-6!
"""PCR with the template diluted in the same plate: column 1 dilutions, column 3 reactions."""

metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}


def run(protocol):
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    dna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "DNA templates")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, water = rack["D6"], rack["D5"]
    diluted, reactions, ntc = plate.columns()[0][:4], plate.columns()[2][:4], plate["H3"]
    p20.transfer(18, water, diluted, new_tip="once")
    p20.transfer(2, dna.wells()[:4], diluted, new_tip="always", mix_after=(3, 10))
    p20.transfer(18, master_mix, [*reactions, ntc], new_tip="always")
    p20.transfer(2, diluted, reactions, new_tip="always", mix_after=(3, 10))
    p20.transfer(2, water, ntc)
