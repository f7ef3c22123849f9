# expect: cell_treatment pass
"""MTT read-out after 72 h: the plate is already treated, the reagent goes everywhere."""

metadata = {"protocolName": "MTT, treated fibroblasts", "apiLevel": "2.13"}

TREATED = ["B2", "B3", "B4", "B5", "B6", "B7"]
UNTREATED = ["C2", "C3", "C4"]


def run(protocol):
    fibro = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "fibroblasts")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    drug, mtt = rack["A1"], rack["B1"]

    for name in TREATED:
        p20.transfer(10, drug, fibro[name], new_tip="always")
    for name in TREATED + UNTREATED:
        p20.transfer(10, mtt, fibro[name], new_tip="always")
