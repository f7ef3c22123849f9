metadata = {"apiLevel": "2.15", "protocolName": "Normalise libraries"}


def run(ctx):
    libraries = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "source plate")
    normalised = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "destination plate")
    buffer = ctx.load_labware("nest_12_reservoir_15ml", 3)["A1"]
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", [ctx.load_labware("opentrons_96_tiprack_20ul", 4)]
    )

    sources, destinations = libraries.columns()[0][:4], normalised.columns()[0][:4]
    for source, destination in zip(sources, destinations):
        p20.pick_up_tip()
        p20.aspirate(5, source)
        p20.air_gap(2)
        p20.dispense(7, destination)
        p20.blow_out(destination.top(-2))
        p20.drop_tip()
    # The buffer comes from above, with one tip, and the drop is wiped off at the wall.
    p20.pick_up_tip()
    for destination in destinations:
        p20.aspirate(15, buffer)
        p20.air_gap(3)
        p20.dispense(18, destination.top(-1))
        p20.touch_tip(destination, v_offset=-2)
    p20.drop_tip()
