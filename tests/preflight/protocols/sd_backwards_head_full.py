# expect: serial_dilution fail SD-2
metadata = {"apiLevel": "2.13", "protocolName": "Dilution series of an inhibitor"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    strip = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, stock = tubes["A1"], tubes["D1"]
    wells = strip.columns()[4]
    p.distribute(60, diluent, wells[1:], disposal_volume=0)
    p.transfer(120, stock, wells[0])
    for k in range(7, 0, -1):
        p.pick_up_tip()
        p.aspirate(60, wells[k])
        p.dispense(60, wells[k - 1])
        p.mix(3, 50, wells[k - 1])
        p.drop_tip()
