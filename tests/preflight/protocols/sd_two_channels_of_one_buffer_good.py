# expect: serial_dilution pass SD-4!
"""Two-fold titration of a toxin.

slot 2   12-channel trough: A1 and A2 assay buffer (the diluent)
slot 3   toxin stock, column 1
"""

metadata = {"apiLevel": "2.14", "protocolName": "Toxin titration, two-fold"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2, "assay buffer")
    stocks = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "toxin stock")
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (4, 5)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    buffer = [trough["A1"], trough["A2"]]
    series = [plate.columns()[at][0] for at in range(8)]

    m300.pick_up_tip()
    for at, column in enumerate(series):
        m300.aspirate(100, buffer[at // 4])
        m300.dispense(100, column)
    m300.drop_tip()
    above = stocks["A1"]
    for column in series:
        m300.transfer(100, above, column, mix_after=(5, 80))
        above = column
