# expect: serial_dilution fail SD-3
"""Two-fold series of an antiserum from the stock in column 1 down to column 8."""

metadata = {"protocolName": "Antiserum, two-fold", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 4)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    diluent = trough["A1"]
    stock, *series = [column[0] for column in plate.columns()[:8]]

    m300.pick_up_tip()
    for well in series[1:]:
        m300.transfer(100, diluent, well.top(-1), new_tip="never")
    m300.drop_tip()
    for here, there in zip([stock, *series], series):
        m300.pick_up_tip()
        m300.aspirate(100, here)
        m300.dispense(100, there)
        m300.mix(5, 80, there)
        m300.drop_tip()
