# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "Viability of HepG2 cells"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (1, 4)]
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HepG2 cells")
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", 3)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 5)
    m = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    vehicle, medium, toxin = trough["A1"], trough["A2"], trough["A3"]
    doses = block.rows()[0][:4]
    m.transfer(200, medium, doses[1:], new_tip="once")
    m.transfer(300, toxin, doses[0], new_tip="always")
    for strong, weak in zip(doses, doses[1:]):
        m.transfer(100, strong, weak, mix_after=(3, 100), new_tip="always")
    for dose, treated in zip(doses, cells.rows()[0]):
        m.transfer(30, dose, treated, new_tip="always")
    vehicle_controls = cells.rows()[0][10:]
    m.transfer(30, vehicle, vehicle_controls, new_tip="always")
