"""Asks what every call returns, and calls them in chains."""
metadata = {"protocolName": "chained calls"}
requirements = {"robotType": "OT-2", "apiLevel": "2.24"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", "1")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "2")
    src = ctx.load_labware("opentrons_6_tuberack_falcon_50ml_conical", "3")
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    same = p300.pick_up_tip().aspirate(100, src["A1"]).touch_tip().air_gap(10).dispense(110, plate["A1"])
    assert same is p300
    same = p300.mix(2, 50, plate["A1"], aspirate_delay=0.2, dispense_delay=0.2, final_push_out=2)
    assert same is p300 and p300.blow_out(plate["A1"].top()) is p300
    p300.aspirate(80, src["A1"], end_location=None, movement_delay=0.1)
    p300.dispense(40, plate["A2"], movement_delay=0.1)
    p300.dispense(40, plate["A3"].top())
    assert p300.drop_tip() is p300
    assert p300.transfer(30, src["B1"], plate.rows()[1][:4]) is p300
    assert p300.distribute(30, src["B1"], plate.rows()[2][:4]) is p300
    assert p300.consolidate(30, plate.rows()[2][:4], plate["D1"]) is p300
    assert p300.pick_up_tip().move_to(plate["D1"].top()) is p300
    assert p300.return_tip() is p300
    assert p300.home() is p300
