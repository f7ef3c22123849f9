# expect: pcr pass
"""PCR from a chip: the master mix is made of four tubes, DNA polymerase last."""

metadata = {"apiLevel": "2.13", "protocolName": "PCR prep"}


def run(ctx):
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", tip_racks=[ctx.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    p300 = ctx.load_instrument(
        "p300_single_gen2", "right", tip_racks=[ctx.load_labware("opentrons_96_tiprack_300ul", 5)]
    )
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_2ml_screwcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    h2o, rxn_buffer, primer, dna_pol, mix_tube = tubes.wells()[:5]
    samples = tubes.columns()[3]
    reactions = plate.columns()[0][:4]
    for volume, source in ((75, h2o), (25, rxn_buffer), (25, primer)):
        p300.transfer(volume, source, mix_tube.top())
    p20.pick_up_tip()
    p20.transfer(2, dna_pol, mix_tube, new_tip="never")
    p20.mix(10, 20, mix_tube)
    p20.drop_tip()
    p20.transfer(20, mix_tube, reactions, new_tip="once")
    p20.transfer(3, samples, reactions, new_tip="always")
