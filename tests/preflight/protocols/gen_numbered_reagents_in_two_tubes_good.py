# expect: generic pass
metadata = {"protocolName": "Screen of formulations from source tubes", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    rack = protocol.load_labware("opentrons_24_tuberack_eppendorf_2ml_safelock_snapcap", 2)
    plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dest_wells = plate.wells()[:8]
    source_tubes = {}
    for number, names in {"1": "A1 B1", "2": "A2 B2", "3": "A3 B3"}.items():
        source_tubes[number] = [rack[name] for name in names.split()]

    for number in source_tubes:
        left = list(source_tubes[number])
        p300.pick_up_tip()
        for count, dest in enumerate(dest_wells):
            source = left[count // 4]
            p300.aspirate(200, source)
            p300.dispense(200, dest.top())
        p300.drop_tip()
