metadata = {'protocolName': 'qPCR probe matrix', 'apiLevel': '2.12'}


def run(ctx):
    tubes = ctx.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', '1')
    reagents = ctx.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', '2')
    plate = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '3')
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5')]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    master_mix = tubes['D1']
    dna = reagents['A4']
    probes = [reagents[n] for n in ('B1', 'B2', 'B3')]
    dna_mixes = [tubes[n] for n in ('C1', 'C2', 'C3')]

    # all that is made from here on gets the same DNA, so it goes into the mix
    p300.transfer(50, dna, master_mix, mix_after=(3, 50))
    for probe, mix in zip(probes, dna_mixes):
        p300.transfer(100, master_mix, mix, new_tip='always')
        p300.transfer(20, probe, mix, mix_after=(3, 50), new_tip='always')
    for mix, row in zip(dna_mixes, plate.rows()):
        p300.distribute(20, mix, row[:3], disposal_volume=0)
