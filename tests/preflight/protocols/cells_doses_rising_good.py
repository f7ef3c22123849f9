metadata = {"apiLevel": "2.16", "protocolName": "Kinase inhibitor dose response, MCF7"}


def run(protocol):
    tr = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5)]
    p = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tr)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "MCF7 monolayer")
    deep = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "inhibitor dilutions")
    doses = deep.rows()[0][1:6]
    doses_nM = [1, 10, 100, 1000, 10000]
    dmso_ctrl = cells["A1"]
    inh_cols = cells.rows()[0][1:6]
    vehicle_source = deep["A12"]
    p.transfer(10, vehicle_source, dmso_ctrl)
    p.pick_up_tip()
    for d, c in zip(doses, inh_cols):
        p.transfer(10, d, c, new_tip="never")
    p.drop_tip()
