metadata = {"apiLevel": "2.13"}


def run(protocol):
    a = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    b = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    c = protocol.load_labware("nest_12_reservoir_15ml", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[a])
    x = b.columns()[2]
    p.distribute(80, c["A1"], x[1:], disposal_volume=0)
    p.transfer(160, c["A2"], x[0])
    for i in range(7):
        p.transfer(80, x[i], x[i + 1], mix_after=(3, 60), new_tip="always")
