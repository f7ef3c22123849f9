# expect: cell_treatment pass
"""Nocodazole, then two dyes on every well; all liquids stand in one rack."""

metadata = {"protocolName": "Nocodazole and live imaging", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "U2OS cells")
    tubes = protocol.load_labware(
        "opentrons_24_tuberack_nest_2ml_snapcap", "3", "inhibitors"
    )
    dmso = tubes["A1"]
    doses = [tubes[name] for name in ("B1", "B2", "B3")]
    hoechst, calcein = tubes["D5"], tubes["D6"]

    untreated = cells.columns()[1][1:4]
    vehicle = cells.columns()[2][1:4]
    treated = [cells.columns()[number][1:4] for number in (3, 4, 5)]

    for well in vehicle:
        p300.transfer(20, dmso, well, new_tip="always")
    for dose, wells in zip(doses, treated):
        for well in wells:
            p300.transfer(20, dose, well, new_tip="always")

    # dyes from above, one tip each
    for dye in (hoechst, calcein):
        p300.pick_up_tip()
        for well in [*untreated, *vehicle, *(well for wells in treated for well in wells)]:
            p300.aspirate(25, dye)
            p300.dispense(25, well.top())
        p300.drop_tip()
