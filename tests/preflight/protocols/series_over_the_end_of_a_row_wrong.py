# expect: serial_dilution fail SD-3
metadata = {"protocolName": "Progesterone calibrators 1:2", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_1000ul", "1")
    p1000 = protocol.load_instrument("p1000_single_gen2", "left", tip_racks=[tips])
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "calibrators")
    diluent = protocol.load_labware("nest_12_reservoir_15ml", "3", "diluent")["A1"]
    stock = rack["A1"]
    series = [rack[name] for name in ("A2", "A3", "A4", "A5", "A6", "B1")]

    p1000.pick_up_tip()
    for tube in series[:-1]:
        p1000.aspirate(400, diluent)
        p1000.dispense(400, tube)
    p1000.drop_tip()
    for upper, lower in zip([stock, *series], series):
        p1000.transfer(400, upper, lower, mix_after=(5, 300), new_tip="always")
