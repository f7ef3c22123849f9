"""Bead clean-up: what the sample wells hold is not declared, the ethanol goes in deep."""

metadata = {"protocolName": "Bead cleanup", "apiLevel": "2.14"}


def run(protocol):
    racks = [protocol.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (7, 8)]
    sample_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 1, "sample plate")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
    waste = protocol.load_labware("nest_1_reservoir_195ml", 3, "waste")["A1"]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=racks)
    bead_liquid = protocol.define_liquid("beads", "SPRI beads", "#885500")
    ethanol_liquid = protocol.define_liquid("ethanol", "80 %", "#0000FF")
    reservoir["A1"].load_liquid(bead_liquid, 8000)
    reservoir["A2"].load_liquid(ethanol_liquid, 12000)
    columns = sample_plate.rows()[0][:4]

    for column in columns:
        m300.transfer(100, reservoir["A1"], column, mix_after=(5, 150))
    for column in columns:
        m300.transfer(190, column, waste.top())
    m300.pick_up_tip()
    for column in columns:
        m300.aspirate(180, reservoir["A2"])
        m300.dispense(180, column.bottom(1))
    m300.drop_tip()
