"""A two-fold dilution series with the 8-channel, a fresh set of tips for each step."""

from aegis_ot import guard

metadata = {
    "protocolName": "Serial dilution, 8 x 12",
    "author": "aegis_ot examples",
    "apiLevel": "2.14",
}


@guard(assay="serial_dilution")
def run(protocol):
    tip_racks = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, label="Reservoir")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, label="Dilution plate")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tip_racks)

    diluent = reservoir["A1"]
    stock = reservoir["A2"]
    diluent.load_liquid(protocol.define_liquid("water", "diluent", "#aaddff"), 14000)
    stock.load_liquid(protocol.define_liquid("red", "dye stock", "#cc0000"), 5000)

    series = plate.rows()[0]  # the first well of each column stands for the column

    # Undiluted stock in column 1, diluent in columns 2 to 12.
    m300.transfer(200, stock, series[0])
    m300.transfer(100, diluent, series[1:])

    for stronger, weaker in zip(series, series[1:]):
        m300.pick_up_tip()
        m300.aspirate(100, stronger)
        m300.dispense(100, weaker)
        m300.mix(4, 80, weaker)
        m300.drop_tip()
