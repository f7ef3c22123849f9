# expect: generic fail GEN-1
metadata = {"protocolName": "Cherry picking from source racks", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    racks = [
        protocol.load_labware("opentrons_24_tuberack_eppendorf_2ml_safelock_snapcap", slot)
        for slot in (1, 2)
    ]
    plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dest_wells = plate.wells()[:16]
    source_tubes = {}
    for number, rack in enumerate(racks, 1):
        source_tubes[str(number)] = rack.wells()[:4]

    for number in source_tubes:
        p300.pick_up_tip()
        for source in source_tubes[number]:
            for _ in range(2):
                p300.aspirate(200, source)
                p300.dispense(200, dest_wells.pop(0).top())
        p300.drop_tip()
