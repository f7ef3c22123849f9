# expect: cell_treatment fail CELL-1
"""An antibody against HUVEC in three strengths, all tubes unlabelled; lowest strength first."""

metadata = {"protocolName": "Zolinumab on HUVEC", "apiLevel": "2.13"}

WELLS = {
    "zolinumab 2 ug/ml": ["A3", "B3", "C3"],
    "zolinumab 20 ug/ml": ["A4", "B4", "C4"],
    "zolinumab 200 ug/ml": ["A5", "B5", "C5"],
}
MEDIUM_ONLY = ["A6", "B6", "C6"]


def run(protocol):
    huvec = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HUVEC plate")
    vials = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    for name in MEDIUM_ONLY:
        p20.transfer(9, vials["D6"], huvec[name], new_tip="always")
    for vial, wells in zip(vials.columns()[0], WELLS.values()):
        p20.pick_up_tip()
        for name in wells + MEDIUM_ONLY[:1] * (wells[0] == "A5"):
            p20.transfer(9, vial, huvec[name], new_tip="never")
        p20.drop_tip()
