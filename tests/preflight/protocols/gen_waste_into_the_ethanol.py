# expect: generic fail GEN-2
# reservoir: A1 beads, A2 80% ethanol, A12 waste
metadata = {"protocolName": "AMPure clean-up of amplicons", "apiLevel": "2.14"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5)]
    magnet = protocol.load_module("magnetic module gen2", 1)
    plate = magnet.load_labware("biorad_96_wellplate_200ul_pcr", "amplicons")
    res = protocol.load_labware("nest_12_reservoir_15ml", 2)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    etoh = res["A2"]
    cols = plate.rows()[0][:3]
    magnet.engage(height_from_base=6)
    m300.pick_up_tip()
    for c in cols:
        m300.aspirate(150, etoh)
        m300.dispense(150, c.top(1))
    m300.drop_tip()
    for c in cols:
        m300.pick_up_tip()
        m300.aspirate(150, c.bottom(0.6))
        m300.dispense(150, res["A2"])
        m300.drop_tip()
