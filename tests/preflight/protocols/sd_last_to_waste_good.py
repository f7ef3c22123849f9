metadata = {"apiLevel": "2.15", "protocolName": "Vancomycin twofold"}


def run(protocol):
    trough = protocol.load_labware("nest_12_reservoir_15ml", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, stock = trough["A1"], trough["A2"]
    row = plate.rows()[0][:8]
    p300.distribute(100, diluent, row[1:], disposal_volume=0)
    p300.transfer(200, stock, row[0])
    for one, other in zip(row, row[1:]):
        p300.transfer(100, one, other, mix_after=(5, 80), new_tip="always")
    p300.transfer(100, row[-1], trough["A12"].top())  # the last 100 to waste
