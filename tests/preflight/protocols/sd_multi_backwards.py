metadata = {"protocolName": "1:2 dilution of antibody across a plate", "apiLevel": "2.15"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (1, 4)]
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    p = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    pbs = trough["A1"]
    antibody = trough["A12"]
    cols = plate.rows()[0]
    p.pick_up_tip()
    for c in cols[1:]:
        p.transfer(100, pbs, c, new_tip="never")
    p.drop_tip()
    p.transfer(200, antibody, cols[0])
    for a, b in zip(cols[11:1:-1], cols[10:0:-1]):
        p.pick_up_tip()
        p.aspirate(100, a)
        p.dispense(100, b)
        for _ in range(4):
            p.aspirate(80, b)
            p.dispense(80, b)
        p.drop_tip()
    p.pick_up_tip()
    p.aspirate(100, cols[10])
    p.dispense(100, protocol.fixed_trash["A1"])
    p.drop_tip()
