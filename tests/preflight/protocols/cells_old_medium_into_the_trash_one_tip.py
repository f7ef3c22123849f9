"""Dose response; old medium off first."""

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

    for well in (vehicle_control, untreated, treated_1uM, treated_10uM):
        p300.transfer(80, well, protocol.fixed_trash["A1"])
    p20.pick_up_tip()
    for source, well in ((drug_1uM, treated_1uM), (vehicle, vehicle_control)):
        p20.aspirate(5, source)
        p20.dispense(5, well)
    p20.drop_tip()
    p20.transfer(5, drug_10uM, treated_10uM)
