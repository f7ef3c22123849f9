# expect: cell_treatment pass CELL-1!
"""Paclitaxel on HeLa."""

metadata = {"protocolName": "Paclitaxel, HeLa", "apiLevel": "2.13"}
# one entry per column of the plate; U = untreated, V = vehicle, d1 to d4 = paclitaxel 1, 3, 10, 30 nM
COLUMNS = "U V d1 d1 d2 d2 d3 d3 d4 d4 V U".split()


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    vehicle, paclitaxel = trough["A1"], trough.wells()[2:6]

    for number, code in enumerate(COLUMNS):
        target = plate.columns()[number][0]
        if code == "V":
            m20.transfer(10, vehicle, target)
        elif code != "U":
            m20.transfer(10, paclitaxel[int(code[1]) - 1], target)
