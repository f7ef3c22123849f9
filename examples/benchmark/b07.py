from opentrons import protocol_api

metadata = {"apiLevel": "2.17", "protocolName": "LPS stimulation of THP-1"}


def fresh(pipette, volume, source, column):
    """One transfer with its own tips, gently against the wall."""
    pipette.pick_up_tip()
    pipette.aspirate(volume, source)
    pipette.dispense(volume, column[0].bottom(3), rate=0.4)
    pipette.drop_tip()


def run(ctx: protocol_api.ProtocolContext):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, label="THP-1 cells")
    reservoir = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 7)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)

    thp1 = ctx.define_liquid("THP-1 cells", "50,000 per well", "#ccffcc")
    lps = ctx.define_liquid("LPS 200 ng/mL", "drug, 2x in RPMI", "#ff0000")
    pbs = ctx.define_liquid("Vehicle (PBS in RPMI)", "2x", "#ffffff")
    for w in plate.wells():
        w.load_liquid(thp1, 100)
    reservoir["A1"].load_liquid(lps, 12000)
    reservoir["A12"].load_liquid(pbs, 5000)

    columns = plate.columns()
    lps_columns = columns[:9]        # stimulated
    vehicle_columns = columns[9:]    # columns 10 to 12, vehicle controls

    for column in vehicle_columns:
        fresh(m300, 100, reservoir["A12"], column)

    for number in range(10):
        fresh(m300, 100, reservoir["A1"], columns[number])
