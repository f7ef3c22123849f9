# expect: pcr warn PCR-4
"""Sex of chicks from feathers, real-time PCR

3. Labware
3.1 Optical plate (slot 7, full skirt)
3.2 Chilled tubes (slot 5, 24 places)
3.3 Feather block (slot 4, half skirt)

4. Contents
4.1 Chilled tubes
    A1  master mix with probe, 400 uL
    B1  water
4.2 Feather block
    A1-F1  DNA of six feathers
4.3 Optical plate
    A1-F1  feathers
    G1     NTC
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    x = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 7)
    y = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    z = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4)
    t = ctx.load_labware("opentrons_96_filtertiprack_20ul", 9)
    p = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[t])
    p.transfer(16, y["A1"], x.columns()[0][:7], new_tip="once")
    p.transfer(4, z["F1"], x["G1"])
    for k in range(6):
        p.transfer(4, z.wells()[k], x.wells()[k], mix_after=(2, 10))
