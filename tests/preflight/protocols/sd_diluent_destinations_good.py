# expect: serial_dilution pass
"""Standard curve in rows; the wells are called after what goes into them first."""

metadata = {"apiLevel": "2.13", "protocolName": "Standard curve, two fold serial dilution"}


def run(ctx):
    racks = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 6)]
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=racks)
    diluents = tubes.columns()[0][:2]
    stocks = tubes.columns()[1][:2]
    for diluent_source, stock_source, row in zip(diluents, stocks, plate.rows()):
        diluent_destinations = row[:8]
        p300.distribute(100, diluent_source, diluent_destinations, disposal_volume=0)
        p300.transfer(100, stock_source, row[0], mix_after=(3, 100))
        for source, destination in zip(row[:7], row[1:8]):
            p300.transfer(100, source, destination, mix_after=(3, 100), new_tip="always")
