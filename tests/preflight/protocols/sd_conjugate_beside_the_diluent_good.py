# expect: serial_dilution pass
"""Two titrations; the second one is filled from the next compartment of the diluent."""

metadata = {"protocolName": "Titration of two sera", "apiLevel": "2.14"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 9, "diluent A1+A3, conjugate A2")
    sera = ctx.load_labware("nest_96_wellplate_2ml_deep", 6, "sera")
    plates = [ctx.load_labware("corning_96_wellplate_360ul_flat", slot) for slot in (2, 3)]
    racks = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8, 10)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=racks)
    for number, plate in enumerate(plates):
        columns = plate.rows()[0]
        m300.transfer(100, trough.wells()[2 * number], columns[1:], new_tip="once")
        m300.transfer(200, sera.rows()[0][number], columns[0])
        for left, right in zip(columns, columns[1:]):
            m300.transfer(100, left, right, mix_after=(5, 80))
