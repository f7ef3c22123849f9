# expect: serial_dilution pass
"""Two-fold series of an antibody."""

metadata = {"protocolName": "Antibody, two-fold", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 4)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips)
    diluent = trough["A1"]
    stock = rack["A1"]
    columns = [column[0] for column in plate.columns()[:8]]

    m300.transfer(100, diluent, columns[1:], new_tip="once")
    # the undiluted antibody goes down column 1, for the multichannel to take from
    p300.transfer(100, stock, plate.columns()[0], new_tip="once")
    for here, there in zip(columns, columns[1:]):
        m300.transfer(100, here, there, mix_after=(5, 80), new_tip="always")
