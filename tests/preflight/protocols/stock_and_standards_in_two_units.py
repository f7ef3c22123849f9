# expect: bradford pass
metadata = {"protocolName": "Protein assay, one tip for the curve", "apiLevel": "2.14"}

STANDARD_CONCENTRATIONS = {"B1": 125, "B2": 250, "B3": 500, "B4": 1000}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "BSA standards")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3", "Bradford plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", "4", "Bradford reagent")["A1"]
    top = rack["A1"]
    top.load_liquid(protocol.define_liquid("BSA", "2 mg/ml", "#0000ff"), 500)

    curve = [rack[name] for name in STANDARD_CONCENTRATIONS] + [top]
    for column in plate.columns()[:2]:
        p300.pick_up_tip()
        for tube, well in zip(curve, column):
            p300.aspirate(20, tube)
            p300.dispense(20, well)
        p300.drop_tip()
    for column in plate.columns()[:2]:
        p300.transfer(200, dye, column[:5], mix_after=(3, 120), new_tip="always")
