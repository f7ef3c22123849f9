"""Ten-fold dilutions of phage lysate in tubes; each tube is mixed before the next step."""

metadata = {"apiLevel": "2.9"}


def run(protocol):
    tiprack = protocol.load_labware("opentrons_96_tiprack_1000ul", 1)
    rack = protocol.load_labware("opentrons_15_tuberack_falcon_15ml_conical", 2)
    buf = protocol.load_labware("agilent_1_reservoir_290ml", 3)["A1"]  # SM buffer, the diluent
    p1000 = protocol.load_instrument("p1000_single_gen2", "right", tip_racks=[tiprack])
    phage_stock = rack["A1"]
    dilutions = rack.wells()[1:7]
    p1000.transfer(900, buf, dilutions)
    chain = [phage_stock] + dilutions
    for i in range(6):
        p1000.transfer(100, chain[i], chain[i + 1], mix_before=(5, 500))
