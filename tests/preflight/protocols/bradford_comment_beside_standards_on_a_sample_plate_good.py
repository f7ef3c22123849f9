# expect: bradford pass
"""Protein in synovial fluid by pyrogallol red."""

metadata = {"protocolName": "Synovial fluid, pyrogallol red", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tips_large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    standards = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "standards, 0 to 1500 mg/L"
    )
    fluids = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "fluids")
    sample_plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, "sample plate")
    dye = protocol.load_labware("nest_1_reservoir_195ml", 6, "pyrogallol red")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_large])
    upper, lower = sample_plate.rows()[0][:6], sample_plate.rows()[4][:8]

    # 4 uL each into the sample plate
    p20.pick_up_tip()
    for tube, well in zip(standards.rows()[0], upper):
        p20.aspirate(4, tube)
        p20.dispense(4, well)
    p20.drop_tip()
    # 4 uL each into the sample plate
    p20.transfer(4, fluids.wells()[:8], lower, new_tip="always")
    # colour for all
    for well in upper + lower:
        p300.transfer(200, dye, well, mix_after=(3, 100), new_tip="always")
