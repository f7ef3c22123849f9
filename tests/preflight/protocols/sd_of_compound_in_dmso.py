# expect: serial_dilution fail SD-5
metadata = {"apiLevel": "2.13", "protocolName": "EC50 source plate: agonist in DMSO/medium"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    m = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    diluent, agonist = trough["A1"], trough["A6"]
    heads = plate.rows()[0][:8]
    m.distribute(100, diluent, heads[1:], disposal_volume=0)
    m.transfer(200, agonist, heads[0])
    m.transfer(100, heads[:7], heads[1:], mix_after=(4, 80), new_tip="once")
