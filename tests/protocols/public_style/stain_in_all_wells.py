metadata = {"protocolName": "Cell treatment with inhibitors", "apiLevel": "2.15"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 4)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "cell plate")
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", 3)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    drugs, dmso = rack.wells()[:8], rack["D6"]
    treated, vehicle_controls = cells.rows()[0][:8], cells.rows()[1][:4]
    for drug, well in zip(drugs, treated):
        p20.transfer(5, drug, well)
    for well in vehicle_controls:
        p20.transfer(5, dmso, well, new_tip="always")
    for well in treated + vehicle_controls:
        p20.transfer(10, trough["A1"], well.top(), new_tip="always")
