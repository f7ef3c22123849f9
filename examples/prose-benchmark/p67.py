"""qPCR set-up; the tubes have no names, the helpers do. The last "template" is the water."""

metadata = {"protocolName": "qPCR IL-6", "apiLevel": "2.15"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (1, 4)]
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    ntc = plate["H1"]

    def move(source, target, volume):
        p20.pick_up_tip()
        p20.aspirate(volume, source)
        p20.dispense(volume, target)
        p20.drop_tip()

    def dispense_master_mix_to(wells):
        for well in wells:
            move(block["A6"], well, 15)

    def add_template(tube, well):
        move(tube, well, 5)

    dispense_master_mix_to(plate.columns()[0])
    for n in range(7):
        add_template(block.wells()[n], plate.wells()[n])
    add_template(block["D6"], ntc)
