metadata = {"protocolName": "Cell treatment with inhibitors", "apiLevel": "2.15"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "inhibitors")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "cell plate")
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", 3)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    treated, controls = (row[:4] for row in cells.rows()[:2])
    for tube, well in zip(rack.wells(), treated):
        p20.transfer(5, tube, well)
    for well in controls:
        p20.transfer(5, rack["D6"], well, new_tip="always")
