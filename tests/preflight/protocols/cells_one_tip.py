# expect: cell_treatment fail CELL-3
metadata = {"protocolName": "Treatment of A549 with cisplatin", "apiLevel": "2.11"}


def run(protocol):
    tr = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    p300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tr])
    res = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    cisplatin = res["A1"]
    vehicle = res["A2"]
    treated_cols = plate.rows()[0][2:5]
    vehicle_ctrl_cols = plate.rows()[0][5:7]
    p300.pick_up_tip()
    p300.transfer(20, cisplatin, treated_cols, new_tip="never")
    p300.transfer(20, vehicle, vehicle_ctrl_cols, new_tip="never")
    p300.drop_tip()
