# expect: generic fail GEN-2
"""Plasmid preps thinned to one concentration, the last of the buffer after the DNA."""

metadata = {"apiLevel": "2.15", "protocolName": "even out the minipreps"}

PREPS = {"A1": 310, "C1": 540, "E1": 150, "G1": 420}  # ng/uL
WANTED = 50


def run(protocol):
    preps = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "minipreps")
    even = protocol.load_labware("nest_96_wellplate_2ml_deep", 6, "evened out")
    buffer = protocol.load_labware("nest_12_reservoir_15ml", 9, "elution buffer")["A4"]
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 1)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    for name, found in PREPS.items():
        rest = 30 * (found / WANTED - 1) - 40
        p300.pick_up_tip()
        p300.aspirate(40, buffer)
        p300.dispense(40, even[name])
        p300.drop_tip()
        p300.pick_up_tip()
        p300.aspirate(30, preps[name])
        p300.dispense(30, even[name])
        p300.mix(3, 30, even[name])
        while rest > 0:
            p300.aspirate(min(rest, 150), buffer)
            p300.dispense(min(rest, 150), even[name].top())
            rest -= 150
        p300.drop_tip()
