# expect: pcr pass
"""
qPCR. Well codes: C = calibrator, D = DNA of the patient, B = no-template blank.
Columns 1-2 D, column 3 C, column 4 B, rows A to D.
"""
metadata = {'apiLevel': '2.13'}
PLATE_ROWS = "ABCDEFGH"

def run(ctx):
    tips = [ctx.load_labware('opentrons_96_tiprack_20ul', s) for s in ('10', '11')]
    pcr = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1', 'PCR plate')
    dna = ctx.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '2', 'DNA')
    mm = ctx.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '5', 'mixes')
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=tips)

    master_mix, water = mm['A1'], mm['B1']
    for i, letter in enumerate(PLATE_ROWS[:4]):
        for column, tube in ((1, dna.rows()[i][0]), (2, dna.rows()[i][1]), (3, dna['D6']), (4, water)):
            p20.transfer(15, master_mix, pcr[f"{letter}{column}"], new_tip='always')
            p20.transfer(5, tube, pcr[f"{letter}{column}"], new_tip='always')
