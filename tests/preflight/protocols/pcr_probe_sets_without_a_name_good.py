# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "Multiplex assay, probe sets in tubes", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    # KAPA 2x in A1, water in A2, control plasmid in A3
    kapa, water, positive_control = tubes["A1"], tubes["A2"], tubes["A3"]
    n1, n2, rp = tubes["B1"], tubes["B2"], tubes["B3"]
    rna = tubes.rows()[2][:4]
    for k, probe in enumerate((n1, n2, rp)):
        row = plate.rows()[k]
        p20.transfer(10, kapa, row[:6], new_tip="once")
        p20.transfer(5, probe, row[:6], new_tip="once")
    for i, tube in enumerate(rna):
        p20.transfer(5, tube, [plate.rows()[k][i] for k in range(3)], new_tip="always")
    p20.transfer(5, positive_control, [plate.rows()[k][4] for k in range(3)], new_tip="always")
    p20.transfer(5, water, [plate.rows()[k][5] for k in range(3)], new_tip="once")
