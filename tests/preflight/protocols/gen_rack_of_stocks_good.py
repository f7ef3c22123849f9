# expect: generic pass GEN-1!
metadata = {"apiLevel": "2.14", "protocolName": "working plate"}
VOLS = {"A1": 20, "A2": 35, "A3": 12, "A4": 50}


def run(protocol):
    tips3 = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    conc = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "concentrated stocks")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "normalised plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips3])
    buffer = trough["A1"]
    p300.pick_up_tip()
    for well, v in VOLS.items():
        p300.transfer(100 - v, buffer, plate[well], new_tip="never")
    p300.drop_tip()
    for well, v in VOLS.items():
        p300.transfer(v, conc[well], plate[well], mix_after=(2, 50))
