# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "Etoposide on U2OS, one plate"}
COLUMNS = {"untreated": [1], "etoposide": [2, 3, 4], "dmso_control": [5, 6]}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    source = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4, "U2OS cells")
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    etoposide, vehicle = source["A1"], source["A6"]

    for c in COLUMNS["dmso_control"]:
        m20.transfer(15, vehicle, plate.columns()[c - 1][0], new_tip="always")
    for c in COLUMNS["etoposide"]:
        m20.transfer(15, etoposide, plate.columns()[c - 1][0], new_tip="always")
