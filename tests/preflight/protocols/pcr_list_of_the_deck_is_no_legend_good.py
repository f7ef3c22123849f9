# expect: pcr pass
"""Species PCR for eel bits.

1 DNA plate, 2 PCR plate, 3 reservoir
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1)
    pcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    box = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[box])

    ntc = pcr["A4"]
    m20.pick_up_tip()
    for column in range(4):
        m20.transfer(9, trough["A1"], pcr.columns()[column][0], new_tip="never")
    m20.drop_tip()
    m20.pick_up_tip()
    for column in range(4):
        m20.transfer(9, trough["A2"], pcr.columns()[column][0].top(), new_tip="never")
    m20.drop_tip()
    for column in range(3):
        m20.transfer(2, dna.columns()[column][0], pcr.columns()[column][0], new_tip="always")
    m20.transfer(2, trough["A12"], ntc)
