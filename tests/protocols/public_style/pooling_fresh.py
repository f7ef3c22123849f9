metadata = {'protocolName': 'Library pool', 'author': 'seq', 'apiLevel': '2.8'}
VOLS = {'A1': 3.1, 'B1': 4.6, 'C1': 2.2, 'D1': 7.9, 'E1': 5.0, 'F1': 3.3, 'G1': 11.4, 'H1': 2.8}


def run(ctx):
    libs = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '2')
    pool = ctx.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', '5')['A1']
    tips = ctx.load_labware('opentrons_96_filtertiprack_20ul', '3')
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=[tips])
    for w, v in VOLS.items():
        p20.transfer(v, libs[w], pool, new_tip='always', blow_out=True, blowout_location='destination well')
    p20.pick_up_tip()
    p20.mix(10, 20, pool)
    p20.drop_tip()
