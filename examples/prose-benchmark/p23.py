metadata = {"protocolName": "Etoposide on HCT116", "apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    doses = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "etoposide dilutions")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "HCT116 cells")
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    vehicle = doses["A12"]

    # cells: column 1 untreated, columns 2-5 etoposide, 6 vehicle, 7 untreated
    for source, target in zip(doses.rows()[0][:4], cells.rows()[0][3:7]):
        m20.transfer(10, source, target, new_tip="always")
    m20.transfer(10, vehicle, cells["A6"], new_tip="always")
