"""Bradford in a 384-well plate, 8-channel.

Standards (columns 1-2 of the standard plate, blank in A1 ... top in H1) and sixteen samples.
The multi-channel serves every other row of a 384-well plate, so column 1 takes the standards
in rows A, C, E ... and the samples follow in columns 3 and 5.
"""
from opentrons import protocol_api

metadata = {"protocolName": "384-well Bradford", "author": "Structural biology", "apiLevel": "2.15"}
REPLICATE_OFFSETS = ("A", "B")  # starting rows of the two replicates


def run(ctx: protocol_api.ProtocolContext):
    protein = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, label="Standards and samples")
    assay = ctx.load_labware("corning_384_wellplate_112ul_flat", 2, label="384 assay plate")
    dye_trough = ctx.load_labware("nest_12_reservoir_15ml", 3, label="Coomassie reagent")
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 5)
    t300 = ctx.load_labware("opentrons_96_tiprack_300ul", 6)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[t20])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[t300])

    bsa_ug_ml = [0, 25, 50, 100, 200, 400, 600, 800]
    for conc, well in zip(bsa_ug_ml, protein.columns()[0]):
        name = f"BSA {conc} ug/mL" if conc else "Blank (PBS)"
        well.load_liquid(ctx.define_liquid(name, "standard", "#7777ff"), 100)
    lysate = ctx.define_liquid("Sample", "clarified lysate", "#ffaa55")
    for well in protein.columns()[1] + protein.columns()[2]:
        well.load_liquid(lysate, 80)
    dye = dye_trough["A1"]
    dye.load_liquid(ctx.define_liquid("Bradford dye", "1x", "#0000aa"), 10000)

    targets = []
    for protein_column, assay_column in ((0, 1), (1, 3), (2, 5)):
        wells = [assay[f"{row}{assay_column}"] for row in REPLICATE_OFFSETS]
        m20.distribute(4, protein.columns()[protein_column][0], wells, disposal_volume=1)
        targets += wells

    m300.transfer(76, dye, targets, mix_after=(4, 40), blow_out=True, blowout_location="destination well", new_tip="always")
    ctx.delay(minutes=5)
