"""Protein in column fractions by dye binding.

Albumin standards are pre-made in strip tubes A1-H1 (A1 is buffer only, H1 the strongest).
Fractions 1-6 stand in a 24-place rack. Everything in duplicate.
"""

metadata = {"apiLevel": "2.12", "protocolName": "Fraction protein assay", "author": "Purification lab"}


def run(protocol):
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 10)
    t300 = protocol.load_labware("opentrons_96_tiprack_300ul", 11)
    albumin = protocol.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", 4, "albumin standards")
    fractions = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5, "fractions")
    trough = protocol.load_labware("usascientific_12_reservoir_22ml", 6, "reagents")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "assay")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[t300])

    bradford_dye = trough["A3"]
    standard_columns = plate.columns()[:2]
    sample_columns = [col[:6] for col in plate.columns()[2:4]]

    # standards, each with its own tip, both replicates
    for row in range(8):
        p20.pick_up_tip()
        for col in standard_columns:
            p20.aspirate(10, albumin.wells()[row])
            p20.dispense(10, col[row])
        p20.drop_tip()

    # samples
    p20.pick_up_tip()
    for i in range(6):
        fraction = fractions.wells()[i]
        for col in sample_columns:
            p20.aspirate(10, fraction)
            p20.dispense(10, col[i])
    p20.drop_tip()

    # dye, whole columns, mixed
    m300.transfer(200, bradford_dye, [plate[f"A{n}"] for n in (1, 2, 3, 4)], mix_after=(3, 150), new_tip="always")
