metadata = {"protocolName": "Dose response MCF-7", "apiLevel": "2.15"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in (1, 4)]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "MCF-7 cells")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    p20.pick_up_tip()
    for n, cond in enumerate(["drug 1 uM", "drug 10 uM", "vehicle control"]):
        protocol.comment(f"column {n + 1}: {cond}")
        for w in plate.columns()[n]:
            p20.aspirate(5, rack.wells()[n])
            p20.dispense(5, w)
    p20.drop_tip()
