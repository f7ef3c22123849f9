# expect: cell_treatment fail CELL-1 CELL-2
"""TNF alpha is in medium, so medium is its vehicle."""

metadata = {"apiLevel": "2.13", "protocolName": "TNF alpha on HUVEC"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HUVEC")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    medium, drug = trough["A1"], trough["A2"]
    vehicle_controls = [plate["A1"], plate["A2"], plate["A3"]]
    treated = [plate["A4"], plate["A5"], plate["A6"]]

    m300.transfer(20, medium, vehicle_controls[:2], new_tip="always")
    m300.transfer(20, drug, [*treated, plate["A3"]], new_tip="always")
