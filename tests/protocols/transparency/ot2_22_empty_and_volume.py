metadata = {"protocolName": "volumes asked of wells"}
requirements = {"robotType": "OT-2", "apiLevel": "2.22"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_1000ul", "1")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "3")
    p1000 = ctx.load_instrument("p1000_single_gen2", "left", tip_racks=[tips])
    water = ctx.define_liquid("water", None, "#aaccff")
    res.load_liquid(["A1", "A2"], 8000, water)
    res.load_empty(["A3"])
    plate.load_empty(plate.wells())
    plate.load_liquid_by_well({"A1": 500, "B1": 600}, water)

    p1000.pick_up_tip()
    for well in plate.columns()[1]:
        p1000.aspirate(300, res["A1"], rate=0.9)
        p1000.air_gap(volume=50, height=2)
        p1000.dispense(350, well, push_out=0)
        ctx.comment(f"{well.well_name} holds {well.current_liquid_volume()}")
    p1000.touch_tip(plate["H2"], radius=0.7, v_offset=-4)
    p1000.mix(2, 200, plate["H2"], rate=0.8)
    p1000.blow_out(plate["H2"].top())
    p1000.drop_tip()
    p1000.consolidate(200, [plate["A1"], plate["B1"]], res["A3"])
