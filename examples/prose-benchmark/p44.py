"""Zika RT-qPCR. What each step gives is said as the robot goes, and nowhere else."""

metadata = {"protocolName": "RT-qPCR", "apiLevel": "2.15"}
STEPS = [("RNA 1", "A1", "A1"), ("RNA 2", "A2", "B1"), ("RNA 3", "A3", "C1")]


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (1, 4)]
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    protocol.comment("master mix")
    p20.transfer(15, rack["D6"], plate.columns()[0][:5])
    for what, tube, well in STEPS:
        protocol.comment(f"{what} -> {well}")
        p20.transfer(5, rack[tube], plate[well], new_tip="always")
    p20.pick_up_tip()
    protocol.comment("RNA 4")
    p20.aspirate(5, rack["A4"])
    p20.dispense(5, plate["E1"])
    protocol.comment("Water to the no-template control")
    p20.aspirate(5, rack["D1"])
    p20.dispense(5, plate["D1"])
    p20.drop_tip()
    protocol.comment("RNA added, negative control closed: seal and run")
