metadata = {"protocolName": "AMPure bead cleanup", "apiLevel": "2.15"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5, 7, 8)]
    m = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    mag = protocol.load_module("magneticModuleV2", 1)
    mp = mag.load_labware("nest_96_wellplate_100ul_pcr_full_skirt")
    res = protocol.load_labware("nest_12_reservoir_15ml", 2)
    out = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3)
    beads, etoh, te = res["A1"], res["A3"], res["A5"]
    waste = res["A12"].top()
    for c in mp.rows()[0][:3]:
        m.transfer(36, beads, c, mix_after=(10, 30))
    mag.engage(height_from_base=5)
    for c in mp.rows()[0][:3]:
        m.transfer(55, c, waste)
    m.pick_up_tip()
    for c in mp.rows()[0][:3]:
        m.transfer(90, etoh, c.top(), new_tip="never")
    m.drop_tip()
    for c in mp.rows()[0][:3]:
        m.transfer(95, c, waste)
    mag.disengage()
    for c in mp.rows()[0][:3]:
        m.transfer(25, te, c, mix_after=(10, 20))
    mag.engage(height_from_base=5)
    for c, d in zip(mp.rows()[0][:3], out.rows()[0][:3]):
        m.transfer(22, c, d)
