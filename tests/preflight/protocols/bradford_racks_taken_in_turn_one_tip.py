# expect: bradford fail BRD-2
"""Bradford of two harvests.

Plate (slot 6): columns 1-2 standards; columns 3-4 lysates, rows A-D harvest 1, rows E-H harvest 2.
"""

metadata = {"apiLevel": "2.16", "protocolName": "Bradford, two harvests"}
STANDARD_TUBES = ("A1", "A2", "A3", "A4", "A5", "A6", "B1", "B2")
LYSATE_TUBES = ("A1", "B1", "C1", "D1")


def run(protocol):
    kind = "opentrons_24_tuberack_nest_1.5ml_snapcap"
    harvests = [protocol.load_labware(kind, n, f"harvest {n}") for n in (1, 2)]
    bsa = protocol.load_labware(kind, 3, "BSA")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 5, "dye trough")["A1"]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 6, "plate")
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 8)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 9)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])

    for column in plate.columns()[:2]:
        p20.pick_up_tip()
        for name, well in zip(STANDARD_TUBES, column):
            p20.aspirate(20, bsa[name])
            p20.dispense(20, well)
        p20.drop_tip()
    sources = [rack[name] for rack in harvests for name in LYSATE_TUBES]
    p20.pick_up_tip()
    for source, *wells in zip(sources, *plate.columns()[2:4]):
        p20.transfer(20, source, wells, new_tip="never")
    p20.drop_tip()
    for column in plate.columns()[:4]:
        m300.transfer(180, dye, column[0], mix_after=(4, 120))
