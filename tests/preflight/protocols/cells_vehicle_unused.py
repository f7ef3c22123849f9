# expect: cell_treatment fail CELL-2
metadata = {"apiLevel": "2.13", "protocolName": "Apoptosis in Jurkat cells"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "Jurkat cells")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    m = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    etoposide, vehicle = trough["A1"], trough["A2"]
    treated = cells.rows()[0][:6]
    vehicle_controls = cells.rows()[0][6:8]
    m.transfer(30, etoposide, treated, new_tip="always")
