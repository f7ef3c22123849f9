from opentrons import protocol_api

metadata = {
    "protocolName": "Dexamethasone on A549, 6 h",
    "author": "GR signalling",
    "description": "Half plate with dexamethasone, controls with ethanol vehicle, medium top-up",
    "apiLevel": "2.14",
}


def run(protocol: protocol_api.ProtocolContext):
    a549 = protocol.load_labware("corning_48_wellplate_1.6ml_flat", 1, label="A549 cells")
    tubes = protocol.load_labware("opentrons_15_tuberack_nest_15ml_conical", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    dex = tubes["A1"]
    vehicle = tubes["A2"]
    medium = tubes["A3"]
    dex.load_liquid(protocol.define_liquid("Dexamethasone 1 uM", "10x drug in medium", "#ff5555"), 8000)
    vehicle.load_liquid(protocol.define_liquid("Ethanol vehicle", "0.1 % in medium", "#dddddd"), 8000)
    medium.load_liquid(protocol.define_liquid("Medium", "F-12K", "#ffccaa"), 12000)
    cells = protocol.define_liquid("A549", "in 450 uL", "#88ee88")
    for well in a549.wells():
        well.load_liquid(cells, 450)

    treated_wells = [well for row in a549.rows()[:3] for well in row]         # rows A-C
    vehicle_controls = [well for row in a549.rows()[3:5] for well in row]     # rows D, E
    untreated = a549.rows()[5]                                                # row F

    for well in vehicle_controls[:8]:
        p300.transfer(50, vehicle, well, new_tip="always")
    for well in untreated:
        p300.transfer(50, medium, well, new_tip="always")
    for well in treated_wells:
        p300.transfer(50, dex, well, new_tip="always")
