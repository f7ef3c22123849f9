# expect: cell_treatment pass
"""Every second column of the HeLa plate is a DMSO control."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "HeLa cells")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, nocodazole = rack.wells()[:2]
    vehicle_wells = [well for column in plate.columns()[1::2] for well in column]

    for well in plate.wells():
        drug = dmso if well in vehicle_wells else nocodazole
        p20.pick_up_tip()
        p20.aspirate(5, drug)
        p20.dispense(5, well)
        p20.drop_tip()
