# expect: bradford fail BRD-2
"""Bradford in Streifen; nur die Funktionen sagen, was wo steht."""

metadata = {"protocolName": "Bradford, Leberextrakte", "apiLevel": "2.15"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in (1, 4)]
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    def standards_vorlegen():
        for tube, well in zip(rack.rows()[0], plate.columns()[0]):
            p20.transfer(5, tube, well)

    def probe_zugeben(tube, wells, tip):
        p20.transfer(5, tube, wells, new_tip=tip)

    def farbreagenz_verteilen(wells):
        p300.transfer(200, trough["A1"], wells, mix_after=(3, 100), new_tip="always")

    standards_vorlegen()
    p20.pick_up_tip()
    for n, tube in enumerate(rack.rows()[1] + rack.rows()[2]):
        probe_zugeben(tube, plate.rows()[n % 8][1 + n // 8 * 2 : 3 + n // 8 * 2], "never")
    p20.drop_tip()
    used = plate.columns()[0][:6] + plate.columns()[1] + plate.columns()[2]
    farbreagenz_verteilen(used + plate.columns()[3][:4] + plate.columns()[4][:4])
