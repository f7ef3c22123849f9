"""Dose response; all wells mixed in the end."""

metadata = {"apiLevel": "2.15", "protocolName": "Dose response"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "cell plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    assay = protocol.load_labware("corning_96_wellplate_360ul_flat", 6, "supernatants")
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[large])
    drug_10uM, drug_1uM, vehicle = tubes["A1"], tubes["A2"], tubes["B1"]
    vehicle_control, untreated = plate["A1"], plate["B1"]
    treated_1uM, treated_10uM = plate["C1"], plate["D1"]

    p20.transfer(5, vehicle, vehicle_control)
    p20.transfer(5, drug_1uM, treated_1uM)
    p20.transfer(5, drug_10uM, treated_10uM)
    p300.pick_up_tip()
    for well in (treated_1uM, treated_10uM, untreated):
        p300.mix(2, 50, well)
    p300.drop_tip()
