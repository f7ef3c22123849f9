# expect: bradford fail BRD-1
"""Plasma against BSA; the line above the standards lists their levels, the unit first."""

metadata = {"apiLevel": "2.15", "protocolName": "Coomassie, plasma"}


def run(protocol):
    plasma = protocol.load_labware("nest_96_wellplate_200ul_flat", 7, "plasma 1:50")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 8)
    assay = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    coomassie = protocol.load_labware("nest_12_reservoir_15ml", 4, "Coomassie").wells()[0]
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])

    # (ug/mL): blank, 40, 80, 160, 320
    standards = tubes.wells()[:5]
    column = assay.columns()[4]

    p20.pick_up_tip()
    for source, target in list(zip(standards, column))[::-1]:
        p20.aspirate(10, source)
        p20.dispense(10, target)
    p20.drop_tip()
    for number in range(8):
        p20.transfer(10, plasma.columns()[0][number], assay.columns()[5][number])
    for well in (assay["A5"], assay["A6"]):
        m300.transfer(190, coomassie, well, new_tip="always", mix_after=(3, 100))
