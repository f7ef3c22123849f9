"""Pipettes as dictionary keys and set members, found again by the very object."""
metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips300 = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    tips20 = protocol.load_labware("opentrons_96_tiprack_20ul", "2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips300])
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips20])
    used = {p300: 0, p20: 0}
    smallest = {p20: (1, 20), p300: (20, 300)}
    for volume, target in ((50, "A2"), (5, "B2"), (100, "C2")):
        pipette = next(p for p, (low, high) in smallest.items() if low <= volume <= high)
        pipette.transfer(volume, plate["A1"], plate[target])
        used[pipette] += 1
    assert set(protocol.loaded_instruments.values()) == set(used)
    protocol.comment(f"{used[p300]} {used[p20]} {p300 in used} {hash(p300) == hash(p300)}")
