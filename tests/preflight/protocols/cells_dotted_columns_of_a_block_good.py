# expect: cell_treatment pass
"""Cetuximab on A431, dose by dose; the tip of a row climbs to the left."""

# rows B-D ; col 2..7 = 20 6 2 0.6 0.2 0.06 nM ; col 8 PBS (vehicle) ; col 9 cells only

metadata = {"apiLevel": "2.13", "protocolName": "A431 cetuximab"}

TUBES = ["A1", "A2", "A3", "A4", "A5", "A6"]


def run(protocol):
    a431 = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "A431")
    rack = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "Cmab A1-A6, PBS D1"
    )
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    for row in "BCD":
        p20.pick_up_tip()
        p20.aspirate(15, rack["D1"])
        p20.dispense(15, a431[f"{row}8"])
        for column, tube in reversed(list(enumerate(TUBES, 2))):
            p20.aspirate(15, rack[tube])
            p20.dispense(15, a431[f"{row}{column}"])
        p20.drop_tip()
