# expect: generic pass
metadata = {"protocolName": "Aliquot reagents to a plate", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    def give(source, dest):
        p300.aspirate(50, source)
        p300.dispense(50, dest.top())

    p300.pick_up_tip()
    for source in (trough["A1"], trough["A2"]):
        for dest in plate.columns()[0]:
            give(source, dest)
    p300.drop_tip()
