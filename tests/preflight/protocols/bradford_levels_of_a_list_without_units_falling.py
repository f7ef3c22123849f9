# expect: bradford fail BRD-1
"""Bradford.

slot 2   standards rack, BSA in rack order:
             A1 0 (PBS), B1 125, C1 250, D1 500,
             A2 1000, B2 2000 ug/mL
slot 3   lysates, A1 to D1
"""

metadata = {"apiLevel": "2.15", "protocolName": "Bradford"}


def run(protocol):
    rack = "opentrons_24_tuberack_nest_1.5ml_snapcap"
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "assay plate")
    std_rack = protocol.load_labware(rack, 2, "BSA standards")
    lysates = protocol.load_labware(rack, 3, "lysates")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 6, "Bradford reagent")["A1"]
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[large])

    # the standards, blank upwards, one tip
    p20.pick_up_tip()
    for tube, well in zip(std_rack.wells()[:6][::-1], plate.columns()[0][5::-1]):
        p20.aspirate(5, tube)
        p20.dispense(5, well)
    p20.drop_tip()
    p20.transfer(5, lysates.wells()[:4], plate.columns()[1][:4], new_tip="always")
    wells = plate.columns()[0][:6] + plate.columns()[1][:4]
    p300.transfer(250, dye, wells, mix_after=(3, 150), new_tip="always")
