# expect: serial_dilution pass SD-5!
metadata = {"protocolName": "Antibody, tube by tube", "apiLevel": "2.14"}

ROUNDS = [("B1", "B2"), ("B2", "B3"), ("B3", "B4"), ("B4", "B5")]


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.transfer(150, rack["D6"], [rack[into] for _, into in ROUNDS])
    for taken, into in ROUNDS:
        p300.transfer(50, rack[taken], rack[into], new_tip="always", mix_after=(4, 100))
