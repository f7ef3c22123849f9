# expect: bradford pass
"""Protein in cerebrospinal fluid, pyrogallol red; the calibrators stand on the patients' plate."""

metadata = {"protocolName": "CSF protein", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tips_large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    calibrators = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "calibrators 0 to 2000 mg/L"
    )
    csf_tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "CSF")
    csf_plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, "CSF plate")
    dye = protocol.load_labware("nest_1_reservoir_195ml", 6, "pyrogallol red")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_large])

    wells = csf_plate.columns()[0][:6]
    p20.pick_up_tip()
    for tube, well in zip(calibrators.rows()[0], wells):
        p20.transfer(4, tube, well, new_tip="never")
    p20.drop_tip()
    patients = csf_plate.columns()[1]
    p20.transfer(4, csf_tubes.wells()[:8], patients, new_tip="always")
    for well in wells + patients:
        p300.transfer(200, dye, well, mix_after=(3, 100), new_tip="always")
