# expect: cell_treatment warn CELL-2
"""Etoposide on three lines. All three plates look the same:

column 1 vehicle, columns 2-4 etoposide 1, 3, 10 uM, column 5 untreated
"""

metadata = {"protocolName": "Etoposide, three lines", "apiLevel": "2.13"}


def run(protocol):
    names = {1: "U2OS", 4: "HT-1080", 7: "SAOS-2"}
    plates = [
        protocol.load_labware("corning_24_wellplate_3.4ml_flat", slot, name)
        for slot, name in names.items()
    ]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle, *etoposide = rack.rows()[0][:4]

    for plate in plates:
        first, *others = plate.columns()[:4]
        for tube, column in zip(etoposide, others):
            p20.transfer(5, tube, column, new_tip="always")
    for plate in plates[:2]:
        p20.transfer(5, vehicle, plate.columns()[0], new_tip="always")
