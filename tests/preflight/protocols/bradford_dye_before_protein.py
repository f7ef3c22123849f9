"""DC protein assay: the dye stands in the wells, and the protein comes after it."""

metadata = {"apiLevel": "2.15", "protocolName": "DC protein assay"}


def run(protocol):
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=racks)
    reagent_a = protocol.define_liquid("Reagent A", "alkaline copper", "#0000FF")
    dye = protocol.define_liquid("Dye", "Folin dye reagent", "#FF0000")
    trough["A1"].load_liquid(reagent_a, 9000)
    trough["A2"].load_liquid(dye, 9000)
    samples = tubes.wells()[:6]
    wells = plate.columns()[0][:6]
    p.distribute(200, trough["A2"], wells, disposal_volume=0)
    for sample, well in zip(samples, wells):
        p.transfer(25, sample, well, mix_after=(3, 100), new_tip="always")
