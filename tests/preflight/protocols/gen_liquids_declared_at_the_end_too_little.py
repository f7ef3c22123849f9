"""What stands where is declared after the last command, and it is too little."""

metadata = {"apiLevel": "2.20", "protocolName": "Enzyme addition"}


def run(protocol):
    p300 = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 1)],
    )
    enzyme = protocol.load_labware("nest_12_reservoir_15ml", 2)["A1"]
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "Sample Plate")
    for well in plate.rows()[0][:3]:
        p300.pick_up_tip()
        p300.aspirate(30, enzyme)
        p300.dispense(30, well)
        p300.mix(3, 50, well)
        p300.drop_tip()
    sample = protocol.define_liquid("Sample", "what was taken", "#00FF00")
    for column in plate.columns()[:3]:
        for well in column:
            well.load_liquid(sample, volume=40)
    enzyme.load_liquid(protocol.define_liquid("FX", "FX enzyme", "#FF0000"), volume=500)
