# expect: pcr pass
"""
Time 0: NTC is pipetted first.
"""
metadata = {'apiLevel': '2.13'}
CYCLES_BEFORE_STOP = {"A1": 0, "A2": 5, "A3": 10, "A4": 15}

def run(ctx):
    tips = [ctx.load_labware('opentrons_96_tiprack_20ul', s) for s in ('10', '11')]
    pcr = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1', 'PCR plate')
    dna = ctx.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '2', 'DNA')
    mm = ctx.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '5', 'mixes')
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=tips)

    master_mix, water = mm['A1'], mm['B1']
    ntc = pcr['H1']
    p20.transfer(15, master_mix, ntc)
    p20.transfer(5, water, ntc)
    for name in CYCLES_BEFORE_STOP:
        p20.transfer(15, master_mix, pcr[name], new_tip='always')
        p20.transfer(5, dna['A1'], pcr[name], new_tip='always')
