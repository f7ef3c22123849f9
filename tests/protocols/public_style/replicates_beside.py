metadata = {'protocolName': 'RNA dilution and plating in triplicate', 'apiLevel': '2.12'}


def run(ctx):
    rna = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '1', 'rna plate')
    final = ctx.load_labware('corning_96_wellplate_360ul_flat', '3', 'final plate')
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5')]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=tips)
    diluent = res['A1']
    sets = [col[i:i + 3] for col in final.columns()[:4] for i in (0, 3)]

    p300.pick_up_tip()
    for first, _, _ in sets:
        p300.transfer(180, diluent, first, new_tip='never')
    p300.drop_tip()
    for source, (first, _, _) in zip(rna.wells(), sets):
        p300.pick_up_tip()
        p300.transfer(20, source, first, mix_after=(3, 100), new_tip='never')
        p300.drop_tip()
    for first, second, third in sets:
        p300.pick_up_tip()
        p300.mix(3, 50, first)
        p300.transfer(50, first, [second, third], new_tip='never')
        p300.drop_tip()
