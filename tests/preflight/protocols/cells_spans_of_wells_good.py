# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "rapamycin, autophagy flux"}

LAYOUT = {
    "vehicle_control": ["A1:H1"],
    "rapamycin": ["A2:H2", "A3:H3"],
    "untreated": ["A4:H4"],
}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa cells")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    dmso, rapamycin = reservoir["A1"], reservoir["A2"]

    for span in LAYOUT["vehicle_control"]:
        m20.transfer(10, dmso, plate[span.split(":")[0]], new_tip="always")
    for span in LAYOUT["rapamycin"]:
        m20.transfer(10, rapamycin, plate[span.split(":")[0]], new_tip="always")
