"""End-point PCR of colonies; the last colony's tip goes on to the water and the blank."""

metadata = {"protocolName": "Colony PCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    master_mix, water = rack["A1"], rack["A2"]
    colonies = rack.rows()[1][:4]
    reactions = plate.wells()[:4]
    ntc = plate["H1"]
    p20.transfer(18, master_mix, [*reactions, ntc], new_tip="once")
    for colony, reaction in zip(colonies, reactions):
        if p20.has_tip:
            p20.drop_tip()
        p20.pick_up_tip()
        p20.aspirate(2, colony)
        p20.dispense(2, reaction)
        p20.mix(2, 10, reaction)
    p20.aspirate(2, water)
    p20.dispense(2, ntc)
    p20.drop_tip()
