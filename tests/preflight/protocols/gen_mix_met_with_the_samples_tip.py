metadata = {"protocolName": "Normalization and a labelling mix", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    rack = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)
    source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    dest_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 4)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    components = {"dye": "A1", "linker": "B1", "salt": "C1"}
    mix = rack["A6"]

    for name in components.values():
        src = rack[name]
        p300.pick_up_tip()
        p300.aspirate(100, src)
        p300.dispense(100, mix)
        p300.drop_tip()
    for src, dest in zip(source_plate.wells()[:6], dest_plate.wells()):
        p300.pick_up_tip()
        p300.aspirate(50, src)
        p300.aspirate(30, mix)
        p300.dispense(80, dest)
        p300.drop_tip()
