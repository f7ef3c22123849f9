# expect: generic pass
metadata = {"protocolName": "Normalization and pooling", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (7, 8)]
    racks = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)
    source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    dest_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    dests = dest_plate.wells()[:6]
    p20.transfer(8, source_plate.wells()[:6], dests, new_tip="always")

    # Pool all samples
    pool = racks["C1"]
    p20.pick_up_tip()
    for well in dests:
        if p20.current_volume + 8 > 20:
            p20.dispense(p20.current_volume, pool)
        p20.aspirate(8, well)
    p20.dispense(p20.current_volume, pool)
    p20.drop_tip()
