"""Bradford assay for eight membrane preps, triplicates.

Wells: columns 1-3 standards (rows A-H, 0 to 2000 ug/mL), columns 4-6 samples.
"""
from opentrons import protocol_api

metadata = {"protocolName": "Membrane protein Bradford", "apiLevel": "2.14", "author": "GPCR group"}

CURVE = {"A": 0, "B": 125, "C": 250, "D": 500, "E": 750, "F": 1000, "G": 1500, "H": 2000}


def run(ctx: protocol_api.ProtocolContext):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, label="Bradford plate")
    curve_plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, label="BSA curve")
    preps = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, label="Membrane preps")
    dye_box = ctx.load_labware("nest_1_reservoir_195ml", 5, label="Bradford dye")
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 7)
    t300 = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (8, 9)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=t300)

    dye = dye_box["A1"]
    for row, conc in CURVE.items():
        bsa = ctx.define_liquid(f"BSA standard {conc} ug/mL", "in lysis buffer", "#aaaaff")
        curve_plate[f"{row}1"].load_liquid(bsa, 100)
    sample = ctx.define_liquid("Sample", "solubilised membranes", "#ffbb88")
    for tube in preps.wells()[:8]:
        tube.load_liquid(sample, 100)

    standard_wells = {row: [plate[f"{row}{n}"] for n in (1, 2, 3)] for row in CURVE}
    sample_wells = {row: [plate[f"{row}{n}"] for n in (4, 5, 6)] for row in CURVE}

    p20.pick_up_tip()
    for row in sorted(CURVE, key=CURVE.get, reverse=True):
        for well in standard_wells[row]:
            p20.aspirate(6, curve_plate[f"{row}1"])
            p20.dispense(6, well)
    p20.drop_tip()

    for tube, row in zip(preps.wells(), CURVE):
        p20.pick_up_tip()
        for well in sample_wells[row]:
            p20.aspirate(6, tube)
            p20.dispense(6, well)
        p20.drop_tip()

    for number in range(1, 6):
        for well in plate.columns_by_name()[str(number)]:
            p300.transfer(240, dye, well, mix_after=(3, 150))
