metadata = {"apiLevel": "2.15", "protocolName": "Drug treatment, 24 h"}


def run(protocol):
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "cell plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    p1000 = protocol.load_instrument(
        "p1000_single_gen2", "left", [protocol.load_labware("opentrons_96_tiprack_1000ul", 4)]
    )
    p20 = protocol.load_instrument(
        "p20_single_gen2", "right", [protocol.load_labware("opentrons_96_tiprack_20ul", 5)]
    )
    medium, waste = trough["A1"], trough["A12"]
    drug, dmso = tubes["A1"], tubes["A2"]
    treated, vehicle_controls = cells.rows()[0][:3], cells.rows()[1][:3]

    p20.transfer(2, dmso, vehicle_controls, new_tip="always", mix_after=(2, 15))
    p20.transfer(2, drug, treated, new_tip="always", mix_after=(2, 15))
    protocol.delay(minutes=30)
    # Wash out: old medium off, fresh medium on.
    p1000.pick_up_tip()
    for well in treated + vehicle_controls:
        p1000.aspirate(500, well.bottom(1))
        p1000.dispense(500, waste.top())
    p1000.drop_tip()
    for well in treated + vehicle_controls:
        p1000.pick_up_tip()
        p1000.aspirate(500, medium)
        p1000.dispense(500, well.top(-2))
        p1000.drop_tip()
