# expect: pcr fail PCR-5 PCR-3
"""An internal control is put into the mix on purpose; then the tip comes back from the samples."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR with internal control"}


def run(protocol):
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    p300 = protocol.load_instrument(
        "p300_single_gen2",
        "right",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 5)],
    )
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    master_mix, control_dna = rack["A1"], rack["A2"]
    samples = rack.columns()[3]
    wells = plate.columns()[0][:4]
    p20.transfer(10, control_dna, master_mix, mix_after=(3, 20))
    for sample, well in zip(samples, wells):
        p20.transfer(5, sample, well)
    p300.pick_up_tip()
    for well in wells:
        p300.aspirate(20, master_mix)
        p300.dispense(20, well)
        p300.mix(3, 20, well)
    p300.drop_tip()
