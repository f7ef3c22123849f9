"""Bradford of the fractions of a gel filtration, diluted before.

tube rack, fractions: C1..C6 = fractions 7 to 12
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in ("4", "5")]
    source = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    first = protocol.load_labware("corning_96_wellplate_360ul_flat", "1")
    second = protocol.load_labware("corning_96_wellplate_360ul_flat", "6")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Bradford reagent")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    for tube, well in zip(source.rows()[2], first.rows()[2]):
        p300.transfer(50, tube, well, new_tip="always")
    for well, target in zip(first.rows()[2][:6], second.rows()[2]):
        p300.transfer(25, well, target, new_tip="always")
        p300.transfer(200, trough["A1"], target, mix_after=(3, 100), new_tip="always")
